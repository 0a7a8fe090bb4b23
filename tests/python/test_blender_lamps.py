"""The extension for Blender: the sizes of lamps, and beams with soft edges, beside Cycles."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from blender_pictures import assert_alike, blocks, picture
from blender_run import run

pytestmark = pytest.mark.skipif(
    not importlib.util.find_spec("bpy"), reason="needs bpy (pip install bpy)"
)


@pytest.fixture(scope="module")
def rendered(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("lamps")
    run("blender_lamps.py", folder, user=folder / "user")
    return folder


@pytest.mark.parametrize(
    "name", ["sun", "spot-of-a-size", "spot-blended", "spot-wide", "beam", "beam-round"]
)
def test_a_lamp_has_its_size_and_its_beam(rendered, name):
    ours, theirs, without = (
        picture(rendered / f"{name}{kind}.exr") for kind in ("", "-cycles", "-without")
    )
    assert_alike(ours, theirs)

    def away(image):
        return np.abs(blocks(image, 2) - blocks(theirs, 2)).mean()

    # What the size or the beam changes in Cycles is at least twice what we miss.
    assert away(ours) < 0.5 * away(without)


@pytest.mark.parametrize("name", ["sun", "beam"])
def test_a_lamp_may_be_sheared(rendered, name):
    ours, theirs = (picture(rendered / f"{name}-sheared{kind}.exr") for kind in ("", "-cycles"))
    assert_alike(ours, theirs)
