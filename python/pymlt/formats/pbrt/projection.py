"""Lights of pbrt-v4 that cast an image, as `projector`."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..limits import check_pixels
from .images import read_rgb
from .params import Params
from .photometry import factor
from .spectra import luminances

if TYPE_CHECKING:
    import numpy as np

LEAST = 512  #: pixels along the shorter side, each of which has one cosine for all of it


def projection(params: Params, folder: Path, to_world: np.ndarray, scale: float) -> dict[str, Any]:
    """pbrt's image is the intensity I, ours what a white plane across the axis shows: I cos^3 / pi.

    Its x axis points to the right, ours to the left.
    """
    import numpy as np

    if not (filename := params.text("filename")):
        raise params.where.error("a projection light needs the 'filename' of its image")
    given = read_rgb(folder / filename)
    fov = params.number("fov", 90)
    sides = np.array(given.shape[:2])
    half = math.tan(math.radians(fov) / 2) * sides / min(sides)
    solid_angles = 4 * half.prod() * cubed_cosines(given.shape[:2], half)
    scale *= factor(params, "power", float((luminances(given) * solid_angles).mean()))
    times = math.ceil(LEAST / min(sides))
    larger = given.repeat(times, axis=0).repeat(times, axis=1)
    check_pixels(larger, filename)
    shown = larger * cubed_cosines(larger.shape[:2], half)[..., None] / np.pi
    image = {"type": "bitmap", "data": shown.astype(np.float32), "filter_type": "nearest"}
    return {
        "type": "projector",
        "irradiance": image | {"raw": True},
        "scale": scale,
        "fov": fov,
        "fov_axis": "smaller",
        "to_world": to_world @ np.diag([-1.0, 1, 1, 1]),
    }


def cubed_cosines(size: tuple[int, ...], half: np.ndarray) -> np.ndarray:
    """Of the angles between the axis and the pixels' middles, on a plane at unit distance that
    reaches so far, half its height and width, from the axis."""
    import numpy as np

    y, x = (
        reach * ((np.arange(count) + 0.5) / count * 2 - 1)
        for count, reach in zip(size, half, strict=True)
    )
    cubed: np.ndarray = (1 + x[None, :] ** 2 + y[:, None] ** 2) ** -1.5
    return cubed
