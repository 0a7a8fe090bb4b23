"""Which parts of an image are worth a closer look."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .. import _core

SHARE = 6  #: an inset is a sixth of the image's width
CLIP = 1.0  #: at which the relative squared error of a pixel is cut, so that no firefly decides


class Inset(NamedTuple):
    """A part of an image, in pixels; row 0 is on top."""

    x: int
    y: int
    width: int
    height: int

    def crop(self, image: np.ndarray) -> np.ndarray:
        """That part of an image."""
        return image[self.y : self.y + self.height, self.x : self.x + self.width]


def choose_insets(errors: Sequence[np.ndarray], count: int) -> list[Inset]:
    """Where algorithms differ most: windows in which the worst and the best lie farthest apart.

    None of them overlap.

    errors
        for each algorithm its relative squared error by pixel, (height, width).
    """
    height, width = errors[0].shape
    side = min(max(8, width // SHARE), width, height)
    means = np.stack([_window_means(np.minimum(error, CLIP), side) for error in errors])
    score = means.max(axis=0) - means.min(axis=0) if len(means) > 1 else means[0]
    chosen = []
    for _ in range(count):
        y, x = np.unravel_index(int(np.argmax(score)), score.shape)
        if not score[y, x] >= 0:
            break
        chosen.append(Inset(int(x), int(y), side, side))
        score[max(0, y - side + 1) : y + side, max(0, x - side + 1) : x + side] = -1
    return chosen


def _window_means(error: np.ndarray, side: int) -> np.ndarray:
    """Over all square windows, by their upper left pixel."""
    sums = np.pad(error.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
    total = sums[side:, side:] - sums[:-side, side:] - sums[side:, :-side] + sums[:-side, :-side]
    means: np.ndarray = total / side**2
    return means


def check_insets(insets: Sequence[Sequence[int]], size: tuple[int, int]) -> list[Inset]:
    """Those that were given as (x, y, width, height).

    Raises UsageError if one is no rectangle within the image.
    """
    made = []
    for given in insets:
        try:
            inset = Inset(*map(int, given))
        except (TypeError, ValueError):
            raise _core.UsageError(f"inset {given!r} should be (x, y, width, height)") from None
        fits = inset.x + inset.width <= size[0] and inset.y + inset.height <= size[1]
        if min(inset.x, inset.y) < 0 or min(inset.width, inset.height) < 1 or not fits:
            raise _core.UsageError(
                f"inset {tuple(inset)} does not lie in the image of {size[0]} x {size[1]} pixels"
            )
        made.append(inset)
    return made
