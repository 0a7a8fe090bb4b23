"""Dicts that are a part of a scene, in the place of a scene."""

from __future__ import annotations

from typing import Any

from .. import _core

_SENSOR = "'sensor': {'type': 'perspective', 'film': "
_SHAPE = "'shape': {'type': 'sphere', "
#: Where a scene dict has the plug-ins of a family.
HOMES = {
    "bsdf": _SHAPE + "'bsdf': PART}",
    "emitter": "'emitter': PART",
    "film": _SENSOR + "PART}",
    "integrator": "'integrator': PART",
    "medium": _SHAPE + "'interior': PART}",
    "phase": _SHAPE + "'interior': {'type': 'homogeneous', 'phase': PART}}",
    "rfilter": _SENSOR + "{'type': 'hdrfilm', 'rfilter': PART}}",
    "sampler": "'sensor': {'type': 'perspective', 'sampler': PART}",
    "sensor": "'sensor': PART",
    "shape": "'shape': PART",
    "texture": _SHAPE + "'bsdf': {'type': 'diffuse', 'reflectance': PART}}",
    "volume": _SHAPE + "'interior': {'type': 'heterogeneous', 'sigma_t': PART}}",
}
#: Emitters that are a part of a shape.
OF_SHAPES = ("area", "directionalarea")


def check_is_scene(given: dict[str, Any]) -> None:
    """Raises SceneError for a plug-in that is a part of a scene, with a scene that has it."""
    kind = given.get("type")
    if kind is None and given and all(isinstance(part, dict) for part in given.values()):
        raise _core.SceneError("scene: needs a 'type'; add 'type': 'scene'")
    for family, home in HOMES.items():
        if kind in _core.names(family):
            if kind in OF_SHAPES:
                home = _SHAPE + "'emitter': PART}"
            part = home.replace("PART", f"{{'type': {kind!r}, ...}}")
            raise _core.SceneError(
                f"scene: {kind!r} is the type of a part, {family}, and not of a scene; a scene has "
                f"it as in {{'type': 'scene', {part}, ...}}, and needs a sensor, light and shapes"
            )
