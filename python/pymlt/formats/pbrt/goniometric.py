"""Lights of pbrt-v4 of no size whose intensity is an octahedral image, as `goniometric`."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .environment import read_octahedral, resampled
from .params import Params
from .photometry import factor
from .spectra import luminance_one, numbers

if TYPE_CHECKING:
    import numpy as np

LEAST = 512  #: rows of ours, between which pbrt's pixels, each even all over, have narrow edges


def goniometric(params: Params, folder: Path, to_world: np.ndarray, scale: float) -> dict[str, Any]:
    """The means of the image's colours times `I`, whose spectrum becomes a colour.

    In the light's own space the axis of the map is y, not z.
    """
    import numpy as np

    if not (filename := params.text("filename")):
        raise params.where.error("a goniometric light needs the 'filename' of its image")
    given = read_octahedral(params, folder / filename).mean(axis=2, keepdims=True)
    scale *= factor(params, "power", 4 * math.pi * float(given.mean()))
    colour = np.float32(numbers(luminance_one(params.colour("I", 1.0))))
    finer = given.repeat(math.ceil(LEAST / len(given)), axis=0)
    finer = finer.repeat(len(finer) // len(given), axis=1)
    return {
        "type": "goniometric",
        "data": resampled(finer) * colour,
        "scale": scale,
        "to_world": to_world @ np.diag([1.0, 1, -1, 1]),
    }
