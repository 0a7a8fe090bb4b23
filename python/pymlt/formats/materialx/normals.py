"""Normals that a shader bends."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..imported import Imported
from .graph import Graph
from .origin import Port, origin
from .scope import Scope
from .shaders import Shader
from .textures import Pattern, Textures

STRAIGHT = np.array([0.0, 0.0, 1.0])


def with_normals(
    surface: dict[str, Any], shader: Shader, textures: Textures, made: Imported
) -> dict[str, Any]:
    """A BSDF below the normals that a shader is given; others are left out with a warning."""
    port = shader.normal
    if port is None:
        return surface
    where = f"{shader.node.getNamePath()}: normal"
    if shader.kind == "UsdPreviewSurface" and not is_normal_map(origin(port, textures.factor)):
        return bent(surface, _encoded(port), textures, where)
    found = origin(port, textures.factor)
    if found is None or found[0].getCategory() == "normal":
        return surface
    node, scope = found
    if not is_normal_map(found):
        made.warn(f"{node.getNamePath()}: normals by {node.getCategory()!r} are left out")
        return surface
    scale = textures.factor(node, "scale", scope)
    image = node.getInput("in")
    if set(scale or ()) == {1.0} and image is not None:
        return {
            "type": "normalmap",
            "normalmap": textures.texture((image, scope), where, raw=True),
            "bsdf": surface,
        }
    return bent(surface, lambda graph: scaled(graph, node, scope), textures, where)


def is_normal_map(found: tuple[Any, Scope] | None) -> bool:
    return found is not None and found[0].getCategory() == "normalmap"


def bent(
    surface: dict[str, Any], pattern: Pattern, textures: Textures, where: str
) -> dict[str, Any]:
    """A BSDF below normals (N + 1) / 2 that are computed, unless all are straight."""
    constant = textures.constant(pattern)
    if constant is not None:
        if np.allclose(2 * np.array(constant) - 1, STRAIGHT):
            return surface
        normals: Any = {"type": "bitmap", "data": np.array([[constant]], np.float32), "raw": True}
    else:
        normals = textures.computed(pattern, where, raw=True)
    return {"type": "normalmap", "normalmap": normals, "bsdf": surface}


def _encoded(port: Port) -> Pattern:
    return lambda graph: (graph.value(*port) + 1) / 2


def scaled(graph: Graph, node: Any, scope: Scope) -> np.ndarray:
    """The normals of a `normalmap` whose slopes are multiplied by a number, or by two."""
    normal = 2 * graph.argument(node, "in", scope) - 1
    scale = graph.argument(node, "scale", scope)
    factors = np.broadcast_to(scale, (*scale.shape[:-1], 2))
    slopes = normal[..., :2] * factors
    steep = np.concatenate([slopes, normal[..., 2:] + 0 * slopes[..., :1]], axis=-1)
    unit: np.ndarray = steep / np.linalg.norm(steep, axis=-1, keepdims=True)
    return (unit + 1) / 2
