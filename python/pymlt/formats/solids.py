"""Solids of glass in files of other programs, which may overlap: the smaller one wins."""

from __future__ import annotations

from typing import Any

import numpy as np

TOLERANCE = 5e-4  #: of the volume and of the area: half of that in cpp/scene/solid/closed.cpp


def give_priorities(scene: dict[str, Any]) -> None:
    """Gives closed shapes that light enters the priority 0, if there are several of them.

    In pbrt, glTF and USD they have none: which of two that overlap is there is left open. A shape
    that names the medium outside, or moves, is taken as it is.
    """
    solids = [shape for shape in scene.values() if is_solid(shape, scene)]
    if len(solids) > 1:
        for shape in solids:
            shape["priority"] = 0


def is_solid(shape: Any, scene: dict[str, Any]) -> bool:
    if not isinstance(shape, dict) or "bsdf" not in shape or "exterior" in shape:
        return False
    if isinstance(shape.get("to_world"), dict):  # it moves
        return False
    if not light_enters(shape["bsdf"], scene):
        return False
    kind = shape.get("type")
    return kind in ("sphere", "cube") or (kind == "mesh" and is_closed(shape))


def light_enters(bsdf: dict[str, Any], scene: dict[str, Any]) -> bool:
    if bsdf.get("type") == "ref":
        bsdf = scene.get(bsdf["id"], {})
    if bsdf.get("type") == "openpbr":
        weights = bsdf.get("transmission_weight", 0), bsdf.get("subsurface_weight", 0)
        return not bsdf.get("geometry_thin_walled") and any(weight != 0 for weight in weights)
    return bsdf.get("type") in ("dielectric", "roughdielectric")


def is_closed(mesh: dict[str, Any]) -> bool:
    """Whether the divergence theorem holds: int x_i n_j dA is its volume for i = j, else 0."""
    positions = np.asarray(mesh["vertices"], dtype=float)
    corners = (positions - positions[:1])[np.asarray(mesh["faces"])]
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    areas = 0.5 * np.cross(b - a, c - a)
    moments = corners.mean(1).T @ areas
    volume = np.trace(moments) / 3
    total = np.linalg.norm(areas, axis=1).sum()
    return bool(
        volume != 0
        and np.abs(moments - volume * np.eye(3)).max() < TOLERANCE * abs(volume)
        and np.linalg.norm(areas.sum(0)) < TOLERANCE * total
    )
