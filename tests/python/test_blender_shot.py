"""The extension for Blender: shots, several frames of which are rendered together."""

import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest
from blender_pictures import picture
from blender_run import run
from same_image import QUICK, Blocks, compare, measure
from test_blender_engine import channels

pytestmark = pytest.mark.skipif(
    not importlib.util.find_spec("bpy"), reason="needs bpy (pip install bpy)"
)
SEEDS = range(8)
FRAMES = {"moving": (1, 2, 3, 4), "painted": (1, 3, 5, 7)}


@pytest.fixture(scope="module")
def shots(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("shots")
    run("blender_shot.py", folder, user=tmp_path_factory.mktemp("user"))
    return folder


@pytest.fixture(scope="module")
def facts(tmp_path_factory) -> dict:
    folder = tmp_path_factory.mktemp("windows")
    run("blender_shot_windows.py", folder, user=tmp_path_factory.mktemp("user"))
    return json.loads((folder / "facts.json").read_text()) | {"folder": folder}


def blocks(folder: Path, name: str, kind: str, frame: int) -> Blocks:
    def image(seed: int) -> np.ndarray:
        return picture(folder / f"{name}-{kind}-{seed}-{frame}.exr")

    return measure(image, QUICK, SEEDS)


ALL = [(name, frame) for name, frames in FRAMES.items() for frame in frames]


@pytest.mark.parametrize(("name", "frame"), ALL)
def test_a_frame_of_a_shot_is_that_of_the_animation(shots, name, frame):
    """Rendered by `mlt` together, and by `bdpt` alone, by eight seeds each."""
    verdict = compare(*(blocks(shots, name, kind, frame) for kind in ("shot", "alone")))
    assert not verdict.rejected, verdict
    assert verdict.median_block < 0.2


@pytest.mark.parametrize(("name", "frame"), [pair for pair in ALL if pair[1] not in (4, 7)])
def test_the_next_frame_of_the_animation_is_another_image(shots, name, frame):
    after = FRAMES[name][FRAMES[name].index(frame) + 1]
    assert compare(blocks(shots, name, "shot", frame), blocks(shots, name, "alone", after)).rejected


def test_files_have_the_names_that_blender_gives_them(shots):
    for name, frames in FRAMES.items():
        found, expected = (
            {path.name for path in shots.glob(f"{name}-shot-{seed}-{frame}.exr")}
            for seed, frame in (("*", "*"), ("[0-7]", f"[{''.join(map(str, frames))}]"))
        )
        assert found == expected
        assert len(found) == 4 * len(SEEDS)


def test_as_many_frames_as_a_power_of_two_are_rendered_together(facts):
    assert facts["nothing"] == {"told": [], "windows": [[1, 2, 3, 4]]}
    assert facts["longer"] == {"told": [], "windows": [[1, 2, 3, 4], [5, 6]]}
    assert facts["another_layer"] == {"told": [], "windows": [[1, 2, 3, 4]] * 2}


def test_only_mlt_renders_frames_together(facts):
    assert facts["by_path"] == {"told": [], "windows": []}


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ("hide", "'Cube' vanishes"),
        ("brighten", "'world' differs in its radiance"),
        ("mirror", "'Cube' differs in its to_world"),
        ("turn", "'Sun' differs in its to_world"),
        ("cut", "the camera is another one"),
    ],
)
def test_another_render_begins_where_more_changes_than_places(facts, change, sentence):
    assert facts[change] == {"told": [[sentence, 3]], "windows": [[1, 2], [3, 4]]}


@pytest.mark.parametrize(
    ("change", "sentence"),
    [("zoom", "'camera' differs in its fov"), ("deform", "'Cube' differs in its normals")],
)
def test_frames_that_all_differ_are_rendered_alone(facts, change, sentence):
    assert facts[change] == {"told": [[sentence, 3], [sentence, 4]], "windows": [[1, 2]]}


def test_what_a_script_moves_is_rendered_together(facts):
    assert facts["script"] == facts["nothing"]
    lifted, still = (
        [picture(facts["folder"] / f"{name}-{frame}.exr") for frame in (2, 3)]
        for name in ("script", "nothing")
    )
    changes = [np.abs(a - b).mean() for a, b in zip(lifted, still, strict=True)]
    assert changes[0] < 0.3 * changes[1]


def test_frames_that_are_not_what_they_were_before_are_rendered_alone(facts):
    """The script has already lifted the box when Blender comes to frame 2."""
    sentence = "things are not where they were when looked at before"
    assert facts["ratchet"] == {"told": [[sentence, 2]], "windows": [[1, 2, 3, 4]]}


def test_frames_that_are_to_stay_are_left_out(facts):
    assert facts["kept"] == [[1, 3]]
    assert (facts["folder"] / "kept-2.exr").read_bytes() == b"kept"
    assert (facts["folder"] / "kept-4.exr").exists()


def test_an_error_alone_ends_no_frames_that_are_rendered_together(facts):
    assert "end by Time or Samples" in facts["by error"]


def test_the_operator_is_there_while_pymlt_is_the_engine(facts):
    assert facts["entries"] == ["pymlt.render_shot"]
    assert "poll() failed" in facts["by cycles"]


@pytest.mark.parametrize("frame", [2, 3])
def test_frames_that_are_rendered_together_have_all_passes(facts, frame):
    """Albedo, normals and alpha are those of frames alone, but for the noise of their edges."""
    assert facts["passes"] == [[2, 3]] * 3
    together, alone, other = (
        channels(facts["folder"] / f"passes-{kind}.exr")
        for kind in (f"shot-{frame}", f"alone-{frame}", f"alone-{5 - frame}")
    )
    assert together.keys() == alone.keys()
    for name in ("Albedo.R", "Albedo.B", "Normal.X", "Normal.Z", "Combined.A"):
        seen, expected, another = (c[f"ViewLayer.{name}"] for c in (together, alone, other))
        assert np.abs(seen - expected).mean() < 0.02
        assert np.abs(seen - expected).mean() < 0.5 * np.abs(seen - another).mean()
    assert (together["ViewLayer.Error.R"] > 0).mean() > 0.9


def test_frames_that_are_rendered_together_are_denoised(facts):
    """On the floor, which is even."""

    def unevenness(denoised: bool) -> float:
        found = channels(facts["folder"] / f"denoised-{denoised}-shot-2.exr")
        return float(np.abs(np.diff(found["ViewLayer.Combined.B"][10:])).mean())

    assert unevenness(True) < 0.4 * unevenness(False)
