"""The extension for Blender: its pictures beside those of Cycles, and how it behaves."""

import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest
from blender_pictures import assert_alike, blocks, picture
from blender_run import run

import pymlt as mlt

pytestmark = pytest.mark.skipif(
    not importlib.util.find_spec("bpy"), reason="needs bpy (pip install bpy)"
)
HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def rendered(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("rendered")
    run("blender_engine.py", folder, user=tmp_path_factory.mktemp("user"))
    return folder


@pytest.fixture(scope="module")
def facts(tmp_path_factory) -> dict:
    """What the behaviour script found, with the folder of its files."""
    folder = tmp_path_factory.mktemp("behaviour")
    spec = importlib.util.spec_from_file_location(
        "make_extension", HERE.parents[1] / "release" / "make_extension.py"
    )
    maker = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(maker)
    archive = maker.make([], folder)
    run("blender_behaviour.py", archive, folder, user=folder / "user")
    return json.loads((folder / "facts.json").read_text()) | {"folder": folder}


MOVING = [f"moving{frame}" for frame in (1, 2, 3)]


@pytest.mark.parametrize(
    "name",
    ["cube", "glass", "instances", "textured", "lettering", "grouped", "foggy", "cutout", *MOVING],
)
def test_a_picture_is_that_of_cycles(rendered, name):
    ours = picture(rendered / f"{name}.exr")
    cycles = f"moving-cycles{name[-1]}" if name in MOVING else f"{name}-cycles"
    theirs = picture(rendered / f"{cycles}.exr")
    assert_alike(ours, theirs)


@pytest.fixture(scope="module")
def goblets(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("goblets")
    run("blender_goblets.py", folder, user=folder / "user")
    return folder


@pytest.mark.parametrize("name", ["kept", "made"])
def test_the_goblets_in_blender_are_those_of_the_gallery(goblets, name):
    found = picture(goblets / f"{name}.exr")
    scene = mlt.load_dict(mlt.scenes.goblets(), size=found.shape[1::-1])
    expected = mlt.render(scene, "path", spp=1024, seed=1)
    np.testing.assert_allclose(found.mean(axis=(0, 1)), expected.mean(axis=(0, 1)), rtol=0.05)
    # By chance half of the blocks are within 1.5 %; a thing that is elsewhere changes more.
    assert np.median(np.abs(blocks(found) / blocks(expected) - 1)) < 0.04


def test_what_moves_is_elsewhere_in_each_frame(rendered):
    across = np.arange(64) @ np.stack(
        [picture(rendered / f"{name}.exr").sum(axis=(0, 2)) for name in MOVING], axis=1
    )
    middles = across / [picture(rendered / f"{name}.exr").sum() for name in MOVING]
    assert (np.diff(middles) > 5).all()


def test_the_border_shows_a_part_of_the_picture(rendered):
    part, whole = (picture(rendered / f"{name}.exr") for name in ("part", "cube"))
    assert part.shape[:2] == (18, 32)
    np.testing.assert_allclose(blocks(part), blocks(whole[:18, 16:48]), rtol=0.1)


def test_the_extension_is_installed_and_enabled(facts):
    assert facts["enabled"] == "bl_ext.user_default.pymlt"
    assert facts["disabled"]


def test_the_parameters_are_those_of_the_schemas(facts):
    from pymlt import _core

    for name, shown in facts["parameters"].items():
        known = _core.schema("integrator", name)["parameters"]
        # Blender has no place for layers, which are named by text.
        chosen = [p for p in known if p["type"] != "string" or p["choices"]]
        assert shown == [p["name"] for p in chosen if p["default"] is not None]


def test_what_is_wrong_is_told(facts):
    assert "max_depth" in facts["error"]


def test_a_render_can_be_cancelled(facts):
    assert facts["cancelled"] < 10


def test_the_line_of_statistics_tells_the_error(facts):
    assert facts["shown"][-1].startswith("16 samples per pixel, error ")


def channels(path: Path) -> dict[str, np.ndarray]:
    """The channels of an image of several parts, by LAYER.PASS.CHANNEL."""
    import OpenImageIO

    count = OpenImageIO.ImageBuf(str(path)).nsubimages
    parts = [OpenImageIO.ImageBuf(str(path), i, 0) for i in range(count)]
    return {
        channel: part.get_pixels()[..., i]
        for part in parts
        for i, channel in enumerate(part.spec().channelnames)
    }


def test_passes_are_in_the_file(facts):
    found = channels(facts["folder"] / "passes.exr")
    middle = {name.removeprefix("ViewLayer."): values[9, 15] for name, values in found.items()}
    assert middle["Albedo.R"] == pytest.approx(0.8, abs=0.005)
    assert middle["Depth.Z"] == pytest.approx(10.3, abs=0.5)
    normal = [middle[f"Normal.{axis}"] for axis in "XYZ"]
    assert np.linalg.norm(normal) == pytest.approx(1, abs=0.2)
    assert 0 < middle["Error.R"] < middle["Combined.R"]
    assert found["ViewLayer.Depth.Z"][0, 0] == 1e10


def test_a_transparent_film_has_alpha_and_no_world(facts):
    found, whole = (channels(facts["folder"] / f"{name}.exr") for name in ("transparent", "passes"))
    alpha = found["ViewLayer.Combined.A"]
    assert (alpha[0, 0], alpha[9, 15]) == (0, 1)
    for channel in "RGB":
        name = f"ViewLayer.Combined.{channel}"
        assert found[name][0, 0] == 0 < whole[name][0, 0]
        assert found[name][9, 15] == pytest.approx(whole[name][9, 15], rel=0.01)
    assert (whole["ViewLayer.Combined.A"] == 1).all()


def test_alpha_is_that_of_cycles(rendered):
    ours, theirs = (
        mlt.read_image(rendered / f"{name}.exr")[..., 3] for name in ("cutout", "cutout-cycles")
    )
    assert 0.2 < theirs.mean() < 0.8
    assert np.abs(ours - theirs).mean() < 0.01
    # Edges are as opaque as what is seen of them.
    edge = (theirs > 0.1) & (theirs < 0.9)
    assert ours[edge].mean() == pytest.approx(theirs[edge].mean(), rel=0.05)


def test_each_view_layer_has_its_picture(facts):
    found = channels(facts["folder"] / "layers.exr")
    assert found["ViewLayer.Combined.R"].std() > 0.02
    assert found["Second.Combined.R"].std() < 0.002
    assert found["Second.Combined.R"].mean() > 0.04


def test_the_denoiser_takes_noise_away(facts, rendered):
    cube = np.s_[12:24, 27:37]
    clean = picture(rendered / "cube.exr")[cube]

    def error(name):
        pictures = [picture(facts["folder"] / f"{name}{seed}.exr") for seed in range(4)]
        return np.mean([np.abs(noisy[cube] - clean).mean() for noisy in pictures])

    # Without the denoiser the same samples would have the same error; with it more than half of
    # that would be left if a filter had spread the noise over several pixels.
    assert error("denoised") < 0.4 * error("noisy")
