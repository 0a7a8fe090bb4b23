"""Spheres, cubes, planes, cylinders, cones and capsules (UsdGeomGprim), which have no textures."""

from __future__ import annotations

from typing import Any

import numpy as np
from pxr import Usd, UsdGeom

from ..imported import Imported
from ..ply import Mesh

AROUND, QUARTER = 96, 24  #: parts of a turn, and of a quarter of a circle
#: Which axes those of a shape become, of which the third one is meant.
AXES = {"X": [1, 2, 0], "Y": [2, 0, 1], "Z": [0, 1, 2]}


def shape(prim: Usd.Prim, time: Usd.TimeCode, made: Imported) -> dict[str, Any] | None:
    """One of these shapes in the frame of its prim, with a `to_world` where it needs one there.

    None for a prim that is none of them.
    """
    for kind, make in SHAPES.items():
        if prim.IsA(kind):
            return make(kind(prim), time, made)
    return None


def sphere(prim: UsdGeom.Sphere, time: Usd.TimeCode, made: Imported) -> dict[str, Any]:
    return {"type": "sphere", "radius": float(prim.GetRadiusAttr().Get(time))}


def cube(prim: UsdGeom.Cube, time: Usd.TimeCode, made: Imported) -> dict[str, Any]:
    half = float(prim.GetSizeAttr().Get(time)) / 2
    return {"type": "cube", "to_world": np.diag([half, half, half, 1])}


def plane(prim: UsdGeom.Plane, time: Usd.TimeCode, made: Imported) -> dict[str, Any]:
    """A rectangle: its width is along x, or along z if x is normal to it."""
    width, length = (float(a.Get(time)) / 2 for a in (prim.GetWidthAttr(), prim.GetLengthAttr()))
    axis = str(prim.GetAxisAttr().Get(time))
    sides = (width, length) if axis == "Z" else (length, width)
    return {"type": "rectangle", "to_world": frame(axis) @ np.diag([*sides, 1, 1])}


def cylinder(prim: UsdGeom.Cylinder, time: Usd.TimeCode, made: Imported) -> dict[str, Any]:
    """A closed one."""
    radius, half, axis = measures(prim, time)
    points = [[0, -half], [radius, -half], [radius, half], [0, half]]
    return revolved(pieces(points), each([[0, -1], [1, 0], [0, 1]]), axis, made)


def cone(prim: UsdGeom.Cone, time: Usd.TimeCode, made: Imported) -> dict[str, Any]:
    """A closed one, whose apex points along its axis."""
    radius, half, axis = measures(prim, time)
    slope = np.array([2 * half, radius]) / np.hypot(2 * half, radius)
    points = [[0, -half], [radius, -half], [0, half]]
    return revolved(pieces(points), each([[0, -1], slope]), axis, made)


def capsule(prim: UsdGeom.Capsule, time: Usd.TimeCode, made: Imported) -> dict[str, Any]:
    """A cylinder between two halves of a sphere."""
    radius, half, axis = measures(prim, time)
    return rounded(radius, half, axis, made)


def ellipsoid(radius: float, made: Imported) -> dict[str, Any]:
    """A sphere as a mesh, for transforms that stretch it."""
    return rounded(radius, 0.0, "Z", made)


def rounded(radius: float, half: float, axis: str, made: Imported) -> dict[str, Any]:
    """Two halves of a sphere, whose centres are `half` away from the origin."""
    angles = np.linspace(0, np.pi / 2, QUARTER + 1)
    angles = np.concatenate([-angles[::-1], angles])
    normals = np.stack([np.cos(angles), np.sin(angles)], 1)
    points = radius * normals + np.where(angles < 0, -half, half)[:, None] * [0, 1]
    points[QUARTER, 1] = -half
    return revolved(pieces(points), pieces(normals), axis, made)


SHAPES = {
    UsdGeom.Sphere: sphere,
    UsdGeom.Cube: cube,
    UsdGeom.Plane: plane,
    UsdGeom.Cylinder: cylinder,
    UsdGeom.Cone: cone,
    UsdGeom.Capsule: capsule,
}


def measures(prim: Any, time: Usd.TimeCode) -> tuple[float, float, str]:
    """The radius, half the height, and the axis."""
    radius, height = (float(a.Get(time)) for a in (prim.GetRadiusAttr(), prim.GetHeightAttr()))
    return radius, height / 2, str(prim.GetAxisAttr().Get(time))


def frame(axis: str) -> np.ndarray:
    """Where the z axis of a shape becomes the named one, (4, 4)."""
    placed = np.eye(4)
    placed[:3, :3] = np.eye(3)[:, AXES[axis]]
    return placed


def pieces(points: Any) -> np.ndarray:
    """The two ends of each piece of a line, (pieces, 2, 2)."""
    line = np.asarray(points, dtype=float)
    return np.stack([line[:-1], line[1:]], 1)


def each(normals: Any) -> np.ndarray:
    """The normals of straight pieces at their two ends, (pieces, 2, 2)."""
    return np.stack([normals, normals], 1)


def revolved(line: np.ndarray, normals: np.ndarray, axis: str, made: Imported) -> dict[str, Any]:
    """The surface that a line makes around an axis: pieces of (radius, height), from below."""
    angles = np.linspace(0, 2 * np.pi, AROUND + 1)
    turn = np.stack([np.cos(angles), np.sin(angles)], 1)

    def around(flat: np.ndarray) -> np.ndarray:
        rows = flat.reshape(-1, 1, 2)
        high = np.broadcast_to(rows[..., 1:], (len(rows), len(turn), 1))
        turned = np.concatenate([rows[..., :1] * turn, high], 2).reshape(-1, 3)
        return np.ascontiguousarray(turned @ frame(axis)[:3, :3].T, np.float32)

    row = np.arange(len(line))[:, None] * 2 * len(angles)
    a = (row + np.arange(AROUND)).ravel()
    b, c, d = a + 1, a + len(angles) + 1, a + len(angles)
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return made.mesh("shape", Mesh(around(line), faces, around(normals)))
