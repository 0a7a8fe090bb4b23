"""The camera, film, filter, sampler and integrator of a pbrt-v4 file."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from .motion import after
from .params import Params

if TYPE_CHECKING:
    import numpy as np

INTEGRATORS = {
    "bdpt": "bdpt",
    "lightpath": "ptracer",
    "mlt": "pssmlt",
    "path": "path",
    "simplepath": "path",
    "volpath": "path",
}


def elements(found: dict[str, dict[str, Any]]) -> Iterator[tuple[str, dict[str, Any]]]:
    """An integrator and a sensor of what stands above WorldBegin, by the names of directives."""
    import numpy as np

    if found.get("Integrator"):
        yield "integrator", found["Integrator"]
    if "Camera" in found:
        film = found.get("Film", {"type": "hdrfilm", "width": 1280, "height": 720})
        if "PixelFilter" in found:
            film = film | {"rfilter": found["PixelFilter"]}
        sensor = found["Camera"] | {"film": film}
        if sensor.pop("window", True) is False:  # its shorter side is 2
            width = max(1, film["width"] / film["height"])
            sensor["to_world"] = after(sensor["to_world"], np.diag([width, width, 1, 1]))
        if "Sampler" in found:
            sensor["sampler"] = found["Sampler"]
        yield "camera", sensor


def camera(params: Params, camera_from_world: np.ndarray) -> dict[str, Any]:
    """Its x axis points to the right, ours to the left."""
    import numpy as np

    to_world = np.linalg.inv(camera_from_world) @ np.diag([-1.0, 1, 1, 1])
    if params.type == "orthographic":
        return orthographic(params, to_world)
    if params.type in ("spherical", "environment"):
        return spherical(params, np.linalg.inv(camera_from_world))
    if params.type != "perspective":
        params.warn(f"the camera {params.type!r} is taken as 'perspective'")
    view = {
        "type": "perspective",
        "fov": angle_of_view(params),
        "fov_axis": "smaller",
        "to_world": to_world,
    }
    if radius := params.number("lensradius", 0):
        distance = params.number("focaldistance", 1e6)
        view |= {"type": "thinlens", "aperture_radius": radius, "focus_distance": distance}
    params.finish()
    return view


def orthographic(params: Params, to_world: np.ndarray) -> dict[str, Any]:
    """Our image is 2 wide, that of pbrt as wide as its window: if it has none, see `elements`."""
    import numpy as np

    window = params.array("screenwindow", 4)
    params.finish()
    if window is None:
        return {"type": "orthographic", "to_world": to_world, "window": False}
    left, right, bottom, top = window[0]
    placed = np.diag([(right - left) / 2, (right - left) / 2, 1, 1])
    placed[:2, 3] = -(left + right) / 2, (bottom + top) / 2
    return {"type": "orthographic", "to_world": to_world @ placed}


def spherical(params: Params, to_world: np.ndarray) -> dict[str, Any]:
    """The middle of its image looks along -x, that of ours along z; "environment" in pbrt-v3."""
    import numpy as np

    default = "equalarea" if params.type == "spherical" else "equirectangular"
    mapping = params.text("mapping", default)
    if mapping != "equirectangular":
        params.warn(f"the mapping {mapping!r} is taken as 'equirectangular'")
    params.finish()
    turned = np.zeros((4, 4))
    turned[0, 2], turned[1, 1], turned[2, 0], turned[3, 3] = -1, 1, 1, 1
    return {"type": "spherical", "to_world": to_world @ turned}


def angle_of_view(params: Params) -> float:
    """In degrees, along the shorter side; a window on the screen changes it."""
    degrees = params.number("fov", 90)
    window = params.array("screenwindow", 4)
    if window is None:
        return degrees
    left, right, bottom, top = window[0]
    if not math.isclose(left, -right) or not math.isclose(bottom, -top):
        params.warn("a 'screenwindow' is taken as if it were around the middle of the image")
    side = min(right - left, top - bottom) / 2
    return 2 * math.degrees(math.atan(side * math.tan(math.radians(degrees) / 2)))


def film(params: Params) -> dict[str, Any]:
    """Of which the crop window is given as shares of the image, left, right, top and bottom."""
    width = int(params.number("xresolution", 1280))
    height = int(params.number("yresolution", 720))
    crop = params.array("cropwindow", 4)
    params.finish(ignored=("filename", "diagonal", "savefp16"))
    found: dict[str, Any] = {"type": "hdrfilm", "width": width, "height": height}
    if crop is not None:
        sides = zip((width, width, height, height), crop[0].clip(0, 1), strict=True)
        left, right, top, bottom = (math.ceil(side * share) for side, share in sides)
        found |= {"crop_offset_x": left, "crop_width": right - left}
        found |= {"crop_offset_y": top, "crop_height": bottom - top}
    return found


def rfilter(params: Params, radius: str = "xradius") -> dict[str, Any]:
    """Of the radii, that along x is taken, by the name that it has."""
    match params.type:
        case "box":
            return {"type": "box", "radius": params.number(radius, 0.5)}
        case "triangle":
            return {"type": "tent", "radius": params.number(radius, 2)}
        case "mitchell":
            return {"type": "mitchell"} | {n.lower(): params.number(n, 1 / 3) for n in ("B", "C")}
        case "sinc":
            return {"type": "lanczos", "lobes": int(params.number("tau", 3))}
    return {"type": "gaussian", "stddev": params.number("sigma", 0.5)}


def sampler(params: Params) -> dict[str, Any]:
    samples = params.number("pixelsamples", 16)
    if params.type == "stratified":
        samples = params.number("xsamples", 4) * params.number("ysamples", 4)
    return {"type": "independent", "sample_count": int(samples)}


def integrator(params: Params) -> dict[str, Any] | None:
    """pbrt counts bounces, we count edges: one more."""
    name = INTEGRATORS.get(params.type)
    if name is None:
        params.warn(f"the integrator {params.type!r} has no counterpart")
        return None
    return {"type": name, "max_depth": int(params.number("maxdepth", 5)) + 1}
