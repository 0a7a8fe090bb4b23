"""What a filter makes of the two halves of a render tells how wrong it is.

A and B are halves that share no sample, and f_A, f_B what a filter f makes of each. The filter of A
knows nothing of the noise of B, so with the image mu that both estimate

    E (f_A - A) (g_B - B) = bias(f) bias(g),

and the covariance of the errors of the means f = (f_A + f_B) / 2 and g is estimated by

    e(f, g) = ((f_A - A) (g_B - B) + (f_B - B) (g_A - A)) / 2 + (f_A - f_B) (g_A - g_B) / 4.

For f = g this is the mean squared error of f. It is linear in what each half alone has seen, so a
spark moves it less than it moves (f_A - B)^2 - var(B), which has the same expectation. The raw
image is the filter that does nothing, without bias.

Of two filters the mixture f + w (g - f) has the least error with

    w = (e(f, f) - e(f, g)) / E (f - g)^2.

Halves whose samples are stratified together are less alike than independent ones. Their covariance
is -u, with u = (A - B)^2 / 4 - E^2 and the standard error E of the image. Of a filter that keeps
the share k of a pixel's own noise, the product of the biases has (1 - k)^2 u too little, and the
spread of its halves k^2 u too much: e(f, f) lacks (1 - 2 k) u, and e(f, raw) has k u too much.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from .luminance import target_luminance

if TYPE_CHECKING:
    import numpy as np

SIGMA = 4.0  #: pixels, of the neighbourhood over which the estimates are averaged
MOST = 4.0  #: relative squared error of a pixel, above which it counts no more
DARK = 0.1  #: of the mean brightness: below it, pixels matter less
SURE = 4.0  #: standard errors by which both halves must see a glint that the filter has not kept
FAR = 4.0  #: times brighter than the filter says, in both halves: a glint that it has lost
ALIKE = 0.4  #: the least ratio of its brightness in the two


class Pair(NamedTuple):
    """What a filter makes of each half: float32, (height, width, channels)."""

    first: np.ndarray
    second: np.ndarray

    @property
    def mean(self) -> np.ndarray:
        return (self.first + self.second) / 2

    @property
    def apart(self) -> np.ndarray:
        """(A - B)^2 / 4."""
        return (self.first - self.second) ** 2 / 4

    @property
    def luminance(self) -> Pair:
        """What Metropolis samples, as one channel."""
        return Pair(*(target_luminance(half)[..., None] for half in self))

    def times(self, factor: float) -> Pair:
        return Pair(self.first * factor, self.second * factor)

    def mixed(self, other: Pair, weight: np.ndarray) -> Pair:
        """This one and another, with the weight of the other in each pixel."""
        w = weight[..., None]
        first, second = (a + w * (b - a) for a, b in zip(self, other, strict=True))
        return Pair(first, second)


class Mixture(NamedTuple):
    """The best mixture of filtered images and of the image itself."""

    image: np.ndarray  #: float32, (height, width, 3)
    error: np.ndarray  #: its standard error around each pixel, float32, (height, width, 3)
    relative: float  #: its relative error, as `stats["error"]` is that of the image itself
    bound: float  #: the same with two standard errors of its square
    pair: Pair  #: what it makes of each half
    kept: np.ndarray  #: the share k of a pixel's own noise, (height, width)
    advice: Advice  #: of the halves


def covariance(f: Pair, g: Pair, raw: Pair) -> np.ndarray:
    """e(f, g) of each pixel and channel."""
    biases = (f.first - raw.first) * (g.second - raw.second)
    biases += (f.second - raw.second) * (g.first - raw.first)
    return biases / 2 + (f.first - f.second) * (g.first - g.second) / 4


def best_mixture(
    image: np.ndarray, error: np.ndarray, raw: Pair, robust: Pair, filtered: tuple[Pair, Pair]
) -> Mixture:
    """Mixes an image with what a filter makes of it, pixel by pixel, as its halves advise.

    image, error
        of the render, and its standard error, which all groups tell.
    raw, robust
        its halves, as they are and without fireflies.
    filtered
        what the filter makes of `raw` and of `robust`.

    The filtered images are mixed first: with fireflies there is more noise, without them less
    light. The result is mixed with the image. Where both halves see the same glint and the filter
    does not, the image itself is taken.
    """
    import numpy as np

    with_sparks, without_sparks = filtered
    advice = Advice(raw, error, (with_sparks.mean + without_sparks.mean) / 2)
    of, around = advice.covariance, advice.around

    gain = around(of(without_sparks, without_sparks) - of(without_sparks, with_sparks))
    difference = around(grey((with_sparks.mean - without_sparks.mean) ** 2))
    clean = without_sparks.mixed(with_sparks, share(gain, difference))

    shared = of(clean, raw)
    own = advice.kept(clean)
    unlike = advice.unlike * advice.apart
    gain = np.maximum(around(of(clean, clean) - shared + (1 - own) * unlike), 0)
    noise = np.maximum(around(advice.variance - shared + own * unlike), 0)
    spark = grey(abs(raw.mean - robust.mean)) > 1e-6 * advice.expected.mean()
    noise = np.where(spark, np.maximum(noise, advice.variance / advice.scale), noise)
    weight = np.where(advice.glint, 1, share(gain, gain + noise)).astype(np.float32)

    found = clean.mean + weight[..., None] * (image - clean.mean)
    return advice.mixture(found, clean.mixed(raw, weight), own + weight * (1 - own))


class Advice:
    """What the halves tell about filters. Arrays have the shape (height, width)."""

    def __init__(self, raw: Pair, error: np.ndarray, expected: np.ndarray):
        self.raw = raw
        self.expected = grey(expected)
        self.variance = grey(error**2)
        self.apart = self._bounded(grey(raw.apart))

    @cached_property
    def scale(self) -> np.ndarray:
        """L^2 + (DARK M)^2, by which squared errors are divided; L^2 of a glint that the filter
        has lost is the product of what the halves have seen."""
        import numpy as np

        first, second = (grey(half) for half in self.raw)
        is_lost = np.minimum(first, second) > FAR * self.expected
        square = np.where(is_lost, first * second, self.expected**2)
        dark = max(DARK * float(grey(self.raw.mean).mean()), 1e-12)  # also of a black image
        return square + dark**2

    @cached_property
    def glint(self) -> np.ndarray:
        """Where both halves are brighter than the filter expects, and alike."""
        import numpy as np

        first, second = (grey(half) - self.expected for half in self.raw)
        less, more = np.minimum(first, second), np.maximum(first, second)
        return (less > SURE * np.sqrt(self.variance)) & (less > ALIKE * more)

    def around(self, values: np.ndarray, sigma: float = SIGMA) -> np.ndarray:
        """Relative squares, averaged over the neighbourhood of each pixel, without glints.

        A pixel itself does not count: weights that follow its own noise would hide it.
        """
        import numpy as np

        kept = (~self.glint).astype(np.float32)
        means = neighbours(np.clip(values / self.scale, -MOST, MOST) * kept, sigma)
        return means / np.maximum(neighbours(kept, sigma), 1e-3)

    def covariance(self, f: Pair, g: Pair) -> np.ndarray:
        return grey(covariance(f, g, self.raw))

    def kept(self, f: Pair) -> np.ndarray:
        """The share of a pixel's own noise that a filter keeps."""
        return share(self.around(self.covariance(f, self.raw)), self.around(self.apart))

    @cached_property
    def unlike(self) -> np.ndarray:
        """u as a share of (A - B)^2 / 4."""
        variance, apart = (self.around(x, 4 * SIGMA) for x in (self.variance, self.apart))
        return 1 - share(variance, apart)

    def mixture(self, image: np.ndarray, pair: Pair, kept: np.ndarray) -> Mixture:
        """An image, with its error by the mixture of its halves, and the share k."""
        import numpy as np

        biases = self._smoothed(self._biases(pair, self.raw, kept))
        squares = np.maximum(biases, 0) + self._smoothed(pair.apart)
        return Mixture(
            image.astype(np.float32),
            np.sqrt(squares).astype(np.float32),
            *self.relative(pair.luminance, self.raw.luminance, kept),
            pair,
            kept,
            self,
        )

    def relative(self, found: Pair, raw: Pair, kept: np.ndarray) -> tuple[float, float]:
        """The error of what a filter that keeps the share k makes of `raw`, and its bound.

        Both pairs are of one channel.
        """
        terms = [self._biases(found, raw, kept), found.apart]
        bias, spread = (term[..., 0] / self.scale for term in terms)
        square = max(0.0, float(bias.mean(dtype=float))) + float(spread.mean(dtype=float))
        return square**0.5, (square + 2 * _standard_error(bias + spread)) ** 0.5

    def _biases(self, f: Pair, raw: Pair, kept: np.ndarray) -> np.ndarray:
        """The squared bias of each channel, with what e(f, f) lacks."""
        squares = (f.first - raw.first) * (f.second - raw.second)
        return squares + ((1 - 2 * kept) * self.unlike)[..., None] * self._bounded(raw.apart)

    def _smoothed(self, squares: np.ndarray) -> np.ndarray:
        """Relative to the brightness of each pixel, averaged over its neighbourhood."""
        import numpy as np

        scale = self.scale[..., None]
        relative = np.clip(squares / scale, -MOST, MOST)
        means = [smooth(channel, SIGMA) for channel in np.moveaxis(relative, 2, 0)]
        return scale * np.stack(means, axis=2)

    def _bounded(self, squares: np.ndarray) -> np.ndarray:
        import numpy as np

        most = MOST * self.scale
        return np.minimum(squares, most if squares.ndim == 2 else most[..., None])


def smooth(values: np.ndarray, sigma: float) -> np.ndarray:
    """The Gaussian mean around each pixel of (height, width); the border is repeated outside."""
    import numpy as np

    weights = _gaussian(sigma)
    radius = len(weights) // 2
    for axis in (0, 1):
        padding = [(radius, radius) if i == axis else (0, 0) for i in range(2)]
        padded = np.pad(values, padding, mode="edge")
        size = values.shape[axis]
        parts = (np.take(padded, range(i, i + size), axis) for i in range(2 * radius + 1))
        values = sum(w * part for w, part in zip(weights, parts, strict=True))
    return values


def neighbours(values: np.ndarray, sigma: float) -> np.ndarray:
    """Times a constant, the Gaussian mean without the pixel itself."""
    return smooth(values, sigma) - _gaussian(sigma).max() ** 2 * values


def _gaussian(sigma: float) -> np.ndarray:
    """Weights of pixels in a row, as far as three sigma."""
    import numpy as np

    radius = int(np.ceil(3 * sigma))
    weights = np.exp(-0.5 * (np.arange(-radius, radius + 1) / sigma) ** 2)
    return (weights / weights.sum()).astype(np.float32)


def grey(values: np.ndarray) -> np.ndarray:
    return values.mean(axis=2)


def share(part: np.ndarray, whole: np.ndarray) -> np.ndarray:
    import numpy as np

    return np.clip(part / np.maximum(whole, 1e-12), 0, 1).astype(np.float32)


def _standard_error(terms: np.ndarray, size: int = 16) -> float:
    """That of their mean, by the means over blocks of 16 x 16 pixels."""
    import numpy as np

    rows, columns = (range(0, n, size) for n in terms.shape)
    blocks = [terms[y : y + size, x : x + size].mean() for y in rows for x in columns]
    return float(np.std(blocks) / np.sqrt(len(blocks)))
