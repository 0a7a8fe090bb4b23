"""The extension for Blender: coats of the Principled BSDF, beside Cycles."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from blender_pictures import picture
from blender_run import run

pytestmark = pytest.mark.skipif(
    not importlib.util.find_spec("bpy"), reason="needs bpy (pip install bpy)"
)
ROW, COLUMN = np.mgrid[0:36, 0:64]
BALL = np.hypot(ROW - 17.5, COLUMN - 31.5) < 14.5  #: the pixels that show nothing else


@pytest.fixture(scope="module")
def rendered(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("coats")
    run("blender_coats.py", folder, user=folder / "user")
    return folder


def seen(rendered: Path, name: str, *kinds: str) -> list[np.ndarray]:
    return [picture(rendered / f"{name}{kind}.exr")[BALL] for kind in kinds]


@pytest.mark.parametrize(
    "name", ["smooth", "rough", "dense", "half", "tinted", "metal", "dark-metal", "glowing"]
)
def test_what_a_coat_changes_is_what_it_changes_in_cycles(rendered, name):
    ours, bare, theirs, without = seen(rendered, name, "", "-bare", "-cycles", "-without")
    ours, bare, theirs, without = (i.mean(axis=0) for i in (ours, bare, theirs, without))
    np.testing.assert_allclose(ours / bare, theirs / without, rtol=0.06)


@pytest.mark.parametrize("name", ["smooth", "dense", "half", "tinted", "dark-metal", "glowing"])
def test_a_coat_is_seen_where_it_is_in_cycles(rendered, name):
    ours, theirs, without = seen(rendered, name, "", "-cycles", "-without")
    assert np.abs(ours - theirs).mean() < 0.6 * np.abs(without - theirs).mean()
