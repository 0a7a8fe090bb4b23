"""Cameras (glTF 2.0, sec. 3.10) and lights (KHR_lights_punctual): both look along -z, y is up."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ..frames import looking
from ..imported import Imported, rgb
from ..views import film
from .checked import number

if TYPE_CHECKING:
    import numpy as np

#: PBR_WATTS_TO_LUMENS of Blender's exporter and importer, io_scene_gltf2/blender/com/conversion.py.
LUMENS_PER_WATT = 683


def sensor(camera: Any, to_world: np.ndarray) -> dict[str, Any]:
    """A perspective or orthographic camera, with a film of its aspect ratio."""
    import numpy as np

    placed = looking(to_world)
    if camera.type == "orthographic":
        view = camera.orthographic
        aspect = view.xmag / view.ymag
        placed = placed @ np.diag([view.xmag, view.xmag, 1, 1])
        return {"type": "orthographic", "to_world": placed, "film": film(aspect)}
    view = camera.perspective
    return {
        "type": "perspective",
        "fov": math.degrees(view.yfov),
        "fov_axis": "y",
        "to_world": placed,
        "film": film(view.aspectRatio or 16 / 9),
    }


def light(given: dict[str, Any], to_world: np.ndarray, made: Imported) -> dict[str, Any]:
    """A light without size. Lux and candela become watts per area and per solid angle."""
    colour = list(given.get("color", (1, 1, 1)))[:3]
    intensity = number(given.get("intensity", 1), "the intensity of a light") / LUMENS_PER_WATT
    power = [intensity * number(c, "the color of a light") for c in colour]
    if given.get("range"):
        made.warn("the range of lights is left out: they obey the inverse square")
    placed = looking(to_world)
    if given["type"] == "directional":
        direction = placed[:3, 2].tolist()
        return {"type": "directional", "irradiance": rgb(power), "direction": direction}
    if given["type"] == "point":
        position = placed[:3, 3].tolist()
        return {"type": "point", "intensity": rgb(power), "position": position}
    cone = given.get("spot", {})
    made.warn("the edge of a spot light falls off linearly with the angle")
    return {
        "type": "spot",
        "intensity": rgb(power),
        "cutoff_angle": math.degrees(number(cone.get("outerConeAngle", math.pi / 4), "a cone")),
        "beam_width": math.degrees(number(cone.get("innerConeAngle", 0), "a cone")),
        "to_world": placed,
    }
