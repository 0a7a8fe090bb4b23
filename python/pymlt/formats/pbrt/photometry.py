"""The power, or the illuminance of what faces them, that lights of pbrt-v4 are given."""

from __future__ import annotations

import math

from .params import Params


def brightening(params: Params) -> float:
    """Of a light without an image, whose intensity or radiance has the luminance 1."""
    match params.type:
        case "distant":
            return factor(params, "illuminance", 1)
        case "infinite":
            return factor(params, "illuminance", math.pi)
        case "spot":
            return factor(params, "power", 2 * math.pi * height_of_beam(params))
    return factor(params, "power", 4 * math.pi)


def height_of_beam(params: Params) -> float:
    """Of a cap of the unit sphere with the spot's light: pbrt's edge is even in the cosine."""
    cone = params.number("coneangle", 30)
    angles = cone, cone - params.number("conedeltaangle", 5)
    return 1 - sum(math.cos(math.radians(angle)) for angle in angles) / 2


def factor(params: Params, name: str, has: float) -> float:
    """What makes the power or the illuminance that a light has the one that it is given; 1 if it
    is given none."""
    given = params.number(name, 0)
    if not given > 0:
        return 1.0
    if not has > 0:
        raise params.where.error(f"the light has a {name!r}, but no direction in which it shines")
    return given / has
