"""A scene that shows materials: balls in a row on a floor, in soft light."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...scenes.transforms import Transform
from ..imported import Imported, rgb

MOST = 8  #: balls
APART = 2.4  #: between the centres of balls, whose radius is 1
HEIGHT = 480  #: of the image, in pixels
VIEW = 2.75  #: what the image shows of the height, where the balls are
NARROWEST = 4 / 3  #: the width of an image by its height
WIDEST = 34.0  #: degrees from its left to its right
AWAY = (0.0, 0.3, 1.0)  #: from the middle of the row to the camera
FLOOR = 100.0  #: half a side
HORIZON, ZENITH = (0.12, 0.13, 0.15), (0.55, 0.6, 0.68)  #: radiances of the sky


def preview(materials: dict[str, dict[str, Any]], made: Imported) -> None:
    """Adds each material on a ball, and what else a picture of them needs; y is up."""
    names = list(materials)
    for name in names[MOST:]:
        made.warn(f"the material {name} is left out: {MOST} are shown")
    width = APART * len(names[:MOST])
    for index, name in enumerate(names[:MOST]):
        x = APART * (index + 0.5) - width / 2
        standing = Transform.translate([x, 1, 0]).rotate([0, 1, 0], 90).rotate([1, 0, 0], -90)
        made.add(name, {"type": "sphere", "to_world": standing.matrix, **materials[name]})
    made.add("floor", floor())
    made.add("key", softbox([-3 - width / 2, 6, 6], 2 + width / 6, (9.0, 8.7, 8.2)))
    made.add("rim", softbox([3 + width / 2, 6, -6], 1.5 + width / 6, (5.0, 5.3, 5.8)))
    made.add("sky", sky())
    made.add("camera", camera(width))


def floor() -> dict[str, Any]:
    """A board of grey squares, which show what balls refract and reflect; their sides are 1."""
    squares = {
        "type": "checkerboard",
        "color0": rgb([0.2, 0.2, 0.2]),
        "color1": rgb([0.3, 0.3, 0.3]),
        "to_uv": Transform.scale([FLOOR, FLOOR, 1]).matrix,
    }
    return {
        "type": "rectangle",
        "to_world": Transform.rotate([1, 0, 0], -90).scale(FLOOR).matrix,
        "bsdf": {"type": "diffuse", "reflectance": squares},
    }


def softbox(origin: list[float], size: float, radiance: tuple[float, ...]) -> dict[str, Any]:
    """A square light that shines on the row; `size` is half a side."""
    place = Transform.look_at(origin=origin, target=[0, 0.8, 0], up=[0, 1, 0])
    return {
        "type": "rectangle",
        "to_world": (place @ Transform.scale([size, size, 1])).matrix,
        "bsdf": {"type": "diffuse", "reflectance": 0.0},
        "emitter": {"type": "area", "radiance": rgb(radiance)},
    }


def sky() -> dict[str, Any]:
    """One that is brighter above than at the horizon."""
    height = np.linspace(1, -1, 16).clip(0, 1)[:, None, None]
    rows = (1 - height) * np.array(HORIZON) + height * np.array(ZENITH)
    return {"type": "envmap", "data": np.tile(rows, (1, 32, 1)).astype(np.float32)}


def camera(width: float) -> dict[str, Any]:
    """One that sees the whole row, from so far that the balls at its ends look round."""
    aspect = max((width + 0.4) / VIEW, NARROWEST)
    distance = max(aspect * VIEW / 2 / math.tan(math.radians(WIDEST / 2)), 6.0)
    scale = distance / math.hypot(*AWAY)
    middle = np.array([0, 0.95, 0])
    look = Transform.look_at(origin=middle + scale * np.array(AWAY), target=middle, up=[0, 1, 0])
    return {
        "type": "perspective",
        "fov": 2 * math.degrees(math.atan(VIEW / 2 / distance)),
        "fov_axis": "y",
        "to_world": look.matrix,
        "film": {"type": "hdrfilm", "width": round(HEIGHT * aspect), "height": HEIGHT},
    }
