"""Solids of glass in files of other programs, which may overlap: the smaller one wins."""

from __future__ import annotations

from typing import Any

import numpy as np


def give_priorities(scene: dict[str, Any]) -> None:
    """Gives closed shapes that light enters the priority 0, if there are several of them.

    In pbrt, glTF and USD they have none: which of two that overlap is there is left open. A shape
    that names the medium outside is taken as it is.
    """
    solids = [shape for shape in scene.values() if is_solid(shape, scene)]
    if len(solids) > 1:
        for shape in solids:
            shape["priority"] = 0


def is_solid(shape: Any, scene: dict[str, Any]) -> bool:
    if not isinstance(shape, dict) or "bsdf" not in shape or "exterior" in shape:
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
    """Whether each edge lies between two triangles, which go along it in opposite directions."""
    positions, where = np.unique(np.asarray(mesh["vertices"]), axis=0, return_inverse=True)
    corners = where.reshape(-1)[np.asarray(mesh["faces"])]
    first, second = corners.ravel(), np.roll(corners, -1, axis=1).ravel()
    there = first != second
    n = len(positions)
    edges, back = (first * n + second)[there], (second * n + first)[there]
    return bool(len(edges)) and np.array_equal(np.sort(edges), np.sort(back))
