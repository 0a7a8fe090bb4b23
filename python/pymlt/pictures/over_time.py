"""The mean of a denoised frame and its neighbours, where their halves tell that it is better.

What is in `halves` about two filters holds for a frame f and the mean g of the frames before and
after it, too: half A of all frames is independent of half B. So the frame becomes f + w (g - f)
with the weight that has the least error. Where things move, g is biased, E (g - f)^2 is large, and
the frame stays nearly as it is; nothing tells where things have moved to.

With the shares k_f and k_g of a pixel's own noise, e(f, g) lacks (1 - k_f - k_g) u, and so

    w = (e(f, f) - e(f, g) + (k_g - k_f) u) / E (f - g)^2.

The denominator is the larger one of two means: over the neighbourhood, and near the pixel itself
with all its brightness, divided by MOVED, so that a lamp that moves by leaves no trail.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .halves import SIGMA, Mixture, Pair, grey, share, smooth

if TYPE_CHECKING:
    import numpy as np

NEAR = SIGMA / 2  #: pixels, of the mean near a pixel
MOVED = 2.0  #: times that of its surroundings: a difference near a pixel that chance may make


def mean_over_time(frame: Mixture, neighbours: list[Mixture]) -> Mixture:
    """A denoised frame, mixed pixel by pixel with the mean of its neighbours, and its error."""
    if not neighbours:
        return frame
    f, advice = frame.pair, frame.advice
    g = Pair(*(_mean(halves) for halves in zip(*(n.pair for n in neighbours), strict=True)))
    kept = advice.kept(g)
    weight = _weight(frame, g, kept)
    image = frame.image + weight[..., None] * (_mean([n.image for n in neighbours]) - frame.image)
    return advice.mixture(image, f.mixed(g, weight), frame.kept + weight * (kept - frame.kept))


def _weight(frame: Mixture, g: Pair, kept: np.ndarray) -> np.ndarray:
    """w of each pixel."""
    import numpy as np

    f, advice = frame.pair, frame.advice
    unlike = (kept - frame.kept) * advice.unlike * advice.apart
    gain = advice.around(advice.covariance(f, f) - advice.covariance(f, g) + unlike)
    apart = grey((f.mean - g.mean) ** 2)
    near = smooth(apart / advice.scale, NEAR)
    return share(gain, np.maximum(advice.around(apart), near / MOVED))


def error_of_change(before: Mixture, after: Mixture) -> float:
    """The error of the change from one denoised frame to the next, relative to the second one.

    The change of a filter's image is what the filter makes of the change, so it is judged by the
    change of the halves.
    """
    changes = (
        Pair(*(a - b for a, b in zip(late.luminance, early.luminance, strict=True)))
        for late, early in ((after.pair, before.pair), (after.advice.raw, before.advice.raw))
    )
    return after.advice.relative(*changes, after.kept)[0]


def _mean(images) -> np.ndarray:
    return sum(images) / len(images)
