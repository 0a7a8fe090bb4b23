"""What a scene that is to be rendered needs and some files lack: a film, a camera, light."""

from __future__ import annotations

from typing import Any

from .. import _core
from ..scenes.loading import load_dict
from ..scenes.transforms import Transform
from .imported import Imported

HEIGHT = 720  #: of an image whose size the file does not tell, in pixels
CAMERAS = ("perspective", "orthographic", "thinlens")


def film(aspect: float) -> dict[str, Any]:
    """An image whose width is `aspect` times its height."""
    return {"type": "hdrfilm", "width": max(1, round(HEIGHT * aspect)), "height": HEIGHT}


def complete(made: Imported) -> None:
    """Adds a camera and light, with a warning, where there are none."""
    plugins = list(made.scene.values())[1:]
    types = {plugin["type"] for plugin in plugins}
    emitters = set(_core.names("emitter"))
    if not types & emitters and not any("emitter" in plugin for plugin in plugins):
        made.warn("there is no light; an even one from everywhere is added")
        made.add("light", {"type": "constant", "radiance": 1.0})
    if not types & set(CAMERAS):
        made.warn("there is no camera; one that sees everything is added")
        made.add("camera", overview(made.scene))


def overview(scene: dict[str, Any]) -> dict[str, Any]:
    """A camera that sees a whole scene from its front, right and above; y is up."""
    import numpy as np

    draft = {"type": "perspective", "fov": 40.0, "film": film(16 / 9)}
    center, radius = np.zeros(3), 1.0
    seen = load_dict(scene | {"camera": draft})
    for _ in range(3):  # the bounds of a scene hold its camera, which moves into them
        info = seen.updated({"camera.to_world": Transform.translate(center)}).info()
        center, radius = np.array(info["center"]), max(info["radius"], 1e-6)
    away = np.array([0.5, 0.4, 1.0])
    origin = center + 1.1 * radius / np.sin(np.radians(20)) * away / np.linalg.norm(away)
    to_world = Transform.look_at(origin=origin, target=center, up=[0, 1, 0])
    return draft | {"fov_axis": "y", "to_world": to_world}
