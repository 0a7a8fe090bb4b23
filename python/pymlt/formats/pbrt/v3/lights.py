"""Lights of pbrt-v3 (Pharr, Jakob & Humphreys 2016, ch. 12)."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from ....images import read_image
from ....pictures.tonemapping import encode_srgb, split_alpha
from ...imported import rgb
from ...limits import check_pixels
from ..area_lights import AreaLight, shining_sides
from ..arithmetic import multiplied
from ..lights import placed
from ..params import Params
from ..projection import cast, division
from ..spectra import numbers
from ..textures import Textures

#: From the axes of our maps, whose columns go around y, to those of pbrt's, around z.
AROUND_Z = np.array([[0.0, 0, -1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]])

#: Swaps the y and the z axis.
Y_AND_Z = np.eye(4)[[0, 2, 1, 3]]


def light(params: Params, folder: Path, to_world: np.ndarray) -> dict[str, Any] | None:
    """A light that is no shape; None, with a warning, for those without a counterpart."""
    _ignore_counts(params)
    if params.type in ("infinite", "exinfinite"):
        radiance = strength(params, "L")
        if filename := params.text("mapname"):
            return environment(folder / filename, to_world, numbers(radiance))
        return {"type": "constant", "radiance": radiance}
    if params.type == "projection":
        return projection(params, folder, to_world)
    if params.type == "goniometric" and (filename := params.text("mapname")):
        colour = numbers(strength(params, "I"))
        around_y = to_world @ Y_AND_Z
        return environment(folder / filename, around_y, colour) | {"type": "goniometric"}
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
    pixels = _read_map(path)
    data = np.repeat(pixels * np.asarray(colour, np.float32), 2, axis=0)
    between = (data[1:] + data[:-1]) / 2
    rows = np.concatenate([data[:1], between, data[-1:]])
    return {"type": "envmap", "data": rows, "scale": 1.0, "to_world": to_world @ AROUND_Z}


def projection(params: Params, folder: Path, to_world: np.ndarray) -> dict[str, Any]:
    """An image that is interpolated, and of which the first row is the lowest one."""
    filename = params.text("mapname")
    image = _read_map(folder / filename) if filename else np.ones((1, 1, 3), np.float32)
    colour = np.float32(numbers(strength(params, "I")))
    times = division(image, filename or "a light without an image")
    larger = _interpolated(_interpolated(image * colour, times, axis=0), times, axis=1)
    return cast(larger[::-1], params.number("fov", 45), 1.0, to_world)


def _interpolated(image: np.ndarray, times: int, axis: int) -> np.ndarray:
    """Each pixel cut into so many; beyond the last one the first one follows."""
    count = image.shape[axis]
    place = (np.arange(count * times) + 0.5) / times - 0.5
    low = np.floor(place).astype(int)
    part = np.expand_dims(place - low, tuple(range(1, image.ndim - axis)))
    return image.take(low % count, axis) * (1 - part) + image.take((low + 1) % count, axis) * part


def _read_map(path: Path) -> np.ndarray:
    """The numbers that are stored, which pbrt takes as they are in maps of light."""
    pixels = split_alpha(read_image(path))[0]
    check_pixels(pixels, str(path))
    if path.suffix.lower() in (".png", ".tga"):
        pixels = encode_srgb(pixels)
    return np.broadcast_to(pixels, (*pixels.shape[:2], 3))


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
