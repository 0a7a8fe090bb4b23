"""UsdGeomMesh as triangles, one shape for each material."""

from __future__ import annotations

from typing import Any

import numpy as np
from pxr import Usd, UsdGeom

from ..imported import Imported
from ..ply import Mesh
from . import primvars
from .looks import Look, Looks
from .polygons import Polygons, polygons, smooth_normals, triangles, without
from .primvars import Values
from .subdivision import divided

SMOOTH = (UsdGeom.Tokens.catmullClark, UsdGeom.Tokens.loop)


def shapes(prim: Usd.Prim, time: Usd.TimeCode, looks: Looks, made: Imported) -> list[dict]:
    """The shapes of a mesh in its own frame. Raises SceneError where it contradicts itself."""
    mesh = UsdGeom.Mesh(prim)
    authored = polygons(mesh, time)
    faces = len(authored.counts)
    parts = materials(mesh, faces, looks)
    given = without(authored, np.array(mesh.GetHoleIndicesAttr().Get(time) or [], dtype=np.int64))
    uv = next((look.uv for look, _ in parts if look.uv), None) or primvars.texture_name(prim)
    if any(look.uv not in (None, uv) for look, _ in parts):
        made.warn("second texture coordinates are left out; those of the first material are taken")
    found = {
        "normals": primvars.normals(mesh, given, faces, time),
        "uvs": primvars.primvar(prim, uv, 2, given, faces, time),
        "colours": primvars.primvar(prim, "displayColor", 3, given, faces, time),
    }
    if not any(look.of_vertices for look, _ in parts):
        found["colours"] = None
    scheme = mesh.GetSubdivisionSchemeAttr().Get(time)
    if is_divided(mesh, made) and len(given.counts):
        given, found = divided(given, found | {"normals": None}, mesh, time)
    flat = found["normals"] is None and scheme not in SMOOTH
    if found["normals"] is None and not flat:
        found["normals"] = Values(smooth_normals(given), False)
    whole, parents = triangle_mesh(given, found)
    made_shapes = []
    for look, chosen in parts:
        part = whole if chosen is None else subset(whole, np.isin(parents, chosen))
        if len(part.triangles):
            shape = made.mesh(prim.GetName(), part) | look.parts()
            made_shapes.append(shape | ({"face_normals": True} if flat else {}))
    return made_shapes


def is_divided(mesh: UsdGeom.Mesh, made: Imported) -> bool:
    """Whether a mesh is a subdivision surface because its file says so, not by default."""
    scheme = mesh.GetSubdivisionSchemeAttr()
    if not scheme.HasAuthoredValue() or scheme.Get() == UsdGeom.Tokens.none:
        return False
    if scheme.Get() == UsdGeom.Tokens.catmullClark:
        return True
    made.warn(f"the subdivision scheme {scheme.Get()!r} is left out: the mesh stays as it is")
    return False


def materials(mesh: UsdGeom.Mesh, faces: int, looks: Looks) -> list[tuple[Look, np.ndarray | None]]:
    """How a mesh looks, and which of its faces do; None means all of them."""
    subsets = UsdGeom.Subset.GetGeomSubsets(mesh, UsdGeom.Tokens.face, "materialBind")
    if not subsets:
        return [(looks.of(mesh.GetPrim()), None)]
    indices = [np.array(subset.GetIndicesAttr().Get() or [], dtype=np.int64) for subset in subsets]
    parts: list[tuple[Look, np.ndarray | None]] = [
        (looks.of(subset.GetPrim()), chosen)
        for subset, chosen in zip(subsets, indices, strict=True)
    ]
    left = np.setdiff1d(np.arange(faces), np.concatenate(indices))
    return [*parts, (looks.of(mesh.GetPrim()), left)] if len(left) else parts


def triangle_mesh(given: Polygons, found: dict[str, Values | None]) -> tuple[Mesh, np.ndarray]:
    """All triangles, whose corners have vertices of their own where values differ between faces.

    Beside them, the face in the file of each triangle. Texture coordinates are turned over: the
    first row of an image is at v = 1 in USD, and at v = 0 here.
    """
    corners, parents = triangles(given)
    apart = any(value is not None and value.of_corners for value in found.values())
    rows = {
        name: value.rows[given.corners] if apart and not value.of_corners else value.rows
        for name, value in found.items()
        if value is not None
    }
    if "uvs" in rows:
        rows["uvs"] = rows["uvs"] * [1, -1] + [0, 1]
    points = given.points[given.corners] if apart else given.points
    indices = corners if apart else given.corners[corners]
    kept = {name: np.ascontiguousarray(value, np.float32) for name, value in rows.items()}
    return Mesh(points.astype(np.float32), indices, **kept), parents


def subset(mesh: Mesh, chosen: np.ndarray) -> Mesh:
    """Some triangles, with the vertices that they use."""
    used, indices = np.unique(mesh.triangles[chosen], return_inverse=True)
    rest: list[Any] = [None if rows is None else rows[used] for rows in mesh[2:]]
    return Mesh(mesh.positions[used], indices.reshape(-1, 3), *rest)
