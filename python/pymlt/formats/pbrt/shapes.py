"""Shapes of pbrt-v4 (Pharr, Jakob & Humphreys 2023, ch. 6)."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..frames import is_similarity
from ..limits import read_file
from ..ply import Mesh
from .params import Params
from .subdivision import loop_subdivision

if TYPE_CHECKING:
    import numpy as np


def shape(
    params: Params, folder: Path, to_world: np.ndarray, reversed: bool
) -> dict[str, Any] | None:
    """A shape without its material; None, with a warning, for those without a counterpart.

    `reversed` is pbrt's ReverseOrientation. The outside of a mesh without normals is where its
    corners run counter-clockwise in object space, also if the transform mirrors it.
    """
    import numpy as np

    make = SHAPES.get(params.type)
    if make is None:
        params.warn(f"the shape {params.type!r} has no counterpart")
        return None
    made = make(params, folder)
    if params.type == "sphere" and not is_similarity(to_world):
        made = ellipsoid(params, made["radius"])
    placed = to_world @ made.pop("local", np.eye(4))
    mirrored = np.linalg.det(placed[:3, :3]) < 0
    has_normals = made.pop("has_normals", False)
    if reversed != bool(mirrored and not has_normals):
        made["flip_normals"] = True
    return made | {"to_world": placed}


def triangle_mesh(params: Params, folder: Path) -> dict[str, Any]:
    positions = _needed(params, "P", 3)
    indices = params.array("indices", 3)
    triangles = np_arange(3) if indices is None else indices.astype(int)
    return _mesh(params, positions, triangles)


def bilinear_mesh(params: Params, folder: Path) -> dict[str, Any]:
    """Each patch as two triangles."""
    import numpy as np

    positions = _needed(params, "P", 3)
    indices = params.array("indices", 4)
    quads = np.arange(4).reshape(1, 4) if indices is None else indices.astype(int)
    a, b, c, d = quads.T  # at (0, 0), (1, 0), (0, 1), (1, 1)
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([b, d, c], 1)])
    params.warn("patches (bilinearmesh) become two triangles each")
    return _mesh(params, positions, triangles)


def ply_mesh(params: Params, folder: Path) -> dict[str, Any]:
    path = folder / params.text("filename")
    if path.suffix == ".gz":
        return {"type": "ply", "data": read_file(path)}
    return {"type": "ply", "filename": str(path.resolve())}


def sphere(params: Params, folder: Path) -> dict[str, Any]:
    """Upside down, for v is 0 at its lower pole in pbrt, and at the upper one here."""
    import numpy as np

    radius = params.number("radius", 1)
    low, high = params.number("zmin", -radius), params.number("zmax", radius)
    if low > -radius or high < radius or params.number("phimax", 360) < 360:
        params.warn("parts of spheres are left out: they become whole")
    return {"type": "sphere", "radius": radius, "local": np.diag([1.0, 1, -1, 1])}


def ellipsoid(params: Params, radius: float) -> dict[str, Any]:
    """A sphere of triangles, for transforms that stretch it."""
    import numpy as np

    rows, columns = 48, 96
    theta, phi = np.meshgrid(
        np.linspace(0, np.pi, rows + 1), np.linspace(0, 2 * np.pi, columns + 1), indexing="ij"
    )
    ring = np.sin(theta)
    normals = np.stack([ring * np.cos(phi), ring * np.sin(phi), np.cos(theta)], 2).reshape(-1, 3)
    uvs = np.stack([phi / (2 * np.pi), 1 - theta / np.pi], 2).reshape(-1, 2)
    a = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    b, c, d = a + columns + 1, a + columns + 2, a + 1
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    params.warn("ellipsoids become meshes")
    mesh = params.made.mesh("ellipsoid", Mesh(radius * normals, triangles, normals, uvs))
    return mesh | {"has_normals": True}


def disk(params: Params, folder: Path) -> dict[str, Any]:
    import numpy as np

    if params.number("innerradius", 0) > 0 or params.number("phimax", 360) < 360:
        params.warn("parts of disks are left out: they become whole")
    radius, height = params.number("radius", 1), params.number("height", 0)
    local = np.diag([radius, radius, 1.0, 1.0])
    local[2, 3] = height
    return {"type": "disk", "local": local}


def cylinder(params: Params, folder: Path) -> dict[str, Any]:
    if params.number("phimax", 360) < 360:
        params.warn("parts of cylinders are left out: they become whole")
    ends = [params.number("zmin", -1), params.number("zmax", 1)]
    points = {f"p{i}": [0.0, 0.0, z] for i, z in enumerate(ends)}
    return {"type": "cylinder", "radius": params.number("radius", 1)} | points


def _needed(params: Params, name: str, width: int) -> np.ndarray:
    found = params.array(name, width)
    if found is None:
        raise params.where.error(f"a {params.type} needs {name!r}")
    return found


def _mesh(params: Params, positions: np.ndarray, triangles: np.ndarray) -> dict[str, Any]:
    normals = params.array("N", 3)
    uvs = params.array("uv", 2)
    uvs = params.array("st", 2) if uvs is None else uvs
    for name, values in (("N", normals), ("uv", uvs)):
        if values is not None and len(values) != len(positions):
            raise params.where.error(f"{len(positions)} 'P', but {len(values)} {name!r}")
    made = params.made.mesh(params.type, Mesh(positions, triangles, normals, uvs))
    return made | {"has_normals": normals is not None}


def np_arange(count: int) -> np.ndarray:
    import numpy as np

    return np.arange(count).reshape(1, count)


SHAPES: dict[str, Callable[[Params, Path], dict[str, Any]]]
SHAPES = {
    "bilinearmesh": bilinear_mesh,
    "cylinder": cylinder,
    "disk": disk,
    "loopsubdiv": loop_subdivision,
    "plymesh": ply_mesh,
    "sphere": sphere,
    "trianglemesh": triangle_mesh,
}
