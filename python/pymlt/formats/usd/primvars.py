"""Values on meshes: normals, texture coordinates and colours, by their interpolation."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from pxr import Usd, UsdGeom

from ... import _core
from .polygons import Polygons


class Values(NamedTuple):
    """Rows of numbers: for each point of a mesh, or for each corner of its faces."""

    rows: np.ndarray
    of_corners: bool


def values(
    found: np.ndarray, interpolation: str, polygons: Polygons, name: str, faces: int
) -> Values:
    """Rows of any interpolation; those of constants and faces become rows of points and corners.

    `faces` is the number of faces that the file has. Raises SceneError for a wrong count.
    """
    needed = {
        "constant": 1,
        "uniform": faces,
        "vertex": len(polygons.points),
        "varying": len(polygons.points),
        "faceVarying": len(polygons.kept),
    }
    if interpolation not in needed or len(found) < needed[interpolation]:
        raise _core.SceneError(
            f"{name} has {len(found)} values, but should have {needed.get(interpolation, 'some')}, "
            f"for its interpolation is {interpolation!r}"
        )
    match interpolation:
        case "constant":
            return Values(np.tile(found[:1], (len(polygons.points), 1)), False)
        case "uniform":
            return Values(found[polygons.face_of_corner], True)
        case "faceVarying":
            return Values(found[: len(polygons.kept)][polygons.kept], True)
    return Values(found[: len(polygons.points)], False)


def primvar(
    prim: Usd.Prim, name: str, width: int, polygons: Polygons, faces: int, time: Usd.TimeCode
) -> Values | None:
    """A primvar of so many numbers at each place; None if there is none."""
    found = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(name)
    rows = flattened(found, time) if found and found.HasValue() else None
    if rows is None or rows.ndim != 2 or rows.shape[1] < width:
        return None
    where = f"{prim.GetPath()}: primvars:{name}"
    return values(rows[:, :width], found.GetInterpolation(), polygons, where, faces)


def flattened(found: UsdGeom.Primvar, time: Usd.TimeCode) -> np.ndarray | None:
    """The values behind the indices of a primvar."""
    given = found.ComputeFlattened(time)
    if given is None:
        return None
    rows = np.array(given, dtype=np.float32)
    return rows.reshape(1, -1) if rows.ndim == 1 and not found.GetTypeName().isArray else rows


def texture_name(prim: Usd.Prim) -> str:
    """The primvar that holds the texture coordinates of a mesh, if no material names one."""
    found = UsdGeom.PrimvarsAPI(prim).GetPrimvarsWithValues()
    named = {primvar.GetPrimvarName(): primvar.GetTypeName().type.typeName for primvar in found}
    pairs = [name for name, kind in named.items() if "Vec2f" in kind]
    return "st" if "st" in named or not pairs else pairs[0]


def normals(
    mesh: UsdGeom.PointBased, polygons: Polygons, faces: int, time: Usd.TimeCode
) -> Values | None:
    """The normals that a mesh has: those of the primvar before those of the attribute."""
    prim = mesh.GetPrim()
    found = primvar(prim, "normals", 3, polygons, faces, time)
    if found is not None:
        return found
    rows = np.array(mesh.GetNormalsAttr().Get(time) or [], dtype=np.float32)
    if not len(rows):
        return None
    name = f"{prim.GetPath()}: normals"
    return values(rows, mesh.GetNormalsInterpolation(), polygons, name, faces)
