"""Error metrics on images whose errors are known in closed form."""

import numpy as np
import pytest
from scipy import stats

import pymlt as mlt
from pymlt.cli.compare import METRICS


def test_a_constant_error_has_the_metrics_of_its_formulas():
    r = np.full((8, 10, 3), 0.5)
    metrics = mlt.compare(r + 0.2, r, flip=False)
    assert metrics["mse"] == pytest.approx(0.04)
    assert metrics["rmse"] == pytest.approx(0.2)
    assert metrics["relmse"] == pytest.approx(0.04 / 0.26)
    assert metrics["mape"] == pytest.approx(0.2 / 0.51)
    assert metrics["bias_z"] > 1e6


def test_equal_images_have_no_error():
    image = np.random.default_rng(1).random((9, 7, 3))
    assert set(mlt.compare(image, image, flip=False).values()) == {0.0}


def test_trimming_drops_the_worst_thousandth():
    r = np.ones((100, 100, 3))
    a = r.copy()
    a[:2, :5] = 1e6  # 10 of 10 000 pixels
    a[50, 50] = 1.1
    metrics = mlt.compare(a, r, flip=False)
    assert metrics["relmse"] > 1e6
    assert metrics["relmse_trimmed"] == pytest.approx(0.01 / 1.01 / 9990)


def test_quantiles_are_over_the_pixels_whose_channels_are_averaged():
    r = np.ones((10, 10, 3))
    a = r.copy()
    a[..., 1] += np.sqrt(np.random.default_rng(6).permutation(100)).reshape(10, 10)
    metrics = mlt.compare(a, r, flip=False)
    assert metrics["relmse_median"] == pytest.approx(49.5 / 1.01 / 3)
    assert metrics["relmse_p90"] == pytest.approx(89.1 / 1.01 / 3)


def test_a_firefly_moves_the_mean_but_no_quantile():
    r = np.ones((20, 20, 3))
    a = r + 0.1
    before = mlt.compare(a, r, flip=False)
    a[3, 4] = 1e6
    after = mlt.compare(a, r, flip=False)
    assert after["relmse"] > 1e6 * before["relmse"]
    for name in ("relmse_median", "relmse_p90"):
        assert after[name] == before[name] == pytest.approx(0.01 / 1.01)


def test_bias_z_is_a_standard_normal_number_without_bias_and_large_with_it():
    rng = np.random.default_rng(2)
    zero = np.zeros((64, 64, 3))
    noise = [rng.normal(size=zero.shape) for _ in range(300)]
    z = [mlt.compare(n, zero, flip=False)["bias_z"] for n in noise]
    assert stats.kstest(z, "norm").pvalue > 1e-3
    biased = [mlt.compare(n + 0.1, zero, flip=False)["bias_z"] for n in noise[:20]]
    assert min(biased) > 4


def test_grey_images_and_alpha_are_understood():
    rgb = np.random.default_rng(3).random((6, 6, 3))
    rgba = np.dstack([rgb, np.zeros((6, 6))])
    assert mlt.compare(rgba, rgb, flip=False)["mse"] == 0
    assert mlt.compare(rgb[..., 0], rgb[..., :1], flip=False)["mse"] == 0


def test_files_are_read(tmp_path):
    image = np.random.default_rng(4).random((6, 8, 3)).astype(np.float32)
    mlt.write_image(tmp_path / "a.exr", image)
    mlt.write_image(tmp_path / "b.exr", image + 1)
    metrics = mlt.compare(tmp_path / "b.exr", str(tmp_path / "a.exr"), flip=False)
    assert metrics["mse"] == pytest.approx(1, rel=1e-5)


@pytest.mark.parametrize("other", [np.zeros((4, 5, 3)), np.zeros((5, 4, 1)), np.zeros(7)])
def test_images_that_do_not_fit_together_are_refused(other):
    with pytest.raises(mlt.UsageError):
        mlt.compare(np.zeros((5, 4, 3)), other)


def test_flip_grows_with_the_error():
    pytest.importorskip("flip_evaluator")
    rng = np.random.default_rng(5)
    r = rng.random((32, 32, 3))
    small, large = (mlt.compare(r + s * rng.random(r.shape), r)["flip"] for s in (0.05, 0.5))
    assert 0 < small < large < 1


def test_the_command_knows_all_metrics():
    flat = np.ones((4, 4, 3))
    assert set(METRICS) == {*mlt.compare(flat, flat, flip=False), "flip"}
