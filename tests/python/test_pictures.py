"""Pictures to look at: tone curves, JPEG, comparisons, notebooks."""

import base64
import re
import sys
from pathlib import Path

import numpy as np
import pytest
import tiny

import pymlt as mlt
from pymlt import cli
from pymlt.pictures.tonemapping import stops_of
from pymlt.rendering.notebook import Picture

CURVES = ["srgb", "reinhard", "filmic", "agx", "aces2"]


@pytest.fixture(scope="module")
def result():
    return mlt.start(tiny.scene(), "path", spp=4, seed=1).result()


# ---- tone curves -------------------------------------------------------------------------------


@pytest.mark.parametrize("curve", CURVES)
def test_curves_rise_from_black_to_at_most_white(curve):
    grey = np.concatenate([[0], np.geomspace(1e-4, 1e30, 500)])
    shown = mlt.tonemap(np.repeat(grey[None, :, None], 3, axis=2), curve)
    assert shown.dtype == np.float32
    assert shown[0, 0] == pytest.approx(0)
    assert (np.diff(shown[0, :, 1]) >= 0).all()
    assert 0.99 < shown.max() <= 1


def test_curves_have_the_values_of_their_formulas():
    image = np.array([[[0.2, 1.0, 3.0]]])
    luminance = 0.2126 * 0.2 + 0.7152 + 0.0722 * 3
    assert mlt.tonemap(image, "srgb").ravel() == pytest.approx([0.2, 1, 1])
    expected = np.minimum(image / (1 + luminance), 1)
    assert mlt.tonemap(image, "reinhard") == pytest.approx(expected)
    assert mlt.tonemap(np.full((1, 1, 3), 1.0)).max() == pytest.approx(2.54 / 3.16)
    assert mlt.tonemap(np.full((1, 1), 0.18)).item() == pytest.approx(0.267, abs=1e-3)


@pytest.mark.parametrize("curve", CURVES)
def test_exposure_is_in_stops_and_alpha_stays(curve):
    rgba = np.random.default_rng(1).random((3, 4, 4))
    shown = mlt.tonemap(rgba, curve, exposure=2)
    assert shown[..., :3] == pytest.approx(mlt.tonemap(4 * rgba[..., :3], curve))
    assert shown[..., 3] == pytest.approx(rgba[..., 3])
    assert mlt.tonemap(rgba[..., 0], curve).shape == (3, 4)


def test_an_exposure_that_suits_shows_nineteen_pixels_of_twenty_below_white():
    image = np.random.default_rng(1).permutation(1000.0 + np.arange(4000)).reshape(80, 50)
    image.flat[:4] = 1e30
    shown = mlt.tonemap(image, "srgb", exposure="auto")
    assert np.quantile(shown, 0.95) == pytest.approx(0.8, abs=0.001)


def test_every_picture_takes_an_exposure_that_suits(tmp_path, result):
    stops = stops_of("auto", result.image)
    assert stops != 0
    for name in "a.png", "a.jpg":
        result.write(tmp_path / f"auto-{name}", "auto", tonemap="filmic")
        result.write(tmp_path / f"stops-{name}", stops, tonemap="filmic")
        auto, given = ((tmp_path / f"{kind}-{name}").read_bytes() for kind in ("auto", "stops"))
        assert auto == given
    mlt.write_image(tmp_path / "b.png", result.image, exposure="auto")
    mlt.write_image(tmp_path / "c.png", result.image, exposure=stops)
    assert (tmp_path / "b.png").read_bytes() == (tmp_path / "c.png").read_bytes()


def test_samples_that_are_no_numbers_are_black():
    shown = mlt.tonemap(np.array([[np.nan, -1, np.inf, 1e300]]), "filmic")
    assert shown[0] == pytest.approx([0, 0, 1, 1])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"curve": "filmik"}, "did you mean 'filmic'"),
        (
            {"curve": "xyzxyz"},
            "valid are: srgb, reinhard, filmic, agx, aces2, ocio:DISPLAY/VIEW@FILE",
        ),
        ({"exposure": 129}, "-128 and 128"),
        ({"exposure": np.nan}, "-128 and 128"),
        ({"exposure": "bright"}, "'auto'"),
    ],
)
def test_mistakes_in_tone_curves_are_named(arguments, message):
    with pytest.raises(mlt.UsageError, match=message):
        mlt.tonemap(np.zeros((2, 2, 3)), **arguments)


# ---- files -------------------------------------------------------------------------------------


def codes(path) -> np.ndarray:
    """The 8-bit samples of a file."""
    oiio = pytest.importorskip("OpenImageIO")
    return oiio.ImageInput.open(str(path)).read_image("uint8").astype(int)


@pytest.mark.parametrize("curve", CURVES)
def test_png_and_jpeg_show_the_same(curve, tmp_path):
    y, x = np.mgrid[0:48, 0:64] / 32
    image = np.stack([x, y, 0.2 + x * y], axis=2).astype(np.float32)
    for name in "a.png", "a.jpg", "b.JPEG":
        mlt.write_image(tmp_path / name, image, exposure=1, tonemap=curve)
    assert (tmp_path / "a.jpg").read_bytes()[:3] == b"\xff\xd8\xff"
    assert (tmp_path / "a.jpg").read_bytes() == (tmp_path / "b.JPEG").read_bytes()
    assert abs(codes(tmp_path / "a.png") - codes(tmp_path / "a.jpg")).mean() < 1
    shown = mlt.tonemap(image, curve, exposure=1)
    assert mlt.read_image(tmp_path / "a.png") == pytest.approx(shown, abs=0.005)


def test_grey_is_written_as_jpeg_and_alpha_is_refused(tmp_path):
    mlt.write_image(tmp_path / "a.jpg", np.full((8, 8), 0.5))
    assert mlt.read_image(tmp_path / "a.jpg") == pytest.approx(0.5, abs=0.01)
    with pytest.raises(mlt.UsageError, match="use PNG"):
        mlt.write_image(tmp_path / "b.jpg", np.zeros((8, 8, 4)))
    assert not (tmp_path / "b.jpg").exists()


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
@pytest.mark.parametrize("extension", ["tif", "TIFF"])
def test_tiff_has_sixteen_bits_and_alpha(channels, extension, tmp_path):
    image = np.random.default_rng(1).random((6, 8, channels)).astype(np.float32)
    path = tmp_path / f"a.{extension}"
    mlt.write_image(path, image, exposure=-1)
    expected = image * [0.5, 0.5, 0.5, 1][:channels]
    if channels in (2, 4):
        expected[..., -1] = image[..., -1]
    np.testing.assert_allclose(read_tiff(path), expected, atol=2e-5)


def read_tiff(path, bits=16) -> np.ndarray:
    """Linear light, and alpha, by which colours are not multiplied; also of a PNG."""
    oiio = pytest.importorskip("OpenImageIO")
    hints = oiio.ImageSpec()
    hints.attribute("oiio:UnassociatedAlpha", 1)
    file = oiio.ImageInput.open(str(path), hints)
    assert str(file.spec().format) == f"uint{bits}"
    stored = file.read_image("float").astype(float)
    linear = np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)
    if linear.shape[2] in (2, 4):
        linear[..., -1] = stored[..., -1]
    return linear


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
@pytest.mark.parametrize(("extension", "bits"), [("png", 16), ("tif", 8)])
def test_pictures_have_the_bits_that_are_asked_for(channels, extension, bits, tmp_path):
    image = np.random.default_rng(1).random((6, 8, channels)).astype(np.float32)
    path = tmp_path / f"a.{extension}"
    mlt.write_image(path, image, exposure=1, tonemap="filmic", bits=bits)
    expected = mlt.tonemap(image, "filmic", exposure=1)
    np.testing.assert_allclose(read_tiff(path, bits), expected, atol=1.2 / 2**bits)
    mlt.write_image(tmp_path / "b.png", image, exposure=1, tonemap="filmic", bits=8)
    mlt.write_image(tmp_path / "c.png", image, exposure=1, tonemap="filmic")
    assert (tmp_path / "b.png").read_bytes() == (tmp_path / "c.png").read_bytes()


def test_a_dark_ramp_is_smooth_in_sixteen_bits_alone(tmp_path):
    ramp = np.linspace(0.01, 0.02, 1000, dtype=np.float32)[None]
    for bits, most in ((8, 14), (16, 1000)):
        mlt.write_image(tmp_path / "a.png", ramp, bits=bits)
        assert len(np.unique(mlt.read_image(tmp_path / "a.png"))) == pytest.approx(most, abs=2)


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_tiff_of_32_bits_is_the_light_itself(channels, tmp_path):
    image = np.random.default_rng(1).normal(0, 1e4, (6, 8, channels)).astype(np.float32)
    mlt.write_image(tmp_path / "a.tif", image, exposure=1, tonemap="filmic", bits=32)
    oiio = pytest.importorskip("OpenImageIO")
    hints = oiio.ImageSpec()
    hints.attribute("oiio:UnassociatedAlpha", 1)
    file = oiio.ImageInput.open(str(tmp_path / "a.tif"), hints)
    assert np.array_equal(file.read_image("float"), image)


@pytest.mark.parametrize(
    ("name", "bits", "message"),
    [
        ("a.jpg", 16, r"\.jpg has no samples of 16 bits; use 8, or \.png or \.tif"),
        ("a.png", 32, r"\.png has no samples of 32 bits; use 8 or 16, or \.tif"),
        ("a.TIF", 12, r"\.tif has no samples of 12 bits; use 8 or 16 or 32$"),
    ],
)
def test_bits_that_a_format_does_not_have_are_refused(name, bits, message, tmp_path):
    with pytest.raises(mlt.UsageError, match=message):
        mlt.write_image(tmp_path / name, np.zeros((2, 2, 3)), bits=bits)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("shape", [(4,), (2, 2, 5), (1, 2, 3, 4)])
@pytest.mark.parametrize("bits", [8, 16, 32])
def test_what_is_no_picture_is_refused(shape, bits, tmp_path):
    with pytest.raises(mlt.UsageError):
        mlt.write_image(tmp_path / "a.tif", np.zeros(shape), bits=bits)


def test_the_command_line_takes_bits(scene, capsys):
    render = ["render", scene, "--spp", "1", "--bits", "16", "-o"]
    assert cli.main([*render, "a.png", "-o", "a.exr"]) == 0
    expected = mlt.tonemap(mlt.read_image("a.exr"), "srgb")
    np.testing.assert_allclose(read_tiff("a.png"), expected, atol=2e-5)
    assert cli.main(["merge", "a.exr", "--force", "--bits", "16", "-o", "b.png"]) == 0
    assert Path("b.png").read_bytes() == Path("a.png").read_bytes()
    capsys.readouterr()
    assert cli.main([*render, "b.jpg"]) == 2
    assert "use 8, or .png or .tif" in capsys.readouterr().err


@pytest.mark.parametrize("curve", CURVES)
def test_tiff_shows_what_png_does(curve, tmp_path, result):
    result.write(tmp_path / "a.png", 1, tonemap=curve)
    result.write(tmp_path / "a.tif", 1, tonemap=curve)
    shown = [mlt.read_image(tmp_path / name) for name in ("a.png", "a.tif")]
    np.testing.assert_allclose(*shown, atol=0.005)
    assert (
        Path(result.save(tmp_path / "b.tif", 1, tonemap=curve)).read_bytes()
        == (tmp_path / "a.tif").read_bytes()
    )


def test_other_extensions_are_refused(tmp_path):
    with pytest.raises(
        mlt.UsageError, match=r"valid are: .exr, .png, .jpg, .jpeg, .tif, .tiff, .hdr"
    ):
        mlt.write_image(tmp_path / "a.gif", np.zeros((2, 2, 3)))


def test_a_jpeg_that_cannot_be_written_is_rescued(tmp_path, monkeypatch, result):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(mlt.FileError, match="no"):
        result.write(tmp_path / "no" / "a.jpg")
    saved = result.save(tmp_path / "no" / "a.jpg", 1, tonemap="filmic")
    result.write(tmp_path / "a.jpg", 1, tonemap="filmic")
    assert (tmp_path / "a.jpg").read_bytes() == Path(saved).read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.jpg", "rescued-a.jpg"]


def test_the_tone_curve_leaves_linear_files_alone(tmp_path, result):
    result.write(tmp_path / "a.exr", tonemap="filmic")
    result.write(tmp_path / "a.hdr", tonemap="filmic")
    assert np.array_equal(mlt.read_image(tmp_path / "a.exr"), result.image)
    assert mlt.read_image(tmp_path / "a.hdr") == pytest.approx(result.image, rel=0.02, abs=0.02)


def test_the_picture_of_the_techniques_has_the_exposure(tmp_path):
    bdpt = mlt.start(tiny.scene(), mlt.BDPT(max_depth=3, techniques=True), spp=1).result()
    for name, curve in {"a": "srgb", "b": "reinhard"}.items():
        bdpt.write(tmp_path / f"{name}.png", 2, tonemap=curve)
    a, b = ((tmp_path / f"{n}.techniques.png").read_bytes() for n in "ab")
    assert a == b
    assert (tmp_path / "a.png").read_bytes() != (tmp_path / "b.png").read_bytes()


def test_the_command_line_writes_tone_mapped_jpeg(scene, tmp_path, result):
    flags = ["--spp", "4", "--seed", "1", "--quiet", "--exposure", "1", "--tonemap", "reinhard"]
    assert cli.main(["render", scene, *flags, "-o", "a.jpg", "-o", "a.exr"]) == 0
    mlt.write_image("b.jpg", mlt.read_image("a.exr"), exposure=1, tonemap="reinhard")
    assert (tmp_path / "a.jpg").read_bytes() == (tmp_path / "b.jpg").read_bytes()
    merge = ["merge", "a.exr", "--force", "-o", "c.jpg", "--exposure", "1"]
    assert cli.main([*merge, "--tonemap", "reinhard"]) == 0
    assert (tmp_path / "c.jpg").read_bytes() == (tmp_path / "b.jpg").read_bytes()


def test_an_unknown_curve_is_one_line(scene, capsys):
    assert cli.main(["render", scene, "-o", "a.png", "--tonemap", "filmik"]) == 2
    error = capsys.readouterr().err
    assert "did you mean 'filmic'" in error
    assert error.count("\n") == 1


# ---- comparisons -------------------------------------------------------------------------------


@pytest.fixture
def pair(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    rng = np.random.default_rng(1)
    for name in "ab":
        mlt.write_image(f"{name}.exr", rng.random((20, 30, 3)).astype(np.float32))
    return ["compare", "a.exr", "b.exr"]


def test_a_comparison_shows_the_maps_and_the_numbers(pair):
    pytest.importorskip("flip_evaluator")
    pytest.importorskip("matplotlib")
    a, b = mlt.read_image("a.exr"), mlt.read_image("b.exr")
    figure = mlt.comparison_figure(a, b, exposure=-1)
    maps = {cell.get_title(): cell.get_images() for cell in figure.axes}
    titles = ["image", "reference", "image - reference", "relative error", "FLIP"]
    shown = [np.asarray(maps[title][0].get_array()) for title in titles]
    assert shown[0].shape == (20, 30, 3)
    assert shown[2] == pytest.approx((a - b).mean(axis=2), abs=1e-6)
    assert shown[3].mean() == pytest.approx(mlt.compare(a, b)["mape"])
    assert shown[4].mean() == pytest.approx(mlt.compare(a, b)["flip"], abs=1e-5)
    text = figure.axes[2].texts[0].get_text()
    assert re.search(rf"rmse +{mlt.compare(a, b)['rmse']:.4g}", text)


def test_grey_images_are_compared(pair):
    pytest.importorskip("flip_evaluator")
    pytest.importorskip("matplotlib")
    grey = np.full((8, 9), 0.5)
    figure = mlt.comparison_figure(grey, grey)
    assert figure.axes[0].get_images()[0].get_array().shape == (8, 9, 3)


def test_compare_draws_a_picture(pair, tmp_path):
    pytest.importorskip("flip_evaluator")
    pytest.importorskip("matplotlib")
    assert cli.main([*pair, "--picture", "c.png", "--tonemap", "filmic"]) == 0
    assert mlt.read_image("c.png").shape[1] == 1300
    assert cli.main([*pair, "--picture", "c.png", "--fail-above", "mse=0"]) == 1


@pytest.mark.parametrize(
    ("module", "command"),
    [("flip_evaluator", "install 'flip-evaluator>="), ("matplotlib", "install 'matplotlib>=")],
)
def test_what_a_picture_needs_is_said_in_one_line(pair, capsys, monkeypatch, module, command):
    monkeypatch.setitem(sys.modules, module, None)
    monkeypatch.delitem(sys.modules, "matplotlib.figure", raising=False)
    assert cli.main([*pair, "--picture", "c.png"]) == 2
    error = capsys.readouterr().err
    assert command in error
    assert error.count("\n") == 1


def test_a_picture_that_cannot_be_written_is_found_before_the_work(pair, capsys):
    pytest.importorskip("matplotlib")
    assert cli.main([*pair, "--picture", "no/c.png"]) == 2
    assert cli.main([*pair, "--picture", "c.xyz"]) == 2
    assert capsys.readouterr().out == ""


# ---- notebooks ---------------------------------------------------------------------------------


def picture_of(html: str, path) -> np.ndarray:
    path.write_bytes(base64.b64decode(re.search(r"base64,([^\"]+)", html)[1]))
    return mlt.read_image(path)


def test_a_result_shows_as_a_picture(result, tmp_path):
    result.write(tmp_path / "a.png")
    assert result._repr_png_() == (tmp_path / "a.png").read_bytes()
    html = result._repr_html_()
    assert np.array_equal(picture_of(html, tmp_path / "b.png"), mlt.read_image(tmp_path / "a.png"))
    assert ", 16 x 12" in html


def test_captions_have_the_error(tmp_path):
    scene = mlt.load_dict(tiny.scene())
    job = mlt.start(scene, "path", spp=32)
    result = job.result()
    error = result._summary().partition(", error ")[2]
    assert re.fullmatch(r"\d+(\.\d+)? %", error)
    assert f", error {error}</figcaption>" in Picture(job, 0)._repr_html_()
    assert f", error {error})</figcaption>" in result._repr_html_()
    assert re.search(r", error [\d.]+ %</figcaption>", scene._repr_html_())


def test_a_scene_shows_as_a_quick_render(tmp_path):
    html = mlt.load_dict(tiny.scene())._repr_html_()
    assert picture_of(html, tmp_path / "a.png").mean() > 0.05
    assert "Scene(16 x 12" in html


def test_a_scene_that_has_no_sample_in_time_shows_what_it_holds(monkeypatch):
    monkeypatch.setattr("pymlt.rendering.preview.SECONDS", 1e-9)
    assert mlt.load_dict(tiny.scene())._repr_html_().startswith("<p>Scene(16 x 12")
