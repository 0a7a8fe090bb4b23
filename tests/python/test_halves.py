"""What two halves of a render tell about a filter, which here is a blur."""

import numpy as np
import pytest

from pymlt.pictures.halves import Pair, best_mixture, covariance, smooth

SIZE = (96, 128)
SAMPLES = 16  # of each half


def blurred(image, sigma=2.0):
    return np.stack([smooth(image[..., c], sigma) for c in range(3)], axis=2)


def scene():
    """Smooth on the left, fine stripes on the right, which a blur destroys."""
    y, x = np.mgrid[0 : SIZE[0], 0 : SIZE[1]]
    smooth_part = 0.5 + 0.3 * np.sin(x / 40) * np.cos(y / 30)
    stripes = np.where((x // 2) % 2 == 0, 0.7, 1.0)
    grey = np.where(x < SIZE[1] // 2, smooth_part, stripes)
    return np.repeat(grey[..., None], 3, axis=2).astype(np.float32)


class Noisy:
    """Two halves of samples that have this relative variance, with the error of their mean."""

    def __init__(self, image, variance, seed):
        rng = np.random.default_rng(seed)
        shape = SAMPLES / variance
        halves = (image * rng.gamma(shape, 1 / shape, (*SIZE, 1)) for _ in range(2))
        self.raw = Pair(*(half.astype(np.float32) for half in halves))
        self.error = (image * np.sqrt(variance / (2 * SAMPLES))).astype(np.float32)

    def mixture(self):
        filtered = Pair(*map(blurred, self.raw))
        return best_mixture(self.raw.mean, self.error, self.raw, self.raw, (filtered, filtered))


def relative_error(found, image):
    grey = image.mean(axis=2)
    squares = ((found - image) ** 2).mean(axis=2)
    return float(np.sqrt((squares / (grey**2 + 0.01 * grey.mean() ** 2)).mean()))


@pytest.mark.parametrize("variance", [0.2, 2.0, 8.0])
def test_the_error_of_a_filter_follows_from_the_other_half(variance):
    image = scene()
    differences = []
    for seed in range(12):
        raw = Noisy(image, variance, seed).raw
        filtered = Pair(*map(blurred, raw))
        found = covariance(filtered, filtered, raw).mean(dtype=float)
        differences.append(found - ((filtered.mean - image) ** 2).mean(dtype=float))
    standard_error = np.std(differences, ddof=1) / np.sqrt(len(differences))
    assert abs(np.mean(differences)) < 4 * standard_error
    assert standard_error < 0.1 * ((filtered.mean - image) ** 2).mean()


def test_the_raw_image_is_the_filter_that_does_nothing():
    raw = Noisy(scene(), 1.0, 1).raw
    assert covariance(raw, raw, raw) == pytest.approx(raw.apart)


@pytest.mark.parametrize(("variance", "most"), [(0.2, 0.8), (2.0, 0.9), (8.0, 1.05)])
def test_a_mixture_is_better_than_the_image_and_than_the_filter(variance, most):
    image = scene()
    noisy = Noisy(image, variance, 3)
    found = noisy.mixture()
    errors = [relative_error(x, image) for x in (noisy.raw.mean, blurred(noisy.raw.mean))]
    assert relative_error(found.image, image) < most * min(errors)


@pytest.mark.parametrize("variance", [0.2, 2.0, 8.0])
def test_a_mixture_knows_its_error(variance):
    image = scene()
    for seed in range(3):
        found = Noisy(image, variance, seed).mixture()
        standard_error = (found.bound**2 - found.relative**2) / 2
        true = relative_error(found.image, image)
        assert abs(found.relative**2 - true**2) < 4 * standard_error
        assert found.relative == pytest.approx(true, rel=0.25)
        # The map: on the left and on the right, where errors are of another size.
        for half in (np.s_[:, :48], np.s_[:, 80:]):
            true = np.sqrt(((found.image - image)[half] ** 2).mean())
            assert 0.8 < np.sqrt((found.error[half] ** 2).mean()) / true < 1.8


def test_halves_that_are_stratified_together_claim_no_less():
    """Half of the noise of A is that of B with the opposite sign."""
    image = scene()
    rng = np.random.default_rng(5)
    common, *own = (0.2 * rng.standard_normal((3, *SIZE, 1))).astype(np.float32)
    raw = Pair(image * (1 + common + own[0]), image * (1 - common + own[1]))
    error = image * np.float32(0.2 / np.sqrt(2))
    filtered = Pair(*map(blurred, raw))
    found = best_mixture(raw.mean, error, raw, raw, (filtered, filtered))
    true = relative_error(found.image, image)
    assert 1 < found.relative / true < 1.5
    independent = best_mixture(raw.mean, np.sqrt(raw.apart), raw, raw, (filtered, filtered))
    assert independent.relative < 0.7 * relative_error(independent.image, image)


def test_a_glint_that_both_halves_see_stays():
    image = np.full((*SIZE, 3), 0.5, np.float32)
    image[40, 50] = 60
    noisy = Noisy(image, 0.2, 7)
    found = noisy.mixture()
    assert found.image[40, 50] == pytest.approx(noisy.raw.mean[40, 50])
    assert abs(found.image[40, 51] - 0.5).max() < 0.05 * 60


def test_a_spark_of_one_half_goes_if_the_filter_removes_it():
    image = np.full((*SIZE, 3), 0.5, np.float32)
    noisy = Noisy(image, 0.2, 8)
    robust = Pair(noisy.raw.first.copy(), noisy.raw.second)
    noisy.raw.first[40, 50] = 60
    noisy.error[40, 50] = 30
    filtered = tuple(Pair(*map(blurred, pair)) for pair in (noisy.raw, robust))
    found = best_mixture(noisy.raw.mean, noisy.error, noisy.raw, robust, filtered)
    assert abs(found.image[40, 50] - 0.5).max() < 1
    assert found.relative < found.bound < 1


def test_a_black_image_has_no_error():
    black = np.zeros((*SIZE, 3), np.float32)
    pair = Pair(black, black)
    found = best_mixture(black, black, pair, pair, (pair, pair))
    assert not found.image.any()
    assert np.isfinite(found.error).all()
    assert found.relative == found.bound == 0
