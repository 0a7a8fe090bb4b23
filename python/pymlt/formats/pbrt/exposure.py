"""How bright the film of pbrt-v4 makes the image (Pharr, Jakob & Humphreys 2023, sec. 5.4.2)."""

from __future__ import annotations

from typing import Any

from .arithmetic import multiplied
from .params import Params

STRENGTHS = ("radiance", "irradiance", "intensity")


def exposure_time(camera: Params) -> float:
    """In seconds. Raises SceneError for a shutter that closes before it opens."""
    found = camera.number("shutterclose", 1) - camera.number("shutteropen", 0)
    if not found > 0:
        raise camera.where.error("'shutterclose' should be later than 'shutteropen'")
    return found


def sensitivity(film: Params) -> float:
    """By which pbrt multiplies light, for each second; 1 for the values by default."""
    sensor = film.text("sensor", "cie1931")
    if sensor != "cie1931":
        film.warn(f"the colours of the sensor {sensor!r} are left out; it is taken as 'cie1931'")
    found = film.number("iso", 100) / 100
    if not found > 0:
        raise film.where.error("'iso' should be above 0")
    return found


def expose(scene: dict[str, Any], ratio: float) -> None:
    """Gives all lights of a scene dict the strength that the image has: our film has none."""
    for name, part in scene.items():
        if isinstance(part, dict) and ratio != 1:
            scene[name] = _exposed(part, ratio)


def _exposed(part: dict[str, Any], ratio: float) -> dict[str, Any]:
    made = dict(part)
    if "emitter" in part:
        made["emitter"] = _exposed(part["emitter"], ratio)
    elif part["type"] in ("envmap", "goniometric", "projector"):
        made["scale"] = part["scale"] * ratio
    else:
        made |= {key: multiplied(part[key], ratio) for key in STRENGTHS if key in part}
    return made
