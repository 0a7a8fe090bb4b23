"""How good the images of one algorithm are: their errors, and what of them is brightness alone.

For the relative mean squared error of an image a to a reference r see `pymlt.compare`. Level is the
mean brightness of a over that of r; shape is the error of a once it is scaled to the mean of r. Of
Metropolis light transport the two have different causes: level comes from the samples that estimate
b, shape from the chains.

Without a reference, the images x_1 ... x_n of n seeds tell each other's error: the mean over the
seeds of n / (n - 1) (x_k - m)^2, m their mean, is the sample variance, the same as the mean of
(x_j - x_k)^2 / 2 over all pairs. It is unbiased, but does not see what is wrong in all of them.

Of a mean over the pixels, that of the reference's own error is subtracted, since expected squared
errors of independent images add up. Their quantiles do not, so those over the pixels are of the
distance to the reference as it is, a little larger by its noise, which all algorithms share.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from math import floor, log10, sqrt
from typing import Any

import numpy as np

from .. import _core
from ..diagnostics.metrics import (
    flip_map,
    image_pair,
    percentile_90,
    relative_square,
    sparks,
    trimmed_mean,
)


@dataclass(frozen=True)
class Mean:
    """A mean over the images of several seeds."""

    value: float
    error: float | None = None  #: its standard error; None if there are too few images

    def __str__(self) -> str:
        if not self.error:
            return f"{self.value:.3g}"
        power = floor(log10(self.error))
        digits = (1 if self.error < 3 * 10.0**power else 0) - power
        if not 0 <= digits <= 7:
            return f"{self.value:.3g} ± {self.error:.1g}"
        return f"{self.value:.{digits}f} ± {self.error:.{digits}f}"


@dataclass(frozen=True)
class Score:
    """What the images of one algorithm are worth after one stretch of time."""

    seconds: float  #: CPU time of an image, all threads together; the mean
    images: int  #: how many there are
    relmse: Mean | None  #: None: without a reference a single image, or black ones, have no error
    median: float | None  #: of relmse over the images
    trimmed: Mean | None  #: relmse without the 0.1 % of the pixels that are worst
    pixel_median: Mean | None  #: median over the pixels of an image's relative squared error
    percentile_90: Mean | None  #: what nine of ten pixels of an image do not exceed, of the same
    shape: Mean | None  #: relmse once the mean of each image is that of the reference
    level: Mean  #: mean of the image over that of the reference
    level_spread: float | None  #: standard deviation of the level of one image; None for one image
    #: pixels far brighter than those around them, as they are not in the reference; the mean
    sparks: float
    flip: Mean | None = None  #: HDR-FLIP against the reference, if flip-evaluator is installed


class Judge:
    """Scores images, against a reference or between seeds."""

    def __init__(self, scale: np.ndarray, reference: np.ndarray | None, own: np.ndarray):
        self.scale = scale  #: r: what errors are relative to
        self.reference = reference  #: float64, (height, width, 3); None: between seeds
        self.own_error = own  #: relative squared error of the reference itself, (height, width)

    @classmethod
    def with_reference(cls, images: Sequence[np.ndarray]) -> Judge:
        """Against the mean of independent images, whose own error their spread tells."""
        mean = np.asarray(np.mean(images, axis=0, dtype=np.float64))
        n = len(images)
        own = np.zeros(mean.shape[:2])
        for image in images if n > 1 else ():
            own += relative_square(image, mean) / (n * (n - 1))
        return cls(mean, mean, own)

    @classmethod
    def between_seeds(cls, images: Sequence[Sequence[np.ndarray]]) -> Judge:
        """Without a reference: r is the median, over the algorithms, of their mean images."""
        means = [np.mean(own, axis=0, dtype=np.float64) for own in images if len(own)]
        scale = np.median(means, axis=0)
        return cls(scale, None, np.zeros(scale.shape[:2]))

    def errors(self, images: Sequence[np.ndarray]) -> list[np.ndarray]:
        """Relative squared errors by pixel, (height, width), of each image; without a reference
        none of a single one, nor of black ones, which agree about nothing."""
        exact = [np.asarray(image, dtype=np.float64) for image in images]
        if self.reference is not None:
            return [relative_square(image, self.reference) for image in exact]
        n, mean = len(exact), np.mean(exact, axis=0)
        if n < 2 or not np.any(mean):
            return []
        return [n / (n - 1) * relative_square(image, mean, self.scale) for image in exact]

    def score(self, images: Sequence[np.ndarray], seconds: float, *, flip: bool = False) -> Score:
        """All that is known about images of one algorithm at one time."""
        errors = self.errors(images)
        with np.errstate(divide="ignore", invalid="ignore"):
            levels = [float(np.mean(x, dtype=np.float64) / self.scale.mean()) for x in images]
            shapes = self.errors([x / level for x, level in zip(images, levels, strict=True)])
        perceptual = self._flip(images) if flip else []
        return Score(
            seconds,
            len(images),
            self._excess(errors, np.mean),
            self._median(errors),
            self._excess(errors, trimmed_mean),
            self._mean(errors, np.median),
            self._mean(errors, percentile_90),
            self._excess(shapes, np.mean) if all(levels) else None,
            mean_of(levels) or Mean(0.0),
            float(np.std(levels, ddof=1)) if len(levels) > 1 else None,
            self._sparks(images),
            mean_of(perceptual),
        )

    def _mean(self, errors: list[np.ndarray], metric: Callable[..., float]) -> Mean | None:
        """Of a metric of error maps, over the images."""
        values = [float(metric(error)) for error in errors]
        return mean_of(values, between_seeds=self.reference is None)

    def _excess(self, errors: list[np.ndarray], metric: Callable[..., float]) -> Mean | None:
        """Of a mean over the pixels of error maps, less that of the reference."""
        own = metric(self.own_error)
        return self._mean(errors, lambda error: metric(error) - own)

    def _median(self, errors: list[np.ndarray]) -> float | None:
        if not errors:
            return None
        return float(np.median([error.mean() for error in errors]) - self.own_error.mean())

    def _sparks(self, images: Sequence[np.ndarray]) -> float:
        known = False if self.reference is None else sparks(self.reference)
        return float(np.mean([np.sum(sparks(image) & ~np.asarray(known)) for image in images]))

    def _flip(self, images: Sequence[np.ndarray]) -> list[float]:
        if self.reference is None or not find_spec("flip_evaluator"):
            return []
        return [flip_map(np.asarray(image), self.reference)[1] for image in images]


def mean_of(values: Sequence[float], *, between_seeds: bool = False) -> Mean | None:
    """The mean with its standard error; None of nothing.

    Values that are deviations of n images from their own mean depend on each other. The jackknife
    of a sample variance (Efron & Stein 1981) is (n - 1) / (n - 2) times the error that independent
    ones would have, so it takes three images.
    """
    n = len(values)
    if n == 0:
        return None
    error = float(np.std(values, ddof=1)) / sqrt(n) if n > 1 else None
    if between_seeds:
        error = error * (n - 1) / (n - 2) if error is not None and n > 2 else None
    return Mean(float(np.mean(values)), error)


def reference_images(reference: Any, size: tuple[int, int]) -> list[np.ndarray]:
    """What was given as a reference, an image or several, as arrays (height, width, 3).

    Raises UsageError for images of another size than (width, height), FileError for files that
    cannot be read.
    """
    given = reference if isinstance(reference, list | tuple) else [reference]
    if not given:
        raise _core.UsageError("reference is an empty list")
    frame = np.zeros((size[1], size[0], 3))
    try:
        images = [image_pair(image, frame)[0] for image in given]
    except _core.UsageError as error:
        raise _core.UsageError(f"reference: {error}") from None
    if not all(np.isfinite(image).all() for image in images):
        raise _core.UsageError("reference: there are pixels that are not numbers")
    if not np.mean(images) > 0:
        raise _core.UsageError("reference: the image is black")
    return images
