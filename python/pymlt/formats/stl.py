"""STL files: triangles without anything else, binary or as text."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .. import _core
from .limits import TEXT, read_file
from .ply import Mesh

HEADER = 84  #: bytes before the triangles; the last four are their number
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read_stl(path: Path) -> Mesh:
    """Each triangle has corners of its own. Raises FileError, and SceneError for what is no STL."""
    content = read_file(path)
    count = int.from_bytes(content[80:HEADER], "little")
    if len(content) == HEADER + TRIANGLE.itemsize * count:
        corners = np.frombuffer(content, TRIANGLE, count, HEADER)["corners"].reshape(-1, 3)
    elif content[:200].lstrip().startswith(b"solid") and len(content) <= TEXT:
        corners = _corners_of_text(content, path)
    else:
        raise _core.SceneError(
            f"{path}: is no STL: it neither begins with 'solid' nor has the {len(content)} bytes "
            f"that {count} triangles take"
        )
    if not len(corners):
        raise _core.SceneError(f"{path}: has no triangles")
    return Mesh(corners, np.arange(len(corners), dtype=np.uint32).reshape(-1, 3))


def _corners_of_text(content: bytes, path: Path) -> np.ndarray:
    words = content.split()
    rows = [words[i + 1 : i + 4] for i, word in enumerate(words) if word == b"vertex"]
    try:
        return np.array(rows, np.float32).reshape(-1, 3, 3).reshape(-1, 3)
    except ValueError:
        raise _core.SceneError(
            f"{path}: should have three vertices of three numbers in each triangle"
        ) from None
