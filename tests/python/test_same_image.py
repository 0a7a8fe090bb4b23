"""The harness that compares images finds what differs, and only that."""

import numpy as np
import pytest
from same_image import FULL, QUICK, Blocks, assert_same_image, block_means, compare, measure

PICTURE = np.random.default_rng(7).uniform(0.2, 2, (24, 32, 3))


def renderer(picture, noise=0.3):
    """A fake: each sample is the picture with noise on it that is skewed, as light paths are."""

    def render(spp, seed):
        rng = np.random.default_rng(seed)
        return picture * (1 + noise * (rng.gamma(spp, size=picture.shape) / spp - 1))

    return render


def test_equal_images_pass():
    assert_same_image(renderer(PICTURE), renderer(PICTURE), spp=1024)


@pytest.mark.parametrize("factor", [0.985, 1.015])
def test_a_brighter_image_fails(factor):
    with pytest.raises(AssertionError, match="1 x 1 grid"):
        assert_same_image(renderer(factor * PICTURE), renderer(PICTURE), spp=1024)


def test_one_wrong_block_fails():
    wrong = PICTURE.copy()
    wrong[7, 9] *= 1.1
    with pytest.raises(AssertionError, match="24 x 32 grid, block 7, 9"):
        assert_same_image(renderer(wrong), renderer(PICTURE), spp=1024)


def test_noise_does_not_pass_for_agreement():
    with pytest.raises(AssertionError, match="too noisy"):
        assert_same_image(renderer(PICTURE), renderer(PICTURE), spp=16)


def test_an_error_that_is_known_counts_only_beyond_its_size():
    assert_same_image(renderer(1.003 * PICTURE), renderer(PICTURE), spp=1024, systematic=0.004)
    with pytest.raises(AssertionError, match="1 x 1 grid"):
        assert_same_image(renderer(1.02 * PICTURE), renderer(PICTURE), spp=1024, systematic=0.004)


def test_false_alarms_are_rare():
    """At a level of 1e-3, more than 3 alarms in 300 comparisons have a probability of 0.0003."""
    rng = np.random.default_rng(3)

    def blocks():
        runs = rng.normal(1, 0.1, (16, 61, 3))
        return Blocks(QUICK, runs.mean(0), runs.std(0, ddof=1) / 4, 16)

    assert sum(bool(compare(blocks(), blocks()).rejected) for _ in range(300)) <= 3


def test_the_promised_power_is_there():
    """A difference of the size said to be found in 90 % of the cases is found in most."""
    rng = np.random.default_rng(4)

    def blocks(mean):
        runs = rng.normal(mean, 0.1, (16, 1, 1))
        return Blocks(((1, 1),), runs.mean(0), runs.std(0, ddof=1) / 4, 16)

    size = np.mean([compare(blocks(1), blocks(1)).whole_image for _ in range(200)])
    found = sum(bool(compare(blocks(1 + size), blocks(1)).rejected) for _ in range(200))
    assert 160 <= found <= 198


def test_blocks_of_unequal_size_are_means_too():
    image = np.arange(7 * 5 * 3, dtype=float).reshape(7, 5, 3)
    means = block_means(image, ((1, 1), (2, 3)))
    assert means[0] == pytest.approx(image.mean(axis=(0, 1)))
    assert means[1] == pytest.approx(image[:3, :1].mean(axis=(0, 1)))
    assert means[6] == pytest.approx(image[3:, 3:].mean(axis=(0, 1)))


def test_a_finer_measurement_holds_the_coarser_one():
    blocks = measure(lambda seed: renderer(PICTURE)(4, seed), FULL, range(16))
    kept = blocks.at(QUICK[:2])
    assert kept.mean.shape == (13, 3)
    assert np.array_equal(kept.mean, blocks.mean[:13])
