"""The camera, film, filter, sampler and integrator of a pbrt-v3 file."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from .. import views
from ..params import Params
from ..views import film, sampler

if TYPE_CHECKING:
    import numpy as np

__all__ = ["camera", "film", "integrator", "rfilter", "sampler"]
DIRECT = ("directlighting", "whitted")


def camera(params: Params, camera_from_world: np.ndarray) -> dict[str, Any]:
    """Half of the angle of view may be given."""
    half = params.number("halffov", 0)
    return views.camera(params, camera_from_world) | ({"fov": 2 * half} if half > 0 else {})


def rfilter(params: Params) -> dict[str, Any]:
    """That of Gauss has another parameter than in pbrt-v4, in the exponent."""
    if params.type == "gaussian":
        return {"type": "gaussian", "stddev": math.sqrt(0.5 / params.number("alpha", 2))}
    return views.rfilter(params, "xwidth")


def integrator(params: Params) -> dict[str, Any] | None:
    """Those of direct light follow mirrors and glass in pbrt; ours does not."""
    if params.type not in DIRECT:
        return views.integrator(params)
    params.warn(f"the integrator {params.type!r} becomes 'direct', without mirrors and glass")
    return {"type": "direct"}


def exposure_time(camera: Params) -> float:
    """The time that the shutter is open does not change how bright the image is."""
    for name in ("shutteropen", "shutterclose"):
        camera.get(name)
    return 1.0


def sensitivity(film: Params) -> float:
    """By which the image is multiplied."""
    return film.number("scale", 1)
