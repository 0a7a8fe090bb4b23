"""Meshes as PLY files: binary, little-endian, with the names of properties that `ply` reads."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from .. import _core
from .._extras import import_extra
from . import limits

if TYPE_CHECKING:
    import numpy as np


class Mesh(NamedTuple):
    """Triangles."""

    positions: np.ndarray  #: (vertices, 3)
    triangles: np.ndarray  #: indices of vertices, (triangles, 3)
    normals: np.ndarray | None = None  #: (vertices, 3)
    uvs: np.ndarray | None = None  #: (vertices, 2)
    colours: np.ndarray | None = None  #: (vertices, 3)


def read_ply(shape: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """The corners, (vertices, 3), and triangles, (triangles, 3), of a shape of type `ply`.

    Raises FileError if its file cannot be read, UsageError without the extra `pbrt`.
    """
    import io

    trimesh = import_extra("trimesh", "pbrt", "a mesh of pbrt")
    content = shape.get("data") or _core.read_file(shape["filename"], limits.MEMORY)
    mesh = trimesh.load_mesh(io.BytesIO(content), file_type="ply", process=False)
    return mesh.vertices, mesh.faces


def write_ply(path: Path, mesh: Mesh) -> None:
    """Raises FileError if the file cannot be written."""
    import numpy as np

    columns = {
        "xyz": mesh.positions,
        ("nx", "ny", "nz"): mesh.normals,
        "uv": mesh.uvs,
        "rgb": mesh.colours,
    }
    present = {names: values for names, values in columns.items() if values is not None}
    count = len(mesh.positions)
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {count}"]
    header += [f"property float {name}" for names in present for name in names]
    header += [f"element face {len(mesh.triangles)}"]
    header += ["property list uchar int vertex_indices", "end_header", ""]
    faces = np.empty(len(mesh.triangles), np.dtype([("n", "u1"), ("v", "<i4", 3)]))
    faces["n"], faces["v"] = 3, mesh.triangles
    vertices = np.concatenate([np.asarray(v, "<f4") for v in present.values()], axis=1)
    try:
        path.write_bytes("\n".join(header).encode() + vertices.tobytes() + faces.tobytes())
    except OSError as error:
        raise _core.FileError(f"{path}: cannot write it: {error.strerror}") from None
