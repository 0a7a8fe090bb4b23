"""Light in participating media: closed forms, all algorithms, and what scenes may say."""

import math
import pickle
from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt

ALL = ["path", "bdpt", "ptracer", "pssmlt", "mmlt", "rjmlt", "erpt", "mlt"]
SHARED = Path(__file__).parents[3] / "shared/scenes/mitsuba-tests/tests/scenes"


def medium(sigma_t, albedo=0.0, **more) -> dict:
    return {"type": "homogeneous", "sigma_t": colour(sigma_t), "albedo": colour(albedo)} | more


def colour(value):
    return value if np.isscalar(value) else {"type": "rgb", "value": list(value)}


def camera(**more) -> dict:
    view = mlt.Transform().look_at(origin=[0, 0, 4], target=[0, 0, 0], up=[0, 1, 0])
    return {
        "type": "perspective",
        "to_world": view,
        "fov": 30.0,
        "film": {"type": "hdrfilm", "width": 8, "height": 8, "rfilter": {"type": "box"}},
    } | more


def box(inside: dict, **more) -> dict:
    return {"type": "cube", "bsdf": {"type": "null"}, "interior": inside} | more


def scene(**parts) -> mlt.Scene:
    return mlt.load_dict({"type": "scene", "sensor": camera()} | parts)


def mean(scene, integrator="path", spp=64, seed=1, **params) -> np.ndarray:
    return mlt.render(scene, {"type": integrator} | params, spp=spp, seed=seed).mean((0, 1))


def lit(radiance=1.0) -> dict:
    return {"type": "constant", "radiance": radiance}


SIGMA = (0.3, 0.7, 1.9)


@pytest.mark.parametrize("integrator", ["path", "bdpt", "direct", "mlt"])
def test_an_absorbing_slab_passes_what_beer_and_lambert_say(integrator):
    """A slab of thickness 2 before a light, seen by an orthographic camera."""
    sensor = camera(type="orthographic")
    del sensor["fov"]
    made = scene(sensor=sensor, slab=box(medium(SIGMA)), light=lit())
    expected = np.exp(-2 * np.array(SIGMA))
    spp = 1024 if integrator == "mlt" else 16
    found = mean(made, integrator, spp)
    np.testing.assert_allclose(found, expected, rtol=0.05 if integrator == "mlt" else 1e-5)


def glow(radiance, sigma_t, albedo=0.0) -> dict:
    return medium(sigma_t, albedo, emission=colour(radiance))


@pytest.mark.parametrize("integrator", ["path", "bdpt", "ptracer", "mmlt", "mlt"])
def test_a_slab_that_glows_is_as_bright_as_what_it_absorbs(integrator):
    """L_e (1 - e^-tau) for a slab of thickness 2, seen by an orthographic camera."""
    sensor = camera(type="orthographic")
    del sensor["fov"]
    made = scene(sensor=sensor, slab=box(glow((1, 2, 4), SIGMA)))
    expected = np.array([1, 2, 4]) * (1 - np.exp(-2 * np.array(SIGMA)))
    np.testing.assert_allclose(mean(made, integrator, 1024, max_depth=1), expected, rtol=0.02)


@pytest.mark.parametrize("integrator", ["path", "bdpt", "ptracer", "mlt"])
def test_a_ball_that_glows_is_seen_along_its_chords(integrator):
    """The mean of 1 - e^(-sigma 2 sqrt(1 - r^2)) over the disk that an orthographic camera sees."""
    sensor = camera(type="orthographic")
    del sensor["fov"]
    ball = {"type": "sphere", "bsdf": {"type": "null"}, "interior": glow(1, 0.9)}
    tau = 2 * 0.9
    disk = 1 - 2 / tau**2 * (1 - (1 + tau) * np.exp(-tau))
    found = mean(scene(sensor=sensor, ball=ball), integrator, 1024, max_depth=1)
    np.testing.assert_allclose(found, disk * np.pi / 4, rtol=0.02)


@pytest.mark.parametrize("integrator", ["path", "bdpt", "pssmlt", "mmlt", "mlt"])
def test_an_oven_has_the_radiance_of_its_gas(integrator):
    """Walls that reflect all, and a gas that scatters, absorbs and glows: L_e everywhere.

    ptracer is not asked: it joins vertices to a pinhole in the gas, by 1 / d^2, whose variance is
    infinite.
    """
    wall = {"type": "diffuse", "reflectance": 1.0}
    inside = {"to_world": mlt.Transform().scale(8), "interior": glow((1, 2, 4), 0.5, 0.4)}
    made = scene(oven={"type": "cube", "bsdf": wall} | inside)
    found = mean(made, integrator, 512, max_depth=200, rr_depth=200)
    np.testing.assert_allclose(found, [1, 2, 4], rtol=0.03)


def flame_on_a_grid(**more) -> dict:
    """Extinction in RGB and radiance that rise along z, in the box from -1 to 1."""
    to_world = mlt.Transform().translate([-1, -1, -1]).scale(2)
    rise = np.array([1, 3, 6, 2], dtype=np.float32)[:, None, None]
    thick = rise[..., None] * np.array(SIGMA, dtype=np.float32)
    bright = np.array([8, 1, 0, 4], dtype=np.float32)[:, None, None]
    volume = {"type": "gridvolume", "to_world": to_world}
    return {
        "type": "heterogeneous",
        "sigma_t": volume | {"data": thick},
        "scale": 0.5,
        "emission": volume | {"data": bright},
        "emission_scale": 0.25,
    } | more


def along_the_grid(values, z):
    """Linear between the middles of the cells of flame_on_a_grid, and constant beyond them."""
    return np.interp(z, [-0.75, -0.25, 0.25, 0.75], values)


@pytest.mark.parametrize("integrator", ["path", "bdpt", "ptracer", "mmlt", "mlt"])
def test_light_along_a_grid_that_glows_is_that_of_a_quadrature(integrator):
    """The integral of e^(-tau) sigma_t L_e along z, in red, green and blue."""
    sensor = camera(type="orthographic")
    del sensor["fov"]
    made = scene(sensor=sensor, flame=box(flame_on_a_grid(albedo=0.0)))
    steps = 4000
    z = 1 - (np.arange(steps) + 0.5) * 2 / steps
    sigma = 0.5 * along_the_grid([1, 3, 6, 2], z)[:, None] * np.array(SIGMA)
    tau = (np.cumsum(sigma, axis=0) - sigma / 2) * 2 / steps
    radiance = 0.25 * along_the_grid([8, 1, 0, 4], z)[:, None]
    expected = (np.exp(-tau) * sigma * radiance).sum(axis=0) * 2 / steps
    np.testing.assert_allclose(mean(made, integrator, 1024, max_depth=1), expected, rtol=0.02)


@pytest.mark.parametrize("integrator", ["ptracer", "bdpt", "pssmlt", "mmlt", "mlt"])
def test_a_flame_on_a_grid_is_alike_by_all_algorithms(integrator):
    """What scatters, absorbs and glows over a floor, seen from outside."""
    floor = {"type": "sphere", "center": [0, -6, 0], "radius": 4.9}
    made = scene(flame=box(flame_on_a_grid(albedo=colour((0.8, 0.5, 0.2)))), floor=floor)
    expected = mean(made, "path", 4096, max_depth=4)
    np.testing.assert_allclose(mean(made, integrator, 2048, max_depth=4), expected, rtol=0.02)


def test_what_glows_without_an_end_is_refused():
    """Around a ball, around the lens, and on both sides of a boundary."""
    gas = glow(1, 0.9) | {"id": "gas"}
    ref, ball = {"type": "ref", "id": "gas"}, {"type": "sphere", "center": [0, 0, -2]}
    for parts in (
        {"ball": ball | {"exterior": ref}},
        {"sensor": camera(medium=ref)},
        {"ball": ball | {"interior": ref, "exterior": ref}},
    ):
        with pytest.raises(mlt.SceneError, match="emits light and has no end"):
            scene(gas=gas, **parts)


@pytest.mark.parametrize("integrator", ["path", "bdpt", "pssmlt", "mmlt", "mlt"])
def test_a_furnace_of_white_fog_is_white(integrator):
    """Neither a medium of albedo 1 nor an index-matched boundary takes light away."""
    fog = medium((0.7, 0.8, 1), 1.0, phase={"type": "hg", "g": 0.4})
    made = scene(fog=box(fog), light=lit())
    found = mean(made, integrator, 256, max_depth=200, rr_depth=200)
    np.testing.assert_allclose(found, 1, rtol=0.02)


@pytest.mark.parametrize(
    ("phase", "density"),
    [
        ({"type": "isotropic"}, lambda c: 1 / (4 * math.pi)),
        ({"type": "rayleigh"}, lambda c: 3 * (1 + c * c) / (16 * math.pi)),
        (
            {"type": "hg", "g": 0.6},
            lambda c: (1 - 0.36) / (4 * math.pi * (1.36 - 1.2 * c) ** 1.5),
        ),
    ],
    ids=["isotropic", "rayleigh", "hg"],
)
@pytest.mark.parametrize("integrator", ["path", "bdpt", "mmlt", "mlt"])
def test_single_scattering_is_that_of_a_quadrature(integrator, phase, density):
    """A point light beside the ray of a narrow view through a box of fog."""
    sigma_t, sigma_s = np.array([0.4, 0.8, 1.5]), np.array([0.3, 0.4, 1.2])
    lamp, intensity = np.array([1.6, 0.3, 0.2]), 5.0
    fog = medium(sigma_t, sigma_s / sigma_t, phase=phase)
    made = scene(
        sensor=camera(fov=0.5),
        fog=box(fog),
        lamp={"type": "point", "position": lamp.tolist(), "intensity": intensity},
    )
    nodes, weights = np.polynomial.legendre.leggauss(200)
    expected = np.zeros(3)
    for z, weight in zip(nodes, weights, strict=True):
        to_lamp = lamp - [0, 0, z]
        distance = np.linalg.norm(to_lamp)
        w = to_lamp / distance
        in_fog = 1 / w[0]  # the face at x = 1 is the nearest one
        cosine = w @ [0, 0, -1]  # light comes along -w and goes on along +z
        passed = np.exp(-sigma_t * (in_fog + 1 - z))
        expected += weight * sigma_s * density(cosine) * passed * intensity / distance**2
    spp = {"path": 256, "bdpt": 256}.get(integrator, 2048)
    found = mean(made, integrator, spp, max_depth=2)
    np.testing.assert_allclose(found, expected, rtol=0.02)


@pytest.mark.parametrize("integrator", ["path", "bdpt", "mmlt", "mlt"])
def test_media_are_found_where_no_one_names_them(integrator):
    """A lamp and a lens within a boundary are in its medium, named or not."""
    fog = {"id": "fog"} | medium(0.4, 0.9)

    def foggy(named: bool) -> mlt.Scene:
        ref = {"medium": {"type": "ref", "id": "fog"}} if named else {}
        lamp = {"type": "area", "radiance": 4.0} | ref
        return scene(
            fog=fog,
            sensor=camera() | ref,
            room={"type": "sphere", "radius": 6.0, "bsdf": {"type": "null"}}
            | {"interior": {"type": "ref", "id": "fog"}},
            lamp={"type": "sphere", "center": [0, 1.5, 0], "radius": 0.5, "emitter": lamp},
            floor={"type": "sphere", "center": [0, -3, 0], "radius": 2.5},
        )

    images = [
        mlt.render(foggy(named), {"type": integrator, "max_depth": 4}, spp=64, seed=1)
        for named in (True, False)
    ]
    np.testing.assert_array_equal(*images)


def test_a_lamp_may_stand_in_two_media():
    """Half of it is in the fog; walks from either end see the same light."""
    made = scene(
        fog=box(medium(1.5, 0.8)),
        lamp={
            "type": "sphere",
            "center": [0, 1, 0],
            "radius": 0.3,
            "emitter": {"type": "area", "radiance": 5.0},
        },
    )
    path, bdpt = (mean(made, name, 4096, max_depth=3) for name in ("path", "bdpt"))
    np.testing.assert_allclose(bdpt, path, rtol=0.01)


def test_boundaries_that_cross_are_named():
    """A ball of fog that is half in a box of another fog, and one that is all in it."""
    fog, other = ({"type": "ref", "id": name} for name in ("fog", "other"))
    media = {"fog": medium(0.5, 0.5) | {"id": "fog"}, "other": medium(1.0) | {"id": "other"}}
    ball = {"type": "sphere", "radius": 0.5, "bsdf": {"type": "null"}, "interior": fog}

    def warnings(center, **sides):
        placed = ball | {"center": center} | sides
        return scene(ball=placed, box=box(other), light=lit(), **media).warnings

    (warning,) = warnings([1, 0, 0])
    assert "boundaries should not cross or touch" in warning
    assert int(warning.split(": ")[1].split(" of ")[0]) > 20
    assert warnings([0, 0, 0])  # it says that around it is nothing
    assert not warnings([0, 0, 0], exterior=other)
    assert not warnings([3, 0, 0])


def test_presets_and_both_ways_to_give_coefficients():
    milk = {"type": "homogeneous", "material": "skimmilk", "scale": 2.0}
    same = [
        {
            "type": "homogeneous",
            "sigma_s": colour((1.40, 2.44, 3.80)),
            "sigma_a": colour((0.0028, 0.0050, 0.0284)),
        },
        medium((1.4028, 2.4450, 3.8284), (1.40 / 1.4028, 2.44 / 2.4450, 3.80 / 3.8284)),
    ]
    reference = mean(scene(milk=box(milk), light=lit()), max_depth=6)
    for other in same:
        np.testing.assert_allclose(
            mean(scene(milk=box(other), light=lit()), max_depth=6), reference, rtol=1e-5
        )


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"type": "homogeneous", "albedo": 1.5}, "albedo"),
        ({"type": "homogeneous", "sigma_t": -1.0}, "sigma_t"),
        ({"type": "homogeneous", "sigma_t": 1.0, "sigma_s": 1.0}, "given twice"),
        ({"type": "homogeneous", "material": "skimmilc"}, "did you mean 'skimmilk'"),
        ({"type": "homogeneous", "phase": {"type": "hg", "g": 1.0}}, "'g'"),
        ({"type": "heterogeneous", "albedo": 1.5}, "'albedo' reaches 1.5"),
        ({"type": "heterogeneous", "sigma_t": {"type": "diffuse"}}, "no.* volume"),
        ({"type": "heterogeneous", "sigma_t": {"type": "gridvolume"}}, "filename"),
    ],
)
def test_mistakes_are_named(given, message):
    with pytest.raises(mlt.SceneError, match=message):
        scene(fog=box(given), light=lit())


def test_a_medium_of_a_shape_needs_its_side():
    wrong = {"type": "cube", "bsdf": {"type": "null"}, "inside": medium(1.0)}
    with pytest.raises(mlt.SceneError, match="'interior' or 'exterior', not 'inside'"):
        scene(fog=wrong, light=lit())


def test_materials_and_phase_functions_do_not_stand_for_one_another():
    diffuse, isotropic = {"type": "diffuse"}, {"type": "isotropic"}
    for wrong in (box(medium(1.0, 0.5, nested=diffuse)), {"type": "cube", "nested": isotropic}):
        with pytest.raises(mlt.SceneError, match=r"does not take a nested (bsdf|phase)"):
            scene(part=wrong, light=lit())


GRID = np.random.default_rng(1).random((5, 4, 6), dtype=np.float32)
IN_BOX = mlt.Transform().translate(-1, -1, -1).scale(2)


def smoke(data=GRID, albedo=0.0, **more) -> dict:
    """A grid in the cube from -1 to 1."""
    grid = {"type": "gridvolume", "data": data, "to_world": IN_BOX}
    return {"type": "heterogeneous", "sigma_t": grid, "albedo": albedo} | more


@pytest.mark.parametrize("integrator", ["path", "bdpt", "mmlt"])
def test_smoke_passes_what_its_values_add_up_to(integrator):
    """Layers across the view: each value holds between the middles of its neighbours."""
    sensor = camera(type="orthographic")
    del sensor["fov"]
    layers = np.array([[0.2, 0.3, 1.0], [0.0, 0.5, 0.1], [1.5, 0.0, 0.3]], np.float32)
    data = np.broadcast_to(layers[:, None, None, :], (3, 4, 4, 3))
    made = scene(sensor=sensor, smoke=box(smoke(data, scale=1.5)), light=lit())
    middles = (layers[1:] + layers[:-1]) / 2
    depth = 1.5 * (2 / 3) * (layers[0] / 2 + middles.sum(0) + layers[-1] / 2)
    spp = 2048 if integrator == "mmlt" else 16
    rtol = 0.03 if integrator == "mmlt" else 1e-5
    np.testing.assert_allclose(mean(made, integrator, spp), np.exp(-depth), rtol=rtol)


@pytest.mark.parametrize("integrator", ["path", "bdpt", "pssmlt", "mmlt", "rjmlt", "mlt"])
def test_a_furnace_of_white_smoke_is_white(integrator):
    made = scene(smoke=box(smoke(3 * GRID, 1.0)), light=lit())
    spp = {"mmlt": 2048, "rjmlt": 2048, "pssmlt": 1024}.get(integrator, 256)
    found = mean(made, integrator, spp, max_depth=100, rr_depth=100)
    np.testing.assert_allclose(found, 1, rtol=0.02)


def test_a_grid_of_one_value_is_a_homogeneous_medium():
    fog = medium(0.8, 0.7, phase={"type": "hg", "g": 0.3})
    one = np.full((2, 3, 2), 0.8, np.float32)
    cloud = smoke(one, 0.7, phase={"type": "hg", "g": 0.3})
    images = [
        mlt.render(scene(fog=box(inside), light=lit()), "path", spp=16, seed=1)
        for inside in (fog, cloud)
    ]
    np.testing.assert_allclose(*images, rtol=2e-4)


def test_a_grid_survives_files_pickles_and_names(tmp_path):
    made = {"type": "scene", "sensor": camera(), "smoke": box(smoke(albedo=0.9)), "light": lit()}
    mlt.convert(made, tmp_path / "smoke.xml")
    assert len(list(tmp_path.glob("*.vol"))) == 1
    coloured = smoke()
    coloured["sigma_t"]["grid"] = np.stack([coloured["sigma_t"].pop("data")] * 3, -1)
    coloured["albedo"] = 0.9
    images = [
        mlt.render(other, "path", spp=16, seed=1)
        for other in (
            mlt.load_dict(made),
            mlt.load(tmp_path / "smoke.xml"),
            pickle.loads(pickle.dumps(mlt.load_dict(made))),
            mlt.load_dict(made | {"smoke": box(coloured)}),
        )
    ]
    for image in images[1:]:
        np.testing.assert_allclose(image, images[0], rtol=1e-4)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (-GRID, r"x = 0, y = 0, z = 0 is -0\.47"),
        (np.where(GRID[3, 2, 1] == GRID, np.nan, GRID), r"not finite at \[3, 2, 1\]"),
        (GRID[0], r"shape \(4, 6\)"),
        (np.stack([GRID] * 2, -1), r"3 channels"),
    ],
)
def test_grids_that_are_none_are_refused(data, message):
    with pytest.raises(mlt.SceneError, match=message):
        scene(smoke=box(smoke(data)), light=lit())


@pytest.mark.parametrize("sigma", [0.0, 1e6])
@pytest.mark.parametrize("integrator", ALL)
def test_extreme_densities_give_numbers(sigma, integrator):
    """Nothing, and what is as good as a wall."""
    made = scene(
        fog=box(medium(sigma, 0.5)),
        lamp={"type": "point", "position": [0, 0, 3], "intensity": 5.0},
        wall={"type": "rectangle", "to_world": mlt.Transform().translate(0, 0, -2).scale(3)},
    )
    image = mlt.render(made, {"type": integrator, "max_depth": 6}, spp=16, seed=1)
    assert np.isfinite(image).all()
    assert (image >= 0).all()


def test_vertices_in_a_medium_can_be_inspected():
    made = scene(
        fog=box(medium(2.0, 0.9)),
        lamp={"type": "point", "position": [0, 0, 3], "intensity": 5.0},
    )
    paths = [made.sample_path(seed=seed, max_depth=3) for seed in range(20)]
    kinds = {kind for path in paths for kind in path.vertices["kind"]}
    assert kinds == {"light", "medium", "camera"}


MITSUBA = sorted(
    file.name.removesuffix(".xml")
    for pattern in ("test_homo_*.xml", "test_hetero_*.xml", "test_surf_*.xml")
    for file in (SHARED / "participating_media").glob(pattern)
) or [pytest.param("", marks=pytest.mark.skip("no Mitsuba scenes here"))]


@pytest.mark.parametrize("name", MITSUBA)
def test_mitsubas_scenes_of_media(name):
    """Nine scenes of Mitsuba's, against its own references and their variances."""
    file = SHARED / "participating_media" / f"{name}.xml"
    stem = name.removesuffix("_volpathmis").removesuffix("_volpath")
    made = mlt.load(file)
    references = file.parent / "refs"
    expected = mlt.read_image(references / f"{stem}_ref_rgb.exr")
    runs = np.stack([mlt.render(made, "path", spp=16, seed=seed) for seed in range(8)])
    blocks = [
        x.reshape(*x.shape[:-3], 6, 8, 6, 8, 3).mean((-5, -3, -2, -1))[..., None]
        for x in (runs, expected)
    ]
    error = blocks[0].std(0, ddof=1) / math.sqrt(8)
    z = (blocks[0].mean(0) - blocks[1]) / np.hypot(error, 0.002 * blocks[1])
    # t with 7 degrees of freedom: beyond 8.8 once in 20,000 blocks
    assert np.abs(z).max() < 8.8


def test_a_nanovdb_file_is_the_grid_of_its_voxels(tmp_path, nanovdb):
    """Its values are at voxels, and next to the outermost ones there are zeros."""
    values = np.random.default_rng(1).random((8, 8, 8), dtype=np.float32)
    (tmp_path / "smoke.nvdb").write_bytes(nanovdb(values, "smoke", 0.2, (-0.7, -0.7, -0.7)))
    file = {"type": "nanovdb", "filename": str(tmp_path / "smoke.nvdb"), "grid": "smoke"}
    around = mlt.Transform().translate(-1, -1, -1).scale(2)
    dense = {"type": "gridvolume", "data": np.pad(values.T, 1), "to_world": around}
    scale = {"type": "rgb", "value": [1, 2, 3]}
    images = [
        mean(scene(smoke=box(smoke() | {"sigma_t": volume}), light=lit()), spp=16)
        for volume in (dense, file, file | {"scale": 2.0}, file | {"scale": scale})
    ]
    assert images[0].max() < 0.9
    np.testing.assert_allclose(images[1], images[0], rtol=1e-4)
    assert images[2][0] < images[1][0]
    np.testing.assert_allclose(images[3][:2], [images[1][0], images[2][0]], rtol=1e-5)
    turned = file | {"to_world": mlt.Transform().scale([-1, 1, 1])}
    mirrored = scene(smoke=box(smoke() | {"sigma_t": turned}), light=lit())
    np.testing.assert_allclose(
        mlt.render(mirrored, "path", spp=256)[:, ::-1],
        mlt.render(scene(smoke=box(smoke() | {"sigma_t": file}), light=lit()), "path", spp=256),
        rtol=0.02,
    )
    with pytest.raises(mlt.FileError, match=r"smoke.nvdb: has no grid 'fog'; there are: smoke"):
        scene(smoke=box(smoke() | {"sigma_t": file | {"grid": "fog"}}), light=lit())


def test_a_nanovdb_file_may_not_be_negative(tmp_path, nanovdb):
    values = np.ones((8, 8, 8))
    values[1, 2, 3] = -1
    (tmp_path / "a.nvdb").write_bytes(nanovdb(values))
    file = {"type": "nanovdb", "filename": str(tmp_path / "a.nvdb")}
    expected = r"a.nvdb, from voxel \(-1, -1, -1\) on: the value at x = 2, y = 3, z = 4 is -1"
    with pytest.raises(mlt.SceneError, match=expected):
        scene(smoke=box(smoke() | {"sigma_t": file}), light=lit())


@pytest.mark.parametrize(("version", "bbox"), [("0.6.0", ""), ("3.0.0", "use_grid_bbox")])
def test_a_grid_lies_in_the_box_of_its_file(tmp_path, version, bbox):
    """As always before Mitsuba 2: two units of extinction 1 let e^-2 pass, at x < 0, too."""
    header = np.array([1, 2, 2, 2, 1], "<i4").tobytes()
    box_of_file = np.array([-1, -1, -1, 1, 1, 1], "<f4").tobytes()
    ones = np.ones(8, "<f4").tobytes()
    (tmp_path / "a.vol").write_bytes(b"VOL\3" + header + box_of_file + ones)
    flag = f'<boolean name="{bbox}" value="true"/>' if bbox else ""
    (tmp_path / "a.xml").write_text(f"""<scene version="{version}">
        <sensor type="orthographic"><transform name="to_world"><scale value="0.4"/>
        <lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
        <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/>
        <rfilter type="box"/></film></sensor>
        <emitter type="constant"/>
        <shape type="cube"><bsdf type="null"/><medium type="heterogeneous" name="interior">
        <volume name="sigma_t" type="gridvolume"><string name="filename" value="a.vol"/>{flag}
        </volume><spectrum name="albedo" value="0"/></medium></shape></scene>""")
    image = mlt.render(mlt.load(tmp_path / "a.xml"), "path", spp=256, seed=1)
    spread = math.sqrt(math.exp(-2) / image[..., 0].size / 256)  # at most, of its mean
    assert image.mean() == pytest.approx(math.exp(-2), abs=4.5 * spread)
