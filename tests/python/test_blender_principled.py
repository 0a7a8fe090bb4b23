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
AWAY = np.hypot(ROW, COLUMN) / SIDE  #: from the middle of the ball, whose radius is 0.38
BALL = AWAY < 0.33  #: the pixels in which nothing else is seen


@pytest.fixture(scope="module")
def rendered(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("principled")
    run("blender_principled.py", folder, str(SIDE), user=folder / "user")
    return folder


# Rough glass of Cycles keeps 0.94 of the light in a white furnace, wax has no interface there, and
# films have other colours in Blender 4.2.
@pytest.mark.parametrize(
    ("name", "most"),
    [("plastic", 0.05), ("metal", 0.05), ("paint", 0.05), ("cloth", 0.05), ("glass", 0.1),
     ("wax", 0.08), ("film", 0.1), ("brushed", 0.05), ("tinted", 0.05), ("glowing", 0.05),
     ("metallic", 0.05)],
)  # fmt: skip
def test_a_ball_is_that_of_cycles(rendered, name, most):
    if not (rendered / f"{name}.exr").exists():
        pytest.skip("Blender has no such shader")
    ours, theirs = (picture(rendered / f"{name}{kind}.exr") for kind in ("", "-cycles"))
    np.testing.assert_allclose(ours[BALL].mean(axis=0), theirs[BALL].mean(axis=0), rtol=most)
    # Highlights and colours that are elsewhere change more than that.
    apart = np.abs(blocks(ours, 4) - blocks(theirs, 4)).mean() / theirs.mean()
    assert apart < most


def test_an_edge_tint_is_seen_near_the_silhouette(rendered):
    ours, theirs = (picture(rendered / f"metal{kind}.exr") for kind in ("", "-cycles"))
    edge = (AWAY > 0.28) & (AWAY < 0.36)
    np.testing.assert_allclose(ours[edge].mean(axis=0), theirs[edge].mean(axis=0), rtol=0.05)
