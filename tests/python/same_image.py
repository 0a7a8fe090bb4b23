"""Do two renders show the same image? A test of significance, with a demand on its power.

Both sides are rendered as independent runs. The means of the runs over the blocks of a grid, at
several scales and for each channel, are compared by Welch's t, all of them together by Holm's
method. A rejection is repeated once with a new seed and four times the samples: bugs get worse,
chance goes away. The harness also computes the difference that it would have found with a
probability of 90 %, and fails if that is too large: noise must not pass for agreement.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy import stats

#: Rows and columns of the blocks, from the whole image to the finest.
QUICK = ((1, 1), (3, 4), (6, 8))
FULL = ((1, 1), (3, 4), (24, 32))
ALL = ((1, 1), (3, 4), (6, 8), (24, 32))

LEVEL = 1e-3  # of a false alarm, for all blocks and channels together
POWER = 0.9
WHOLE_IMAGE, MEDIAN_BLOCK = 0.01, 0.05  # the largest differences that may go unnoticed
SINGLE_PRECISION = 1e-4  # what a renderer in single precision may be off by, relative


@dataclass(frozen=True)
class Blocks:
    """Means of an image over the blocks of some scales, known to a standard error."""

    scales: tuple
    mean: np.ndarray  #: (blocks, channels), scale after scale, rows from the top
    error: np.ndarray  #: of the mean
    runs: float  #: from how many runs the error was estimated

    def at(self, scales) -> Blocks:
        """Only these scales."""
        kept = np.concatenate([np.full(r * c, (r, c) in scales) for r, c in self.scales])
        return Blocks(tuple(scales), self.mean[kept], self.error[kept], self.runs)


def block_means(image: np.ndarray, scales) -> np.ndarray:
    """Means over blocks, (blocks, channels)."""
    sums = []
    for scale in scales:
        rows, columns = _edges(image.shape, scale)
        strips = np.add.reduceat(image, rows[:-1], axis=0)
        sums.append(np.add.reduceat(strips, columns[:-1], axis=1).reshape(-1, image.shape[2]))
    return np.concatenate(sums) / block_sizes(image.shape, scales)


def block_sizes(shape, scales) -> np.ndarray:
    """How many pixels each block has, (blocks, 1)."""
    edges = [_edges(shape, scale) for scale in scales]
    return np.concatenate([np.outer(*map(np.diff, both)).reshape(-1, 1) for both in edges])


def _edges(shape, scale):
    """Sizes that do not divide the image make blocks that differ by a pixel."""
    return [np.arange(n + 1) * size // n for n, size in zip(scale, shape[:2], strict=True)]


def measure(render: Callable[[int], np.ndarray], scales, seeds) -> Blocks:
    """`render(seed)` gives an image; one run for each seed."""
    means = np.array([block_means(render(seed).astype(np.float64), scales) for seed in seeds])
    error = means.std(axis=0, ddof=1) / np.sqrt(len(means))
    return Blocks(tuple(scales), means.mean(axis=0), error, len(means))


@dataclass(frozen=True)
class Verdict:
    rejected: list[str]  #: the blocks that differ, worst first
    whole_image: float  #: the relative differences that would have been found
    median_block: float
    p: float  #: of the worst block, times the number of blocks

    def __str__(self):
        power = f"detectable: {self.whole_image:.2%} whole image, {self.median_block:.2%} block"
        return f"{len(self.rejected)} blocks differ, p {self.p:.2g} ({power})" + "".join(
            f"\n  {line}" for line in self.rejected[:10]
        )


def compare(a: Blocks, b: Blocks, systematic: float = 0.0) -> Verdict:
    """Test that `a` and `b` are measurements of one image.

    systematic
        a relative error of `b` that is known and understood: only what exceeds it counts.
    """
    # Rounding: of a block, and of what a far brighter neighbourhood leaves in it.
    floor = (SINGLE_PRECISION / 3 * (np.abs(b.mean) + 0.01 * np.abs(b.mean[0]))) ** 2
    variances = a.error**2, b.error**2 + floor
    variance = sum(variances) + np.finfo(float).tiny
    # Welch-Satterthwaite
    freedom = variance**2 / (
        variances[0] ** 2 / (a.runs - 1) + variances[1] ** 2 / (b.runs - 1) + np.finfo(float).tiny
    )
    freedom = np.clip(freedom, 1, None)
    error = np.sqrt(variance)
    excess = np.maximum(np.abs(a.mean - b.mean) - systematic * np.abs(b.mean), 0)
    p = 2 * stats.t.sf(excess / error, freedom)

    order = np.argsort(p, axis=None)
    holm = p.ravel()[order] * (p.size - np.arange(p.size))
    count = int(np.argmax(holm > LEVEL)) if (holm > LEVEL).any() else p.size
    names = _names(a.scales)
    rejected = []
    for index in order[:count]:
        block, channel = np.unravel_index(index, p.shape)
        ours, theirs = a.mean[block, channel], b.mean[block, channel]
        relative = (ours - theirs) / theirs if theirs else np.inf
        rejected.append(
            f"{names[block]}, channel {channel}: {ours:.6g} and {theirs:.6g} ({relative:+.2%}, "
            f"{(ours - theirs) / error[block, channel]:+.1f} standard errors)"
        )

    quantiles = stats.t.isf(LEVEL / p.size / 2, freedom) + stats.t.ppf(POWER, freedom)
    brightness = np.abs(b.mean).mean(axis=1, keepdims=True)
    lit = brightness[:, 0] > 1e-3 * brightness.max()
    found = ((quantiles * error)[lit] / brightness[lit]) + systematic
    return Verdict(rejected, found[0].max(), float(np.median(found)), min(1.0, float(holm[0])))


def _names(scales) -> list[str]:
    return [
        f"{rows} x {columns} grid, block {row}, {column}"
        for rows, columns in scales
        for row in range(rows)
        for column in range(columns)
    ]


def visible_beside(reference: Blocks) -> float:
    """The relative difference of the whole image that would be noticed if the other side were known
    exactly."""
    exact = Blocks(reference.scales, reference.mean, np.zeros_like(reference.error), reference.runs)
    return compare(exact, reference).whole_image


Side = Blocks | Callable[[float, int], np.ndarray]


def assert_same_image(
    a: Side,
    b: Side,
    *,
    spp: float,
    runs: int = 16,
    scales=FULL,
    systematic: float = 0.0,
    whole_image: float = WHOLE_IMAGE,
    seed=1,
) -> Verdict:
    """Fail unless both sides show the same image; each is known blocks or `render(spp, seed)`.

    whole_image
        the largest relative difference of the whole image that may go unnoticed.
    """

    def measured(side, spp, seed, stream):
        if isinstance(side, Blocks):
            return side.at(scales)
        first = (2 * seed + stream) * 100_000
        return measure(lambda s: side(spp, s), scales, range(first, first + runs))

    for attempt, factor in enumerate((1, 4)):
        sides = [measured(s, factor * spp, seed + attempt, i) for i, s in enumerate((a, b))]
        verdict = compare(*sides, systematic)
        if not verdict.rejected:
            break
    assert not verdict.rejected, str(verdict)
    assert verdict.whole_image <= whole_image, f"too noisy to tell: {verdict}"
    assert verdict.median_block <= MEDIAN_BLOCK, f"too noisy to tell: {verdict}"
    return verdict
