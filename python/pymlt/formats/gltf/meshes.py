"""Primitives of glTF meshes as triangles (glTF 2.0, sec. 3.7.2)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..imported import Imported
from ..ply import Mesh
from .buffers import Buffers

if TYPE_CHECKING:
    import numpy as np

TRIANGLES, STRIP, FAN = 4, 5, 6


def triangle_mesh(primitive: Any, buffers: Buffers, made: Imported) -> Mesh | None:
    """The triangles of a primitive; None for points and lines, with a warning."""
    import numpy as np

    mode = TRIANGLES if primitive.mode is None else primitive.mode
    if mode not in (TRIANGLES, STRIP, FAN):
        made.warn("points and lines are left out")
        return None
    attributes = primitive.attributes
    if attributes.POSITION is None:
        made.warn("a mesh without positions is left out")
        return None
    positions = buffers.array(attributes.POSITION)
    if primitive.indices is None:
        corners = np.arange(len(positions))
    else:
        corners = buffers.array(primitive.indices)[:, 0].astype(np.int64)
    normals, uvs, colours = (
        None if index is None else buffers.array(index)
        for index in (attributes.NORMAL, attributes.TEXCOORD_0, attributes.COLOR_0)
    )
    if colours is not None:
        if (colours[:, 3:] < 1).any():
            made.warn("the alpha of vertices (COLOR_0) is left out")
        colours = colours[:, :3]
    return Mesh(positions, triangles_of(corners, mode), normals, uvs, colours)


def triangles_of(corners: np.ndarray, mode: int) -> np.ndarray:
    """A list, strip or fan of corners as triples."""
    import numpy as np

    if mode == TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    a, b, c = corners[:-2], corners[1:-1], corners[2:]
    if mode == FAN:
        return np.stack([b, c, np.full_like(a, corners[0] if corners.size else 0)], axis=1)
    odd = np.arange(len(a)) % 2 == 1
    return np.stack([a, np.where(odd, c, b), np.where(odd, b, c)], axis=1)
