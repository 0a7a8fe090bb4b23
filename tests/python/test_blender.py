"""Files of glTF and USD that Blender exports, compared with what Blender itself sees."""

import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest
from blender_run import run

import pymlt as mlt

pytestmark = [
    pytest.mark.skipif(not importlib.util.find_spec("bpy"), reason="needs bpy (pip install bpy)"),
    pytest.mark.skipif(not importlib.util.find_spec("pygltflib"), reason="needs pymlt[gltf]"),
]

NEEDS_USD = pytest.mark.skipif(not importlib.util.find_spec("pxr"), reason="needs pymlt[usd]")
GLOW = "ignore:.*glow do so on the side of their normals"


@pytest.fixture(scope="module")
def exported(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("blender")
    run("blender_scene.py", folder, user=folder / "user")
    return folder


@pytest.mark.filterwarnings(GLOW)
@pytest.mark.parametrize(
    "name", ["scene.glb", "scene.gltf", pytest.param("scene.usdc", marks=NEEDS_USD)]
)
@pytest.mark.filterwarnings("ignore:.*spot light falls off")
@pytest.mark.filterwarnings("ignore:.*the angle of distant lights")
def test_a_scene_of_blender_is_seen_as_blender_sees_it(exported, name):
    width, height = 32, 18
    scene = mlt.load(exported / name, size=(width, height))
    assert scene.info()["emitters"] == 4
    y, x = np.mgrid[0:height, 0:width] + 0.5
    rays = scene.camera_rays(np.stack([x.ravel(), y.ravel()], axis=1))
    found = scene.intersect(*rays)
    expected = json.loads((exported / "seen.json").read_text())
    hit = np.array([place is not None for place in expected])
    # Rays that graze an edge may end on either side of it.
    assert (np.isfinite(found["distance"]) == hit).mean() > 0.99
    both = hit & np.isfinite(found["distance"])
    theirs = np.array([place for place, there in zip(expected, both, strict=True) if there])
    # z is up in Blender, y here.
    theirs = theirs[:, [0, 2, 1]] * [1, 1, -1]
    close = np.linalg.norm(found["position"][both] - theirs, axis=1) < 1e-3
    assert both.sum() > 200
    assert close.mean() > 0.99
    assert (mlt.render(scene, "path", spp=1) > 0).any()


@pytest.mark.filterwarnings(GLOW)
@pytest.mark.parametrize("lamp", ["POINT", "SUN", "SPOT", "glow"])
@pytest.mark.filterwarnings("ignore:.*spot light falls off")
def test_a_scene_is_as_bright_as_in_cycles(exported, lamp):
    theirs = mlt.read_image(exported / f"{lamp}.exr")[..., :3]
    ours = mlt.render(mlt.load(exported / f"{lamp}.glb", size=(64, 36)), "path", spp=64, seed=1)
    assert brightness(ours, theirs) == pytest.approx(1, rel=0.05)


#: Blender writes a quarter of the strength of suns.
LAMPS = {"POINT": 1, "SUN": 0.25, "SPOT": 1, "AREA": 1, "glow": 1}


@NEEDS_USD
@pytest.mark.parametrize("lamp", LAMPS)
@pytest.mark.filterwarnings("ignore:.*spot light falls off")
@pytest.mark.filterwarnings("ignore:.*a sphere light with a cone becomes a spot")
@pytest.mark.filterwarnings("ignore:.*the angle of distant lights")
def test_a_scene_of_usd_is_as_bright_as_in_cycles(exported, lamp):
    theirs = mlt.read_image(exported / f"{lamp}.exr")[..., :3]
    ours = mlt.render(mlt.load(exported / f"{lamp}.usdc", size=(64, 36)), "path", spp=64, seed=1)
    assert brightness(ours, theirs) == pytest.approx(LAMPS[lamp], rel=0.05)


def brightness(ours: np.ndarray, theirs: np.ndarray) -> float:
    """How bright an image is, where another one is not dark, over that one: the median."""
    lit = theirs > 0.05 * theirs.max()
    assert lit.mean() > 0.1
    return float(np.median(ours[lit] / theirs[lit]))
