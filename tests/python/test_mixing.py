"""Light groups, mixed without a render: images and layers are made by hand."""

import numpy as np
import pytest

import pymlt as mlt
from pymlt import cli

SHAPE = (6, 8)
NAMES = ["sun", "lamp", "my-lamp"]
TEXTS = {"seed": "1", "spp": "4", "integrator": '{"type": "path"}', "scene": "0", "software": "x"}
TEXTS |= {"light_groups": " ".join(NAMES)}
LIT = ["error", "error_block", "chains", "samples", "raw.s1.t1", "weighted.s1.t1"]


def made(**more) -> mlt.Result:
    """A render of light groups whose sum is not exact in floats."""
    rng = np.random.default_rng(1)
    lights = {f"light.{n}": rng.exponential(1, (*SHAPE, 3)).astype(np.float32) for n in NAMES}
    image = np.zeros((*SHAPE, 3), dtype=np.float32)
    for light in lights.values():
        image += light
    others = {n: rng.random((*SHAPE, 3), dtype=np.float32) for n in ["albedo", "sh_normal", *LIT]}
    alpha = {"alpha": np.full((*SHAPE, 1), 0.5, dtype=np.float32)}
    stats = {"seed": 1, "spp_done": 4.0, "size": [8, 6], "error": 0.1}
    layers = lights | others | alpha | more
    return mlt.Result(image, stats, {"type": "path"}, layers, dict(TEXTS))


@pytest.fixture
def result() -> mlt.Result:
    return made()


@pytest.fixture
def path(result, tmp_path, monkeypatch) -> str:
    monkeypatch.chdir(tmp_path)
    result.write("room.exr")
    return "room.exr"


def expected(result, **factors):
    total = np.zeros((*SHAPE, 3))
    for name in NAMES:
        total += np.float64(result.layers[f"light.{name}"]) * factors.get(name, 1)
    return total


@pytest.mark.parametrize(
    "factors",
    [
        {"lamp": 2},
        {"lamp": 0},
        {"lamp": 2, "sun": (1, 0.5, 0.2)},
        {"my-lamp": np.float32(0.25), "sun": [0, 0, 3]},
    ],
)
def test_the_image_is_the_sum_of_its_groups_times_their_factors(result, path, factors):
    for source in (result, path):
        mixed = mlt.mix(source, **factors)
        assert mixed.image.dtype == np.float32
        np.testing.assert_allclose(mixed.image, expected(result, **factors), rtol=1e-6)
        assert abs(mixed.image - result.image).max() > 0.1


def test_no_light_is_black(result):
    assert not mlt.mix(result, **dict.fromkeys(NAMES, 0)).image.any()


def test_factors_of_one_give_the_image_bit_for_bit(result, path):
    for factors in {}, {"lamp": 1}, dict.fromkeys(NAMES, (1, 1.0, 1)):
        for source in (result, path):
            mixed = mlt.mix(source, **factors)
            assert np.array_equal(mixed.image, result.image)
            assert "mixed" not in mixed.metadata


def test_what_is_mixed_is_mixed_again(result, tmp_path):
    mlt.mix(result, lamp=4, sun=(1, 0.5, 0.25)).write(tmp_path / "a.exr")
    again = mlt.mix(tmp_path / "a.exr", lamp=0.5, sun=(1, 2, 4))
    np.testing.assert_allclose(again.image, expected(result, lamp=2), rtol=1e-6)
    assert again.metadata["mixed"] == "lamp=4 sun=1,0.5,0.25; lamp=0.5 sun=1,2,4"
    assert again.metadata["light_groups"] == result.metadata["light_groups"]
    with pytest.raises(mlt.UsageError, match="is mixed; merge first"):
        mlt.merge([again])


def test_layers_that_are_no_longer_true_are_left_out(result, path):
    for source in (result, path):
        mixed = mlt.mix(source, lamp=2)
        kept = {"albedo", "sh_normal", "alpha", *(f"light.{name}" for name in NAMES)}
        assert mixed.layers.keys() == kept
        assert np.array_equal(mixed.layers["albedo"], result.layers["albedo"])
        assert np.array_equal(mixed.layers["light.lamp"], 2 * result.layers["light.lamp"])
        assert "error" not in mixed.stats
        assert repr(mixed) == "Result(path, 8 x 6, 4 spp)"
    assert set(LIT) <= result.layers.keys()


@pytest.mark.parametrize("layers", [("noisy",), ("unfiltered",), ("noisy", "unfiltered")])
def test_of_a_denoised_image_the_groups_are_mixed_as_they_were(layers):
    raw = made().image
    result = made(**dict.fromkeys(layers, raw))
    result.layers[layers[0]] = raw + 1
    result.layers[layers[-1]] = raw
    result.image = raw + 2
    result.metadata |= {"denoised": "by hand", "fireflies": "groups"}
    mixed = mlt.mix(result, lamp=1)
    assert np.array_equal(mixed.image, raw)
    assert not {"denoised", "fireflies"} & mixed.metadata.keys()
    assert not {"noisy", "unfiltered"} & mixed.layers.keys()


def test_mistakes_are_named(result):
    with pytest.raises(mlt.UsageError, match="no light group 'lmap'; it has lamp, my-lamp, sun"):
        mlt.mix(result, lmap=2)
    for factor in (-1, np.nan, np.inf, "bright", (1, 2), None, (1, 2, -3)):
        with pytest.raises(mlt.UsageError, match=r"the factor of 'lamp' is .*three of them"):
            mlt.mix(result, lamp=factor)
    bare = mlt.Result(result.image, result.stats, result.integrator, {}, {})
    with pytest.raises(mlt.UsageError, match="has no light groups; render with --light-groups"):
        mlt.mix(bare, lamp=2)


def test_files_are_named_in_errors(path, result):
    with pytest.raises(mlt.UsageError, match=r"room\.exr has no light group 'lmap'"):
        mlt.mix(path, lmap=2)
    mlt.write_image("plain.exr", result.image)
    with pytest.raises(mlt.UsageError, match=r"plain\.exr has no light groups"):
        mlt.mix("plain.exr", lamp=2)
    mlt.write_image("plain.png", result.image)
    for name in "plain.png", "none.exr":
        with pytest.raises(mlt.FileError, match=name):
            mlt.mix(name, lamp=2)


def test_the_command_line_mixes(path, result, capsys):
    factors = ["lamp=2", "sun=1,.5,.2"]
    assert cli.main(["mix", path, *factors, "-o", "a.exr"]) == 0
    assert "lamp=2 sun=1,0.5,0.2: a.exr" in capsys.readouterr().err
    mixed = mlt.mix(path, lamp=2, sun=(1, 0.5, 0.2))
    assert np.array_equal(mlt.read_image("a.exr")[..., :3], mixed.image)
    assert mlt.read_metadata("a.exr")["mixed"] == "lamp=2 sun=1,0.5,0.2"
    flags = ["--bits", "16", "--tonemap", "agx", "--exposure", "1"]
    assert cli.main(["mix", path, *factors, "-o", "a.png", *flags]) == 0
    mixed.write("b.png", 1, tonemap="agx", bits=16)
    with open("a.png", "rb") as a, open("b.png", "rb") as b:
        assert a.read() == b.read()


@pytest.mark.parametrize(
    ("factors", "message"),
    [
        (["lamp"], "lamp"),
        (["lamp=bright"], "'lamp=bright' has no factor; use lamp=2 or lamp=1,.5,.2"),
        (["lamp=1,2"], "use lamp=2 or lamp=1,.5,.2"),
        (["lamp=-1"], "should be a number that is not negative"),
        (["lamp=1", "lamp=2"], "'lamp' is given twice"),
        (["lmap=1"], "it has lamp, my-lamp, sun"),
        ([], "NAME=FACTOR"),
    ],
)
def test_mistakes_on_the_command_line_are_one_line(path, factors, message, capsys):
    assert cli.main(["mix", path, *factors, "-o", "a.exr"]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
