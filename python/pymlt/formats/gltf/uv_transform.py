"""Transforms of texture coordinates (KHR_texture_transform)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from .checked import number, numbers

if TYPE_CHECKING:
    import numpy as np

UV_TRANSFORM = "KHR_texture_transform"


def to_uv(given: dict[str, Any]) -> np.ndarray:
    """Translation times rotation times scale, (4, 4), for `to_uv` of a `bitmap`.

    A rotation is counter-clockwise where v points down, as the example of the specification and its
    Sample Viewer have it; the GLSL code of the specification turns the other way.
    """
    import numpy as np

    offset = numbers(given.get("offset", [0, 0]), 2, "offset")
    scale = numbers(given.get("scale", [1, 1]), 2, "scale")
    angle = number(given.get("rotation", 0), "rotation")
    matrix = np.eye(4)
    cos, sin = math.cos(angle), math.sin(angle)
    matrix[:2, :2] = np.array([[cos, sin], [-sin, cos]]) * scale
    matrix[:2, 3] = offset
    return matrix
