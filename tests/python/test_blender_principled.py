"""The extension for Blender: balls of the Principled BSDF, beside Cycles."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from blender_pictures import blocks, picture
from blender_run import run

pytestmark = pytest.mark.skipif(
    not importlib.util.find_spec("bpy"), reason="needs bpy (pip install bpy)"
)
SIDE = 32
ROW, COLUMN = np.mgrid[0:SIDE, 0:SIDE] - (SIDE - 1) / 2
BALL = np.hypot(ROW, COLUMN) < 0.37 * SIDE  #: the pixels that show nothing else


@pytest.fixture(scope="module")
def rendered(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("principled")
    run("blender_principled.py", folder, str(SIDE), user=folder / "user")
    return folder


# In a white furnace the rough glass of Cycles reflects and transmits 0.94 of the light, and near
# its silhouette 0.86; wax is noisy here.
@pytest.mark.parametrize(
    ("name", "most"),
    [("plastic", 0.05), ("metal", 0.05), ("paint", 0.05), ("cloth", 0.05), ("glass", 0.13),
     ("wax", 0.08), ("film", 0.05), ("brushed", 0.05), ("tinted", 0.05), ("glowing", 0.05)],
)  # fmt: skip
def test_a_ball_is_that_of_cycles(rendered, name, most):
    ours, theirs = (picture(rendered / f"{name}{kind}.exr") for kind in ("", "-cycles"))
    np.testing.assert_allclose(ours[BALL].mean(axis=0), theirs[BALL].mean(axis=0), rtol=most)
    # Highlights and colours that are elsewhere change more than that.
    apart = np.abs(blocks(ours, 4) - blocks(theirs, 4)).mean() / theirs.mean()
    assert apart < most
