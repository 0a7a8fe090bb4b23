"""Texture coordinates: the primvar that a network starts from, and what it does to it."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..imported import Imported
from .networks import Node

#: A v that points up as one that points down, as that of our meshes does, and back.
OVER = np.array([[1.0, 0, 0, 0], [0, -1, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]])
FIRST = "st"  #: the primvar of texture coordinates that a network does not name
#: Shaders that give a primvar, and the input that has its name, if they have one.
READERS = {
    "UsdPrimvarReader_float2": "varname",
    "ND_geompropvalue_vector2": "geomprop",
    "ND_texcoord_vector2": "",
    "ND_texcoord_vector3": "",
}
ARITHMETIC = ("add", "subtract", "multiply", "divide")


def to_uv(node: Node | None, made: Imported) -> tuple[str, dict[str, Any]]:
    """The primvar of texture coordinates, and the parameter of a `bitmap` that transforms them."""
    matrix = np.eye(4)
    while node is not None and node.id not in READERS:
        found = step(node)
        if found is None:
            made.warn(f"texture coordinates of the kind {node.id!r} are left out")
            break
        node, local = found
        matrix = matrix @ local
    reader = READERS.get(node.id) if node is not None else None
    name = str(node.value(reader, FIRST)) if node is not None and reader else FIRST
    same = np.allclose(matrix, np.eye(4), rtol=0, atol=1e-12)
    return name, {} if same else {"to_uv": OVER @ matrix @ OVER}


def step(node: Node) -> tuple[Node | None, np.ndarray] | None:
    """What a shader transforms, and how, (4, 4); None if that is no such transform."""
    kind = node.id.split("_")[1] if node.id.startswith("ND_") else node.id
    if kind == "UsdTransform2d":
        return node.source("in"), transform_2d(node)
    if kind in ("convert", "dot"):
        return node.source("in"), np.eye(4)
    if kind in ("rotate2d", "rotate3d"):
        if kind == "rotate3d" and node.value("amount", 0.0) and axis(node) is None:
            return None
        return node.source("in"), rotation(node.value("amount", 0.0) * (axis(node) or 1))
    if kind in ARITHMETIC:
        return arithmetic(node, kind)
    return None


def axis(node: Node) -> float | None:
    """1 for a rotation about z, -1 for one about -z."""
    x, y, z = node.numbers("axis", [0, 1, 0]) if node.id.startswith("ND_rotate3d") else (0, 0, 1)
    return None if x or y or not z else float(np.sign(z))


def rotation(degrees: float) -> np.ndarray:
    """Counter-clockwise, where v points up."""
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    matrix = np.eye(4)
    matrix[:2, :2] = [[cos, -sin], [sin, cos]]
    return matrix


def transform_2d(node: Node) -> np.ndarray:
    """UsdTransform2d scales, rotates and translates, in this order."""
    scale = np.diag([*node.numbers("scale", [1, 1]), 1, 1])
    matrix = rotation(node.value("rotation", 0.0)) @ scale
    matrix[:2, 3] = node.numbers("translation", [0, 0])
    return matrix


def arithmetic(node: Node, kind: str) -> tuple[Node | None, np.ndarray] | None:
    """One connected input and a constant; None for two connected ones, or one divided by."""
    first, second = node.source("in1"), node.source("in2")
    if (first is None) == (second is None):
        return None
    name = "in1" if first is None else "in2"
    constant = np.zeros(3)
    given = np.atleast_1d(np.array(node.value(name, 0.0 if kind in ARITHMETIC[:2] else 1.0)))
    constant[: len(given)] = given
    if len(given) == 1:
        constant[:] = given
    matrix = np.eye(4)
    if kind == "multiply":
        matrix[:2, :2] = np.diag(constant[:2])
    elif kind == "divide" and first is not None and constant[:2].all():
        matrix[:2, :2] = np.diag(1 / constant[:2])
    elif kind == "add":
        matrix[:2, 3] = constant[:2]
    elif kind == "subtract" and first is not None:
        matrix[:2, 3] = -constant[:2]
    else:
        return None
    return first or second, matrix
