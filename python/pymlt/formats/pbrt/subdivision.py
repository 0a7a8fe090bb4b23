"""Subdivision surfaces of pbrt-v4 (loopsubdiv), by trimesh."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..._extras import import_extra
from ..ply import Mesh
from .params import Params

CORNERS = 2**24  #: of the triangles that one surface is divided into


def loop_subdivision(params: Params, folder: Path) -> dict[str, Any]:
    """A mesh divided by Loop's scheme; corners are not moved to the limit surface.

    Raises SceneError for meshes that are no surface or grow too large, UsageError without the
    extra `pbrt`.
    """
    positions, indices = params.array("P", 3), params.array("indices", 3)
    if positions is None or indices is None:
        raise params.where.error("a loopsubdiv needs 'P' and 'indices'")
    levels, faces = int(params.number("levels", params.number("nlevels", 3))), indices.astype(int)
    params.made.mesh(params.type, Mesh(positions, faces))  # its indices are checked
    if not 0 <= levels <= 12 or 3 * len(faces) * 4**levels > CORNERS:
        raise params.where.error(
            f"'levels' is {levels}, but should be at least 0, and at most so large that the "
            f"triangles have {CORNERS} corners"
        )
    trimesh = import_extra("trimesh", "pbrt", "a subdivision surface of pbrt")
    for _ in range(levels):
        positions, faces = trimesh.remesh.subdivide_loop(positions, faces)
    smooth = trimesh.Trimesh(positions, faces, process=False).vertex_normals
    made = params.made.mesh(params.type, Mesh(positions, faces, smooth))
    return made | {"has_normals": True}
