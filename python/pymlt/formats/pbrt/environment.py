"""Environment maps: pbrt-v4 has octahedral ones, we have latitude and longitude."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from .images import read_rgb
from .params import Params
from .photometry import factor
from .spectra import luminances

if TYPE_CHECKING:
    import numpy as np


def environment(params: Params, path: Path, to_world: np.ndarray, scale: float) -> dict[str, Any]:
    """An `envmap` of the same light, with as many rows as the octahedral map has."""
    import numpy as np

    given = read_octahedral(params, path)
    if params.get("illuminance"):
        scale *= factor(params, "illuminance", upward_illuminance(given))
    # The y axis of our maps, up, is the z axis of theirs.
    turn = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
    return {
        "type": "envmap",
        "data": resampled(given),
        "scale": scale,
        "to_world": to_world @ turn,
    }


def read_octahedral(params: Params, path: Path) -> np.ndarray:
    """In linear light, (n, n, 3)."""
    given = read_rgb(path)
    if given.shape[0] != given.shape[1]:
        raise params.where.error(f"{path.name}: a map of all directions of pbrt-v4 is square")
    return given


def resampled(octahedral: np.ndarray) -> np.ndarray:
    """Of latitude and longitude, (n, 2 n, channels), from (n, n, channels)."""
    import numpy as np

    rows = len(octahedral)
    # Some rows at a time, for their directions take more memory than their colours.
    parts = [slice(first, first + 64) for first in range(0, rows, 64)]
    found = [sampled(octahedral, square_of(directions(rows, p))) for p in parts]
    return np.concatenate([part.astype(np.float32) for part in found])


def directions(rows: int, part: slice = slice(None)) -> np.ndarray:
    """The directions of our pixels in pbrt's light space, (rows, 2 rows, 3), or of some rows.

    Ours: phi = 2 pi u, direction (sin phi sin theta, cos theta, -cos phi sin theta) with y up; the
    first and the last row are at the poles.
    """
    import numpy as np

    theta = np.pi * np.arange(rows)[part][:, None] / (rows - 1)
    phi = np.pi * (np.arange(2 * rows) + 0.5)[None, :] / rows
    y = np.broadcast_to(np.cos(theta), (len(theta), 2 * rows))
    x, z = np.sin(phi) * np.sin(theta), -np.cos(phi) * np.sin(theta)
    return np.stack([x, -z, y], axis=-1)


def upward_illuminance(octahedral: np.ndarray) -> float:
    """Of what faces the z axis of a map, as pbrt-v4 computes it: half of what is right."""
    import numpy as np

    side = octahedral.shape[0]
    centres = (np.arange(side) + 0.5) / side * 2 - 1
    u, v = np.meshgrid(centres, centres)
    from_border = 1 - (abs(u) + abs(v))  # of the square of the upper half
    cosines = np.where(from_border > 0, 1 - (1 - from_border) ** 2, 0)
    return float(2 * np.pi * (luminances(octahedral) * cosines).mean())


def square_of(d: np.ndarray) -> np.ndarray:
    """EqualAreaSphereToSquare of pbrt-v4, after Clarberg 2008: (..., 3) to (..., 2) in [0, 1]."""
    import numpy as np

    x, y, z = abs(np.moveaxis(d, -1, 0))
    r = np.sqrt(np.maximum(0, 1 - z))
    v = r * np.arctan2(np.minimum(x, y), np.maximum(x, y)) * 2 / np.pi
    v = np.where(x < y, r - v, v)
    u = r - v
    below = d[..., 2] < 0
    u, v = np.where(below, 1 - v, u), np.where(below, 1 - u, v)
    u, v = np.copysign(u, d[..., 0]), np.copysign(v, d[..., 1])
    return np.stack([(u + 1) / 2, (v + 1) / 2], axis=-1)


def sampled(image: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Between the nearest four pixels; beyond the border the nearest one."""
    import numpy as np

    place = at * image.shape[0] - 0.5
    low = np.floor(place).astype(int)
    part = place - low
    x0, y0 = np.moveaxis(low.clip(0, image.shape[0] - 1), -1, 0)
    x1, y1 = np.moveaxis((low + 1).clip(0, image.shape[0] - 1), -1, 0)
    fx, fy = part[..., :1], part[..., 1:]
    above = image[y0, x0] * (1 - fx) + image[y0, x1] * fx
    under = image[y1, x0] * (1 - fx) + image[y1, x1] * fx
    between: np.ndarray = above * (1 - fy) + under * fy
    return between
