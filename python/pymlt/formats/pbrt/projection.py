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
    """The light of a file of pbrt-v4, each pixel of which has its intensity all over."""

    if not (filename := params.text("filename")):
        raise params.where.error("a projection light needs the 'filename' of its image")
    given = read_rgb(folder / filename)
    fov = params.number("fov", 90)
    half = half_size(given, fov)
    solid_angles = 4 * half.prod() * cubed_cosines(given.shape[:2], half)
    scale *= factor(params, "power", float((luminances(given) * solid_angles).mean()))
    times = division(given, filename)
    larger = given.repeat(times, axis=0).repeat(times, axis=1)
    return cast(larger, fov, scale, to_world)


def cast(image: np.ndarray, fov: float, scale: float, to_world: np.ndarray) -> dict[str, Any]:
    """A `projector` that casts the intensities of a fine image.

    pbrt's image is the intensity I, ours what a white plane across the axis shows: I cos^3 / pi.
    Its x axis points to the right, ours to the left.
    """
    import numpy as np

    shown = image * cubed_cosines(image.shape[:2], half_size(image, fov))[..., None] / np.pi
    data = {"type": "bitmap", "data": shown.astype(np.float32), "filter_type": "nearest"}
    return {
        "type": "projector",
        "irradiance": data | {"raw": True},
        "scale": scale,
        "fov": fov,
        "fov_axis": "smaller",
        "to_world": to_world @ np.diag([-1.0, 1, 1, 1]),
    }


def division(image: np.ndarray, name: str) -> int:
    """Into how many parts each pixel is cut along both sides, so that it has many cosines."""
    import numpy as np

    sides = np.array(image.shape[:2])
    times = math.ceil(LEAST / min(sides))
    check_pixels(np.broadcast_to(0, sides * times), name)
    return times


def half_size(image: np.ndarray, fov: float) -> np.ndarray:
    """Half the height and width of an image at unit distance; `fov` is that of the shorter side."""
    import numpy as np

    sides = np.array(image.shape[:2])
    return math.tan(math.radians(fov) / 2) * sides / min(sides)


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
