"""The layers of EXR files, as other programs read them."""

import importlib.util
import json

import numpy as np
import pytest
import tiny
from blender_run import run

import pymlt as mlt

LAYERS = {"albedo": 3, "depth": 1, "cryptomatte_object00": 4, "spectrum.400-430nm": 1}
LAYERS |= {"light.lamp": 3, "light.sun": 3}


@pytest.fixture(scope="module")
def result() -> mlt.Result:
    """A render with layers of every kind of name."""
    rng = np.random.default_rng(1)
    made = mlt.start(tiny.scene(), "path", spp=1, seed=1).result()
    shape = made.image.shape[:2]
    layers = {n: rng.random((*shape, c), dtype=np.float32) for n, c in LAYERS.items()}
    alpha = np.ones((*shape, 1), dtype=np.float32)
    return mlt.Result(made.image, made.stats, made.integrator, layers | {"alpha": alpha}, {})


@pytest.fixture(scope="module")
def path(result, tmp_path_factory) -> str:
    name = str(tmp_path_factory.mktemp("compositors") / "a.exr")
    result.write(name)
    return name


def test_channels_are_named_by_layer_and_colour(path, result):
    oiio = pytest.importorskip("OpenImageIO")
    file = oiio.ImageInput.open(path)
    names = list(file.spec().channelnames)
    assert not file.seek_subimage(1, 0)  # one part
    assert names[:4] == ["R", "G", "B", "A"]
    expected = {1: ["Y"], 3: ["R", "G", "B"], 4: ["R", "G", "B", "A"]}
    layers = [f"{name}.{c}" for name in sorted(LAYERS) for c in expected[LAYERS[name]]]
    assert names[4:] == layers
    pixels = file.read_image("float")
    for name, channels in LAYERS.items():
        first = names.index(f"{name}.{expected[channels][0]}")
        assert np.array_equal(pixels[..., first : first + channels], result.layers[name])
    assert np.array_equal(pixels[..., :3], result.image)


@pytest.mark.skipif(not importlib.util.find_spec("bpy"), reason="needs bpy (pip install bpy)")
def test_blender_sees_layers_as_passes(path, tmp_path):
    found = tmp_path / "passes.json"
    run("blender_passes.py", path, str(found), "light", "spectrum", user=tmp_path / "user")
    colour, number = "RGBA", "VALUE"
    image = {"Combined": colour, "Alpha": number}
    assert json.loads(found.read_text()) == {
        "": image | {"albedo": colour, "cryptomatte_object00": colour, "depth": number},
        "light": {"lamp": colour, "sun": colour},
        "spectrum": {"400-430nm": number},
    }
