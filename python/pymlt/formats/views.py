"""What a scene that is to be rendered needs and some files lack: a film, a camera, light."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from .. import _core
from ..scenes.loading import load_dict
from ..scenes.transforms import Transform
from .imported import Imported

if TYPE_CHECKING:
    import numpy as np

HEIGHT = 720  #: of an image whose size the file does not tell, in pixels
CAMERAS = ("perspective", "orthographic", "thinlens", "spherical")
AWAY = (0.5, 0.4, 1.0)  #: from the middle of a scene to a camera that is added
SKY = {"type": "constant", "radiance": 0.15}
SUNBEAM = (1.0, -1.5, -1.2)  #: the way of sunlight, as that camera is turned


def film(aspect: float) -> dict[str, Any]:
    """An image whose width is `aspect` times its height."""
    return {"type": "hdrfilm", "width": max(1, round(HEIGHT * aspect)), "height": HEIGHT}


def complete(made: Imported, *, dim: bool = False, announced: bool = True) -> None:
    """Adds a camera and daylight where there are none, with one warning if `announced`.

    `dim` says that what emits is too weak to light the scene.
    """
    lacks, added = [], []
    dark = not any(map(emits, plugins(made.scene)))
    if dark or dim:
        lacks.append("there is no light" if dark else "what glows is too weak to light the scene")
        added += ["an even sky", "a sun"]
        made.add("sky", SKY)
    cameras = [plugin for plugin in plugins(made.scene) if plugin["type"] in CAMERAS]
    if not cameras:
        lacks.append("there is no camera")
        added.append("a camera that sees everything")
        cameras.append(overview(made.scene))
        made.add("camera", cameras[0])
    if dark or dim:
        made.add("sun", sun(cameras[0]))
    if announced and added:
        verb = "is" if len(added) == 1 else "are"
        things = " and ".join(filter(None, [", ".join(added[:-1]), added[-1]]))
        made.warn(f"{', and '.join(lacks)}; {things} {verb} added")


def plugins(scene: dict[str, Any]) -> list[dict[str, Any]]:
    """All that a scene is made of."""
    return [value for value in scene.values() if isinstance(value, dict)]


def emits(plugin: dict[str, Any]) -> bool:
    """Whether it is a light, a shape that is one, or a medium that glows."""
    if plugin["type"] in _core.names("medium"):
        return not {"emission", "temperature"}.isdisjoint(plugin)
    return "emitter" in plugin or plugin["type"] in _core.names("emitter")


def sun(camera: dict[str, Any]) -> dict[str, Any]:
    """A sun over the left shoulder of a camera, which shows the form; y is up."""
    import numpy as np

    to_world = camera["to_world"]
    if isinstance(to_world, dict):  # an animation: as it begins
        to_world = next(matrix for time, matrix in to_world.items() if time != "type")
    forward = np.asarray(to_world)[:3, 2]
    turn = azimuth(forward) - azimuth(-np.array(AWAY)) if forward[[0, 2]].any() else 0.0
    turned = Transform.rotate([0, 1, 0], math.degrees(turn)).matrix[:3, :3] @ SUNBEAM
    return {"type": "directional", "direction": turned.tolist(), "irradiance": 3.0}


def azimuth(direction: np.ndarray) -> float:
    """Where a direction points if seen from above: radians from +z towards +x."""
    return math.atan2(direction[0], direction[2])


def overview(scene: dict[str, Any]) -> dict[str, Any]:
    """A camera that sees a whole scene from its front, right and above; y is up."""
    import numpy as np

    draft = {"type": "perspective", "fov": 40.0, "film": film(16 / 9)}
    center, radius = np.zeros(3), 1.0
    seen = load_dict(scene | {"camera": draft})
    for _ in range(3):  # the bounds of a scene hold its camera, which moves into them
        info = seen.updated({"camera.to_world": Transform.translate(center)}).info()
        center, radius = np.array(info["center"]), max(info["radius"], 1e-6)
    away = np.array(AWAY) / np.linalg.norm(AWAY)
    origin = center + 1.1 * radius / np.sin(np.radians(20)) * away
    to_world = Transform.look_at(origin=origin, target=center, up=[0, 1, 0])
    return draft | {"fov_axis": "y", "to_world": to_world}
