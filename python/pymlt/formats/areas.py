"""How large the triangles of a mesh are."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np


def triangle_areas(vertices: np.ndarray, faces: np.ndarray, to_world: np.ndarray) -> np.ndarray:
    """In the world, of each triangle, (triangles,); `to_world` is (4, 4)."""
    import numpy as np

    corners = (vertices @ np.asarray(to_world)[:3, :3].T)[faces]
    sides = corners[:, 1:] - corners[:, :1]
    areas: np.ndarray = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
    return areas
