"""The tone curves of other programs: AgX, ACES 2, the views of OpenColorIO."""

import re

import numpy as np
import pytest

import pymlt as mlt
from pymlt import cli
from pymlt.pictures.ocio import _views
from pymlt.pictures.tonemapping import encode_srgb

# What Blender 5.0's view AgX shows on its display sRGB, as codes from 0 to 1.
BLENDER = {
    (0.18, 0.18, 0.18): (0.4613, 0.4613, 0.4613),
    (1, 1, 1): (0.7710, 0.7710, 0.7710),
    (0.5, 0.3, 0.2): (0.6720, 0.5646, 0.4949),
    (2, 1.5, 3): (0.8486, 0.8325, 0.8937),
    (0.02, 0.05, 0.04): (0.1274, 0.2218, 0.1981),
}
SATURATED = {
    (1, 0, 0): (0.8580, 0.2241, 0.1292),
    (0, 0, 1): (0.0791, 0.3376, 0.8215),
    (16, 0, 0): (1.0000, 0.8061, 0.7779),
    (0, 16, 0): (0.8844, 1.0000, 0.8524),
    (0, 0, 16): (0.7698, 0.8232, 1.0000),
}

# A configuration whose light is ACEScg, with a display that shows it as it is.
CONFIG = """
ocio_profile_version: 2.1
roles: {scene_linear: ACEScg, aces_interchange: ACES2065-1, default: ACEScg}
displays:
  Cinema:
    - !<View> {name: As it is, colorspace: ACEScg}
    - !<View> {name: Wide, colorspace: ACES2065-1}
  Desk: [!<View> {name: As it is, colorspace: ACES2065-1}]
colorspaces:
  - !<ColorSpace> {name: ACES2065-1, encoding: scene-linear}
  - !<ColorSpace>
    name: ACEScg
    encoding: scene-linear
    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}
"""
RED_IN_ACESCG = [0.6131, 0.0702, 0.0206]
RED_IN_ACES = [0.4396, 0.0898, 0.0175]
RED = np.array([[[1.0, 0, 0]]], dtype=np.float32)


def shown(light, curve) -> np.ndarray:
    """The codes of some lights, each RGB."""
    return encode_srgb(mlt.tonemap(np.array([light], dtype=np.float32), curve))[0]


@pytest.mark.parametrize(("colours", "tolerance"), [(BLENDER, 0.005), (SATURATED, 0.04)])
def test_agx_is_that_of_blender(colours, tolerance):
    found = shown(list(colours), "agx")
    assert found == pytest.approx(np.array(list(colours.values())), abs=tolerance)


def test_aces_shows_middle_grey_with_ten_of_a_hundred_nits():
    assert mlt.tonemap(np.full((1, 1, 3), 0.18), "aces2") == pytest.approx(0.1, abs=1e-4)
    assert mlt.tonemap(np.full((1, 1), 0.18), "aces2") == pytest.approx(0.1, abs=1e-4)


@pytest.mark.parametrize("curve", ["agx", "aces2"])
def test_bright_primaries_lose_their_saturation_and_keep_their_order(curve):
    stops = np.exp2(np.linspace(-8, 8, 65))
    for channel in range(3):
        ramp = np.eye(3)[channel] * stops[:, None]
        seen = shown(ramp, curve)
        assert (np.diff(seen.max(axis=1)) > -2e-3).all()
        assert (seen.argmax(axis=1)[8:50] == channel).all()
        at_16 = shown([16 * np.eye(3)[channel]], curve)[0]
        assert at_16.max() > 0.95
        assert at_16.min() > 0.6
        assert mlt.tonemap(16 * np.eye(3)[None, channel : channel + 1], "filmic").min() == 0


@pytest.fixture
def config(tmp_path, monkeypatch) -> str:
    monkeypatch.delenv("OCIO", raising=False)
    (tmp_path / "config.ocio").write_text(CONFIG)
    return str(tmp_path / "config.ocio")


@pytest.mark.parametrize(
    ("view", "codes"),
    [
        ("Cinema/As it is", RED_IN_ACESCG),
        ("As it is", RED_IN_ACESCG),
        ("Wide", RED_IN_ACES),
        ("Desk/As it is", RED_IN_ACES),
    ],
)
def test_the_codes_of_any_view_are_written(view, codes, config, tmp_path, monkeypatch):
    curves = [f"ocio:{view}@{config}", f"ocio:{view}"]
    monkeypatch.setenv("OCIO", config)
    for curve in curves:
        assert shown(RED[0], curve)[0] == pytest.approx(codes, abs=1e-4)
        mlt.write_image(tmp_path / "a.tif", RED, tonemap=curve, bits=16)
        stored = encode_srgb(mlt.read_image(tmp_path / "a.tif"))[0, 0]
        assert stored == pytest.approx(codes, abs=1e-4)


def test_without_a_file_the_views_are_those_of_aces(monkeypatch):
    monkeypatch.delenv("OCIO", raising=False)
    assert np.array_equal(
        shown(list(BLENDER), "ocio:ACES 2.0 - SDR 100 nits (Rec.709)"),
        shown(list(BLENDER), "aces2"),
    )


def test_a_configuration_of_ones_own_does_not_change_aces(config, monkeypatch):
    before = shown(list(SATURATED), "aces2")
    monkeypatch.setenv("OCIO", config)
    assert np.array_equal(shown(list(SATURATED), "aces2"), before)


@pytest.mark.parametrize(
    ("curve", "message"),
    [
        ("ocio:Cinema/As it was@FILE", "no view 'Cinema/As it was'; did you mean 'Cinema/As it is"),
        ("ocio:@FILE", "valid are: .*Desk/As it is, As it is, Wide"),
        ("ocio:As it is@none.ocio", "none.ocio.*; use an OpenColorIO configuration"),
        ("ocio:As it is@broken.ocio", "broken.ocio.*; use an OpenColorIO configuration"),
    ],
)
def test_views_that_there_are_not_are_named(curve, message, config, scene, capsys, tmp_path):
    (tmp_path / "broken.ocio").write_text("displays: [")
    curve = curve.replace("FILE", config)
    with pytest.raises(mlt.UsageError, match=message):
        mlt.tonemap(RED, curve)
    assert cli.main(["render", scene, "-o", "a.png", "--tonemap", curve]) == 2
    error = capsys.readouterr().err
    assert re.search(message, error)
    assert error.count("\n") == 1


def test_a_configuration_that_does_not_say_what_light_is_is_refused(config, tmp_path):
    closed = tmp_path / "closed.ocio"
    closed.write_text(CONFIG.replace("aces_interchange: ACES2065-1, ", ""))
    with pytest.raises(mlt.UsageError, match=r"closed.ocio: .*interchange"):
        mlt.tonemap(RED, f"ocio:Cinema/As it is@{closed}")


def test_an_old_openimageio_is_refused(config, monkeypatch):
    oiio = pytest.importorskip("OpenImageIO")
    monkeypatch.setattr(oiio, "VERSION", 30119)
    _views.cache_clear()
    for curve in "aces2", f"ocio:Wide@{config}":
        with pytest.raises(mlt.UsageError, match=r"install 'OpenImageIO>=3\.2'"):
            mlt.tonemap(RED, curve)


def test_the_command_line_takes_views(scene, config):
    render = ["render", scene, "--spp", "1", "-o", "a.exr", "-o", "a.png", "--tonemap"]
    for curve in "agx", "aces2", f"ocio:Cinema/As it is@{config}":
        assert cli.main([*render, curve]) == 0
        expected = mlt.tonemap(mlt.read_image("a.exr"), curve)
        assert mlt.read_image("a.png") == pytest.approx(expected, abs=0.005)
