"""Alpha: what it is, by closed forms, and that every file has it as its format asks."""

import importlib.util
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from command_line import PYMLT, mlt_render, run

import pymlt as mlt

SIZE = 4  #: pixels, over an image plane from -1 to 1
LIGHT = np.array([0.5, 1.0, 0.25])
GREY = {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.8, 0.8, 0.8]}}
ROWS = np.array([0.0, 0.5, 1.0, 1.0])  #: of a card that ends in the middle of the second row


def scene(film=None, **parts) -> dict:
    """A camera without perspective that looks along -z, from z = 2."""
    film = {"type": "hdrfilm", "width": SIZE, "height": SIZE, "component_format": "float32"} | (
        film or {"rfilter": {"type": "box"}}
    )
    look = mlt.Transform.look_at([0, 0, 2], [0, 0, 0], [0, 1, 0])
    return {
        "type": "scene",
        "sensor": {"type": "orthographic", "to_world": look, "film": film},
        **parts,
    }


def card(top=0.25, z=0.0, **parts) -> dict:
    place = mlt.Transform().translate([0, top - 9, z]).scale([9, 9, 1])
    return {"type": "rectangle", "to_world": place, "bsdf": GREY, **parts}


def glowing(**parts) -> dict:
    radiance = {"type": "rgb", "value": list(LIGHT)}
    return card(emitter={"type": "area", "radiance": radiance}, **parts)


def rendered(described, integrator="path", **options) -> mlt.Result:
    return mlt.start(described, integrator, **({"spp": 64, "alpha": True} | options)).result()


def by_rows(rows) -> np.ndarray:
    return np.repeat(np.asarray(rows, np.float32)[:, None], SIZE, axis=1)


def test_a_card_covers_half_of_a_row():
    found = rendered(scene(card=glowing()))
    assert found.alpha.shape == (SIZE, SIZE)
    assert found.alpha.dtype == np.float32
    np.testing.assert_array_equal(found.alpha, by_rows(ROWS))
    np.testing.assert_allclose(found.image, by_rows(ROWS)[..., None] * LIGHT, rtol=1e-5)


@pytest.mark.parametrize("filter", ["gaussian", "mitchell", "lanczos"])
def test_what_is_covered_is_so_by_every_filter(filter):
    found = rendered(scene({"rfilter": {"type": filter}}, card=glowing(top=3))).alpha
    np.testing.assert_array_equal(found, np.ones((SIZE, SIZE)))
    edge = rendered(scene({"rfilter": {"type": filter}}, card=glowing())).alpha
    assert edge.min() >= 0
    assert edge.max() <= 1
    assert 0.4 < edge[1].mean() < 0.6


def test_masks_glass_and_nothing_cover_in_part():
    quarter = {"type": "mask", "opacity": 0.25, "bsdf": GREY}
    reflected = (0.5 / 2.5) ** 2
    pane = {"type": "thindielectric", "int_ior": 1.5, "ext_ior": 1.0}
    for bsdf, expected in (
        (quarter, 0.25),
        ({"type": "null"}, 0),
        (pane, 2 * reflected / (1 + reflected)),
        ({"type": "dielectric"}, 1),
    ):
        lamp = {"type": "point", "position": [0, 0, 5], "intensity": 1.0}
        found = rendered(scene(lamp=lamp, card=card(bsdf=bsdf))).alpha
        np.testing.assert_allclose(found, by_rows(ROWS * expected), rtol=1e-6, atol=1e-7)
    both = scene(lamp=lamp, a=card(bsdf=quarter), b=card(z=-1, bsdf=quarter))
    np.testing.assert_allclose(rendered(both).alpha, by_rows(ROWS * (1 - 0.75**2)), rtol=1e-6)


def test_smoke_covers_as_much_as_it_takes_away():
    slab = mlt.Transform().translate([0, 0, 1]).scale([3, 3, 0.5])
    smoke = {"type": "homogeneous", "sigma_t": {"type": "rgb", "value": [0.5, 1, 2]}}
    around = {"type": "cube", "to_world": slab, "bsdf": {"type": "null"}, "interior": smoke}
    found = rendered(scene(smoke=around, card=glowing())).alpha
    passed = np.exp(-np.array([0.5, 1, 2])).mean()
    np.testing.assert_allclose(found, by_rows(1 - (1 - ROWS) * passed), rtol=1e-5)
    endless = scene(card=glowing())
    endless["sensor"]["medium"] = {"type": "homogeneous", "sigma_t": 1.0}
    np.testing.assert_array_equal(rendered(endless).alpha, np.ones((SIZE, SIZE)))


def test_a_background_covers_unless_it_is_hidden():
    sky = scene(sky={"type": "constant"}, card=card())
    np.testing.assert_array_equal(rendered(sky).alpha, np.ones((SIZE, SIZE)))
    hidden = rendered(sky, {"type": "path", "hide_emitters": True, "max_depth": 2}, spp=4096)
    np.testing.assert_array_equal(hidden.alpha, by_rows(ROWS))
    np.testing.assert_allclose(hidden.image[..., 0], by_rows(0.8 * ROWS), atol=0.02)
    sun = {"type": "directional", "direction": [0, 0, -1], "irradiance": 1.0}
    np.testing.assert_array_equal(rendered(scene(sun=sun, card=card())).alpha, by_rows(ROWS))


def test_alpha_ends_at_the_far_plane():
    far = scene(card=glowing())
    far["sensor"] |= {"near_clip": 0.1, "far_clip": 1.5}
    assert not rendered(far).alpha.any()


def test_a_lens_and_motion_blur_the_edge():
    blurred = scene(card=glowing())
    look = mlt.Transform.look_at([0, 0, 2], [0, 0, 0], [0, 1, 0])
    blurred["sensor"] |= {"type": "thinlens", "to_world": look, "fov": 90.0}
    blurred["sensor"] |= {"aperture_radius": 0.5, "focus_distance": 1.0}
    found = rendered(blurred)
    np.testing.assert_allclose(found.image, found.alpha[..., None] * LIGHT, rtol=1e-5)
    assert ((found.alpha > 0) & (found.alpha < 1)).sum() > SIZE


@pytest.mark.parametrize("integrator", ["bdpt", "ptracer", "pssmlt", "mmlt", "erpt", "mlt"])
def test_alpha_depends_on_nothing_but_the_scene_and_the_seed(integrator, tmp_path):
    soft = scene({"rfilter": {"type": "gaussian"}}, card=glowing(top=0.3))
    expected = rendered(soft, threads=1, seed=3).alpha
    job = mlt.start(soft, integrator, spp=4, alpha=True, seed=3, threads=2)
    job.checkpoint(tmp_path / "render.mlt")
    np.testing.assert_array_equal(job.result().alpha, expected)
    resumed = mlt.resume(tmp_path / "render.mlt", scene=soft, alpha=True)
    np.testing.assert_array_equal(resumed.result().alpha, expected)
    assert not np.array_equal(rendered(soft, seed=4).alpha, expected)


def test_a_film_asks_for_alpha():
    for name, has in (("rgba", True), ("luminance_alpha", True), ("rgb", False)):
        film = {"rfilter": {"type": "box"}, "pixel_format": name}
        job = mlt.start(scene(film, card=glowing()), "path", spp=1)
        assert job.has_alpha == has
        assert (job.result().alpha is not None) == has


def test_arrays_have_alpha_where_it_is_asked_for():
    described = scene(card=glowing())
    found = mlt.render(described, "path", spp=64, alpha=True)
    np.testing.assert_allclose(found[..., :3], by_rows(ROWS)[..., None] * LIGHT, rtol=1e-5)
    np.testing.assert_array_equal(found[..., 3], by_rows(ROWS))
    assert mlt.render(described, "path", spp=1).shape == (SIZE, SIZE, 3)


def test_a_layer_cannot_be_called_alpha():
    with pytest.raises(mlt.UsageError, match="which the image has by --alpha"):
        rendered(scene(card=glowing()), aovs="alpha:depth")


# ---- files


@pytest.fixture(scope="module")
def half_covered() -> mlt.Result:
    return rendered(scene(card=glowing()), aovs="depth")


def test_exr_files_have_colours_multiplied_by_alpha(half_covered, tmp_path):
    half_covered.save(tmp_path / "card.exr")
    found = mlt.read_image(tmp_path / "card.exr")
    np.testing.assert_array_equal(found[..., :3], half_covered.image)
    np.testing.assert_array_equal(found[..., 3], half_covered.alpha)
    channels = mlt.images.read_header(tmp_path / "card.exr")["channels"]
    assert "A" in channels
    assert "depth.Y" in channels
    assert not any(name.startswith("alpha") for name in channels)


@pytest.mark.parametrize("curve", ["srgb", "reinhard"])
@pytest.mark.parametrize("exposure", [0, -1])
@pytest.mark.parametrize("bits", [8, 16])
def test_png_files_have_colours_that_are_not(half_covered, tmp_path, curve, exposure, bits):
    half_covered.save(tmp_path / "card.png", exposure, tonemap=curve, bits=bits)
    found = mlt.read_image(tmp_path / "card.png")
    np.testing.assert_allclose(found[..., 3], by_rows(ROWS), atol=0.5 / 255)
    shown = mlt.tonemap(LIGHT[None, None], curve, exposure=exposure)[0, 0]
    np.testing.assert_allclose(found[1:, :, :3], np.broadcast_to(shown, (3, SIZE, 3)), atol=0.005)
    assert not found[0].any()


@pytest.mark.parametrize("extension", ["jpg", "hdr"])
def test_other_files_show_the_image_over_black(half_covered, tmp_path, extension):
    path = tmp_path / f"card.{extension}"
    half_covered.save(path)
    found = mlt.read_image(path)
    np.testing.assert_allclose(found, half_covered.image, atol=0.02)
    assert f".{extension} has no alpha" in mlt._core.alpha_problem(str(path))


def test_curves_leave_alpha_as_it_is(tmp_path):
    pixel = np.full((1, 1, 4), 0.5, np.float32)
    mlt.write_image(tmp_path / "pixel.png", pixel, exposure=1, tonemap="filmic")
    np.testing.assert_allclose(mlt.read_image(tmp_path / "pixel.png")[0, 0, 3], 0.5, atol=0.002)


def test_both_command_lines_write_alpha(tmp_path):
    described = scene(card=glowing())
    mlt.convert(described, tmp_path / "card.xml")
    expected = rendered(described)
    for number, command in enumerate(filter(None, ([*PYMLT, "render"], mlt_render()))):
        names = [tmp_path / f"{number}.{kind}" for kind in ("exr", "png", "hdr")]
        outputs = [word for name in names for word in ("-o", name)]
        flags = ["--integrator", "path", "--spp", "64", "--alpha", *outputs]
        outcome = run(command, tmp_path / "card.xml", *flags)
        assert outcome.returncode == 0, outcome.stderr
        assert ".hdr has no alpha" in outcome.stderr
        found = mlt.read_image(names[0])
        np.testing.assert_array_equal(found[..., 3], expected.alpha)
        np.testing.assert_array_equal(found[..., :3], expected.image)
        expected.save(tmp_path / "expected.png")
        assert names[1].read_bytes() == (tmp_path / "expected.png").read_bytes()


# ---- what is done with images


def test_merged_images_have_the_mean_of_alpha(tmp_path):
    soft = scene({"rfilter": {"type": "gaussian"}}, card=glowing(top=0.3))
    parts = [rendered(soft, seed=seed, spp=4) for seed in (1, 2)]
    merged = mlt.merge(parts)
    np.testing.assert_allclose(merged.alpha, (parts[0].alpha + parts[1].alpha) / 2, rtol=1e-6)
    for part in parts:
        part.save(tmp_path / f"{part.seed}.exr")
    files = mlt.merge([tmp_path / "1.exr", tmp_path / "2.exr"])
    np.testing.assert_array_equal(files.alpha, merged.alpha)
    np.testing.assert_array_equal(files.image, merged.image)


def test_denoised_images_keep_alpha(half_covered, tmp_path):
    pytest.importorskip("pyoidn", reason="needs pymlt[denoise]")
    np.testing.assert_array_equal(half_covered.denoise().alpha, half_covered.alpha)
    half_covered.save(tmp_path / "card.exr")
    outcome = run(PYMLT, "denoise", tmp_path / "card.exr", "-o", tmp_path / "clean.exr")
    assert outcome.returncode == 0, outcome.stderr
    clean = mlt.read_image(tmp_path / "clean.exr")
    np.testing.assert_array_equal(clean[..., 3], half_covered.alpha)


def test_a_picture_in_blender_has_its_alpha(half_covered):
    place = Path(__file__).parents[2] / "blender" / "passes.py"
    spec = importlib.util.spec_from_file_location("passes", place)
    passes = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(passes)
    written = {}

    def receiver(name):
        def keep(pixels):
            written[name] = pixels.reshape(SIZE, SIZE, -1)[::-1]

        return SimpleNamespace(rect=SimpleNamespace(foreach_set=keep))

    layer = SimpleNamespace(passes={"Combined": receiver("Combined")})
    passes.write(layer, half_covered.image, half_covered.layers)
    np.testing.assert_array_equal(written["Combined"][..., :3], half_covered.image)
    np.testing.assert_array_equal(written["Combined"][..., 3], half_covered.alpha)
    passes.write(layer, half_covered.image, {})
    np.testing.assert_array_equal(written["Combined"][..., 3], np.ones((SIZE, SIZE)))


def test_a_cluster_makes_the_same_alpha():
    pytest.importorskip("distributed", reason="needs pymlt[cluster]")
    described = scene(card=glowing())
    found = rendered(described, cluster="local:1", spp=2)
    np.testing.assert_array_equal(found.alpha, by_rows(ROWS))
