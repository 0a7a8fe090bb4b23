"""Lights of pbrt-v3 (Pharr, Jakob & Humphreys 2016, ch. 12)."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from ....images import read_image
from ...imported import rgb
from ...limits import check_pixels
from ..area_lights import AreaLight, shining_sides
from ..arithmetic import multiplied
from ..lights import placed
from ..params import Params
from ..spectra import numbers
from ..textures import Textures

#: From the axes of our maps, whose columns go around y, to those of pbrt's, around z.
AROUND_Z = np.array([[0.0, 0, -1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]])


def light(params: Params, folder: Path, to_world: np.ndarray) -> dict[str, Any] | None:
    """A light that is no shape; None, with a warning, for those without a counterpart."""
    _ignore_counts(params)
    if params.type in ("infinite", "exinfinite"):
        radiance = strength(params, "L")
        if filename := params.text("mapname"):
            return environment(folder / filename, to_world, numbers(radiance))
        return {"type": "constant", "radiance": radiance}
    found = placed(params, to_world, strength(params, "L" if params.type == "distant" else "I"))
    if found and found["type"] == "spot" and found["beam_width"] < found["cutoff_angle"]:
        found["cutoff_angle"] = _same_power(found["beam_width"], found["cutoff_angle"])
    return found


def area_light(params: Params, textures: Textures) -> AreaLight:
    """What AreaLightSource says."""
    _ignore_counts(params)
    shining_sides(params, "area", "diffuse")
    radiance = strength(params, "L")
    params.finish()
    return AreaLight(radiance, None, 1)


def strength(params: Params, name: str) -> Any:
    """A colour times the scale, which is one, too."""
    colour, scale = params.colour(name, 1.0), params.colour("scale", 1.0)
    found = multiplied(colour, scale)
    if isinstance(found, dict) and found["type"] == "scale":  # a spectrum times a colour
        return rgb(np.multiply(numbers(colour), numbers(scale)))
    return found


def environment(path: Path, to_world: np.ndarray, colour: list[float]) -> dict[str, Any]:
    """A map of latitude and longitude, of which the first row is around the z axis.

    Our first and last rows are at the poles, pbrt's half a row away from them: with a row between
    each two of pbrt's the map is the same.
    """
    pixels = read_image(path)[..., :3]
    check_pixels(pixels, str(path))
    if path.suffix.lower() in (".png", ".tga"):
        pixels = _encoded(pixels)
    data = np.repeat(pixels * np.asarray(colour, np.float32), 2, axis=0)
    between = (data[1:] + data[:-1]) / 2
    rows = np.concatenate([data[:1], between, data[-1:]])
    return {"type": "envmap", "data": rows, "scale": 1.0, "to_world": to_world @ AROUND_Z}


def _encoded(linear: np.ndarray) -> np.ndarray:
    """As sRGB: the numbers that are stored, which pbrt takes as they are in maps of light."""
    dark = linear <= 0.0031308
    return np.where(dark, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def _same_power(beam: float, cutoff: float) -> float:
    """The angle, in degrees, at which a linear edge ends that has the power of pbrt's.

    Between the two cosines pbrt's intensity falls as the fourth power, of which the mean is 1/5;
    an edge that is linear in the angle has the mean of the cosine between its ends.
    """
    start, low, high = math.radians(beam), math.radians(beam), math.radians(cutoff)
    wanted = math.cos(start) - (math.cos(start) - math.cos(high)) / 5
    for _ in range(50):
        end = (low + high) / 2
        if (math.sin(end) - math.sin(start)) / (end - start) > wanted:
            low = end
        else:
            high = end
    return math.degrees(high)


def _ignore_counts(params: Params) -> None:
    """How many samples a light gets does not change the image."""
    for name in ("nsamples", "samples"):
        params.get(name)
