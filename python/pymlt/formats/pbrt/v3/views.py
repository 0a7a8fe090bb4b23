"""The camera, film, filter, sampler and integrator of a pbrt-v3 file."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from .. import views
from ..params import Params
from ..views import sampler

if TYPE_CHECKING:
    import numpy as np

__all__ = ["camera", "film", "integrator", "rfilter", "sampler"]
DIRECT = ("directlighting", "whitted")


def camera(params: Params, camera_from_world: np.ndarray) -> dict[str, Any]:
    """Half of the angle of view may be given."""
    half = params.number("halffov", 0)
    return views.camera(params, camera_from_world) | ({"fov": 2 * half} if half > 0 else {})


def film(params: Params) -> dict[str, Any]:
    """Of which the crop window is given as shares of the image, left, right, top and bottom."""
    crop = params.array("cropwindow", 4)
    found = views.film(params)
    if crop is not None:
        sides = (found["width"], found["width"], found["height"], found["height"])
        ends = [math.ceil(side * min(max(x, 0), 1)) for side, x in zip(sides, crop[0], strict=True)]
        left, right, top, bottom = ends
        found |= {"crop_offset_x": left, "crop_width": right - left}
        found |= {"crop_offset_y": top, "crop_height": bottom - top}
    return found


def rfilter(params: Params) -> dict[str, Any]:
    """Of the widths, that along x is taken."""
    width = params.number("xwidth", {"box": 0.5, "sinc": 4.0}.get(params.type, 2.0))
    if params.type == "box":
        return {"type": "box", "radius": width}
    if params.type == "triangle":
        return {"type": "tent", "radius": width}
    if params.type == "gaussian":
        return {"type": "gaussian", "stddev": math.sqrt(0.5 / params.number("alpha", 2))}
    if params.type == "mitchell":
        return {"type": "mitchell"} | {n.lower(): params.number(n, 1 / 3) for n in ("B", "C")}
    return views.rfilter(params)


def integrator(params: Params) -> dict[str, Any] | None:
    """Those of direct light follow mirrors and glass in pbrt, ours do not."""
    if params.type not in DIRECT:
        return views.integrator(params)
    params.warn(
        f"the integrator {params.type!r} becomes 'direct': in mirrors and glass is no light"
    )
    return {"type": "direct"}


def exposure_time(camera: Params) -> float:
    """The time that the shutter is open does not change how bright the image is."""
    for name in ("shutteropen", "shutterclose"):
        camera.get(name)
    return 1.0


def sensitivity(film: Params) -> float:
    """By which the image is multiplied."""
    return film.number("scale", 1)
