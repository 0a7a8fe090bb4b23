"""Layers that show what the camera sees first."""

import numpy as np
import pytest
import tiny
from command_line import PYMLT, mlt_render, run, the_error

import pymlt as mlt

KINDS = "albedo,depth,position,uv,geo_normal,sh_normal,shape_index,prim_index"


def layers(scene, aovs=KINDS, integrator="path", **options) -> dict[str, np.ndarray]:
    return mlt.start(scene, integrator, spp=1, aovs=aovs, **options).result().layers


def wall() -> dict:
    """A red wall at z = 0, seen straight on from z = 2; it ends in the right half of the image."""
    return {
        "type": "scene",
        "sensor": {
            "type": "perspective",
            "fov": 90.0,
            "to_world": mlt.Transform.look_at([0, 0, 2], [0, 0, 0], [0, 1, 0]),
            "film": {"type": "hdrfilm", "width": 20, "height": 10},
        },
        "light": {"type": "constant"},
        "wall": {
            "type": "rectangle",
            "to_world": mlt.Transform().translate([-5, 0, 0]).scale([5.45, 5, 1]),
            "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.8, 0.2, 0.1]}},
        },
    }


def test_layers_of_a_wall_are_what_geometry_says():
    found = layers(wall())
    assert {name: image.shape[2] for name, image in found.items() if name in KINDS} == {
        **dict.fromkeys(["albedo", "position", "uv", "geo_normal", "sh_normal"], 3),
        **dict.fromkeys(["depth", "shape_index", "prim_index"], 1),
    }
    seen = found["shape_index"][..., 0] == 0
    # One pixel is 0.2 wide at a distance of 2: the edge, x = 0.45, lies in column 12.
    np.testing.assert_array_equal(seen, np.arange(20) < 12 + np.zeros((10, 1)))
    np.testing.assert_array_equal(found["prim_index"][~seen], -1)
    inside = np.zeros_like(seen)
    inside[:, :12] = True
    np.testing.assert_allclose(found["albedo"][inside], [[0.8, 0.2, 0.1]] * 120, rtol=1e-6)
    for kind in ("geo_normal", "sh_normal"):
        np.testing.assert_allclose(found[kind][inside], [[0, 0, 1]] * 120, atol=1e-6)
    y, x = np.mgrid[0:10, 0:20] + 0.5
    middle = np.stack([(x - 10) / 5, (5 - y) / 5, np.zeros_like(x)], -1)
    # The mean of 16 stratified samples of a pixel that is 0.2 wide.
    np.testing.assert_allclose(found["position"][inside], middle[inside], atol=0.025)
    distance = np.linalg.norm(middle - [0, 0, 2], axis=-1)
    np.testing.assert_allclose(found["depth"][inside, 0], distance[inside], atol=0.03)
    for name in ("albedo", "depth", "position", "geo_normal"):
        assert not found[name][:, 13:].any()


def test_shading_normals_are_not_those_of_the_geometry(tmp_path):
    """A triangle at z = 0, larger than the image, whose normals are all tilted alike."""
    corners = "v -9 -9 0\nv 9 -9 0\nv 0 99 0\nvn 0.6 0 0.8\nf 1//1 2//1 3//1\n"
    (tmp_path / "tilted.obj").write_text(corners)
    scene = wall()
    scene["wall"] = {"type": "obj", "filename": str(tmp_path / "tilted.obj")}
    found = layers(scene, "geo_normal,sh_normal")
    for kind, normal in (("geo_normal", [0, 0, 1]), ("sh_normal", [0.6, 0, 0.8])):
        np.testing.assert_allclose(found[kind].reshape(-1, 3), [normal] * 200, atol=1e-6)


@pytest.mark.parametrize(
    "integrator", ["direct", "ptracer", "bdpt", "pssmlt", "mmlt", "rjmlt", "erpt", "mlt"]
)
def test_layers_do_not_depend_on_the_integrator_or_on_threads(integrator):
    expected = layers(tiny.scene(), seed=3, threads=1)
    found = layers(tiny.scene(), integrator=integrator, seed=3, threads=2)
    for name in KINDS.split(","):
        np.testing.assert_array_equal(found[name], expected[name])
    other = layers(tiny.scene(), seed=4)
    assert (other["position"] != expected["position"]).any()
    np.testing.assert_array_equal(other["shape_index"], expected["shape_index"])


def test_layers_have_names_of_their_own():
    found = layers(tiny.scene(), ["n:sh_normal", " depth "])
    np.testing.assert_array_equal(found["n"], layers(tiny.scene())["sh_normal"])
    assert "depth" in found
    assert "sh_normal" not in found


def test_instances_count_as_one_shape():
    scene = wall()
    del scene["wall"]
    scene["group"] = {
        "type": "shapegroup",
        "first": {"type": "rectangle"},
        "second": {"type": "sphere", "radius": 0.3},
    }
    scene["instance"] = {"type": "instance", "shapegroup": {"type": "ref", "id": "group"}}
    assert set(np.unique(layers(scene)["shape_index"])) == {-1, 0}


def test_integrator_aov_is_understood():
    scene = tiny.scene()
    scene["integrator"] = {"type": "aov", "aovs": "nn:sh_normal", "inner": scene["integrator"]}
    result = mlt.start(scene, spp=1).result()
    np.testing.assert_array_equal(result.layers["nn"], layers(tiny.scene())["sh_normal"])
    assert result.stats["integrator"] == "path"
    assert not result.stats["warnings"]
    assert "nn" not in mlt.start(scene, spp=1, aovs="depth").result().layers
    del scene["integrator"]["aovs"]
    with pytest.raises(mlt.SceneError, match="'aov' needs a string 'aovs'"):
        mlt.load_dict(scene)


def test_layers_are_written_and_survive_a_resumption(tmp_path):
    (tmp_path / "tiny.xml").write_text(tiny.XML)
    flags = ["tiny.xml", "--spp", "1", "--aov", "depth,a:albedo", "-o"]
    for command, name in (([*PYMLT, "render"], "p.exr"), (mlt_render(), "m.exr")):
        done = run(command, *flags, name, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
    error = the_error(run([*PYMLT, "render"], *flags, "x.exr", "--aov", "z", cwd=tmp_path))
    assert "'z' is not a layer" in error
    for layer in ("depth", "a"):
        np.testing.assert_array_equal(
            mlt.read_image(tmp_path / "p.exr", layer), mlt.read_image(tmp_path / "m.exr", layer)
        )
    mlt.start(tiny.scene(), "path", spp=1, checkpoint=tmp_path / "c").result()
    again = mlt.resume(tmp_path / "c", scene=tiny.scene(), aovs="depth").result()
    np.testing.assert_array_equal(again.layers["depth"], layers(tiny.scene())["depth"])


def test_mistakes_are_named():
    with pytest.raises(mlt.UsageError, match=r"'albdo' is not a layer.*did you mean 'albedo'"):
        layers(tiny.scene(), "albdo")
    with pytest.raises(mlt.UsageError, match="'depth' is asked for twice"):
        layers(tiny.scene(), "depth,depth")
    with pytest.raises(mlt.UsageError, match="has no name"):
        layers(tiny.scene(), ":depth")


FOG = {"type": "homogeneous", "sigma_t": {"type": "rgb", "value": [0, 0.5, 2]}, "albedo": 0.5}
VOID = {"bsdf": {"type": "null"}}


def foggy(**parts) -> dict:
    """The wall, all over the image, 2 before an orthographic lens."""
    scene = wall() | parts
    scene["wall"]["to_world"] = mlt.Transform().scale([5, 5, 1])
    scene["sensor"]["type"] = "orthographic"
    del scene["sensor"]["fov"]
    return scene


def test_optical_depths_of_nested_media_add_up():
    """A slab from z = 0.5 to 1.5; in it one of half its thickness, and another medium."""
    middle = mlt.Transform().translate([0, 0, 1])
    slab = {"type": "cube", "to_world": middle.scale([3, 3, 0.5]), "interior": FOG} | VOID
    milk = {"type": "homogeneous", "sigma_t": 3.0}
    inner = {"type": "cube", "to_world": middle.scale([2, 2, 0.25]), "interior": milk} | VOID
    for parts, expected in (
        ({}, [0, 0, 0]),
        ({"slab": slab}, [0, 0.5, 2]),
        ({"slab": slab, "inner": inner | {"exterior": FOG}}, [1.5, 1.75, 2.5]),
    ):
        found = layers(foggy(**parts), "optical_depth")["optical_depth"]
        np.testing.assert_allclose(found, np.broadcast_to(expected, found.shape), rtol=1e-5)


def test_optical_depths_end_at_surfaces_and_nowhere_else():
    """In fog without an end the depth is that of the way to the wall; beside it, infinite."""
    scene = wall()
    scene["sensor"]["medium"] = FOG
    found = layers(scene, "depth,optical_depth")
    depth, tau = found["depth"][:, :12], found["optical_depth"]
    np.testing.assert_allclose(tau[:, :12], depth * [0, 0.5, 2], rtol=1e-4)
    np.testing.assert_array_equal(tau[:, 13:], np.broadcast_to([0, np.inf, np.inf], (10, 7, 3)))
    assert not layers(wall(), "optical_depth")["optical_depth"].any()


def test_optical_depth_of_smoke_is_the_sum_of_its_values():
    data = np.random.default_rng(1).random((6, 1, 1), dtype=np.float32)
    around = mlt.Transform().translate([-2, -2, 0.5]).scale([4, 4, 1])
    grid = {"type": "gridvolume", "data": data, "to_world": around}
    smoke = {"type": "heterogeneous", "sigma_t": grid, "scale": 3.0}
    cube = mlt.Transform().translate([0, 0, 1]).scale([3, 3, 0.7])
    slab = {"type": "cube", "to_world": cube, "interior": smoke} | VOID
    found = layers(foggy(slab=slab), "optical_depth")["optical_depth"]
    np.testing.assert_allclose(found, np.full_like(found, 3 * data.mean()), rtol=1e-5)


def test_layers_look_through_fog():
    clear = layers(foggy())
    slab = {"type": "cube", "to_world": mlt.Transform().translate([0, 0, 1]).scale([3, 3, 0.5])}
    found = layers(foggy(slab=slab | {"interior": FOG} | VOID))
    for kind in KINDS.split(","):
        np.testing.assert_allclose(found[kind], clear[kind], atol=0.05, err_msg=kind)


@pytest.mark.peer
def test_layers_are_those_of_mitsuba():
    import mitsuba

    mitsuba.set_variant("scalar_rgb")
    kinds = ["albedo", "depth", "position", "uv", "geo_normal", "sh_normal"]
    # Mitsuba's albedo of glass is 0, ours 1: what does not darken a denoiser's colours.
    xml = tiny.XML.replace('"dielectric"', '"diffuse"')
    path = '<integrator type="path"><integer name="max_depth" value="$depth"/></integrator>'
    names = ",".join(f"{kind}:{kind}" for kind in kinds)
    aov = f'<integrator type="aov"><string name="aovs" value="{names}"/>{path}</integrator>'
    scene = mitsuba.load_string(xml.replace(path, aov))
    theirs = np.array(mitsuba.render(scene, spp=256))
    channels = [name.split(".")[0] for name in scene.integrator().aov_names()]
    found = layers(mlt.load_string(xml), kinds)
    for kind in kinds:
        # What the image itself has of channels comes first.
        here = [i - len(channels) for i, name in enumerate(channels) if name == kind]
        expected, ours = theirs[..., here], found[kind][..., : len(here)]
        difference, scale = abs(ours - expected).max(axis=2), abs(expected).max()
        # Within a pixel at an edge the mean of 16 rays is rough.
        assert np.median(difference) < 0.005 * scale, kind
        assert np.quantile(difference, 0.9) < 0.06 * scale, kind
        assert abs((ours - expected).mean(axis=(0, 1))).max() < 0.01 * scale, kind
