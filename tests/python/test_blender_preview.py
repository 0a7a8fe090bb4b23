"""The extension for Blender in 3D views: a picture that follows the scene and the view."""

import importlib.util
import json

import numpy as np
import pytest
from blender_run import run

pytestmark = pytest.mark.skipif(
    not importlib.util.find_spec("bpy"), reason="needs bpy (pip install bpy)"
)


@pytest.fixture(scope="module")
def seen(tmp_path_factory) -> dict:
    """The facts and the pictures, without alpha and with row 0 on top."""
    folder = tmp_path_factory.mktemp("preview")
    run("blender_preview.py", folder, user=folder / "user")
    pictures = {path.stem: np.load(path)[::-1, :, :3] for path in folder.glob("*.npy")}
    return json.loads((folder / "facts.json").read_text()) | pictures


def where(picture: np.ndarray, sky: float = 0.0515) -> float:
    """The column around which the cube is."""
    there = (np.abs(picture.mean(axis=2) - sky) > 0.01).sum(axis=0)
    return there @ np.arange(len(there)) / there.sum()


def test_a_pixel_covers_as_many_of_the_screen_as_blender_says(seen):
    assert seen["first"].shape == (36, 64, 3)


def test_the_cube_goes_to_the_left_when_the_view_turns_to_the_right(seen):
    assert where(seen["turned"]) < where(seen["first"]) - 5


def test_turning_the_view_builds_no_scene(seen):
    assert seen["built after turning"] == 1


def test_a_view_that_stays_goes_on(seen):
    assert seen["went on"]


def test_a_change_of_the_scene_begins_anew(seen):
    assert seen["stopped"]
    assert seen["first"].std() > 0.02
    assert seen["empty"].std() < 0.002


def test_redraws_are_asked_for_until_the_end(seen):
    assert seen["redraws"] >= 2
    assert seen["text"].endswith("samples per pixel")
