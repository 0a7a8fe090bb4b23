"""What a transform does besides moving, and the frames of cameras and lights."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np


def is_similarity(matrix: np.ndarray) -> bool:
    """Whether it moves, turns, mirrors and scales evenly only."""
    import numpy as np

    products = matrix[:3, :3].T @ matrix[:3, :3]
    scale = np.trace(products) / 3
    return bool(np.allclose(products, scale * np.eye(3), atol=1e-6 * scale))


def looking(to_world: np.ndarray) -> np.ndarray:
    """Where something that looks along its -z is, as a frame without scale that looks along +z."""
    import numpy as np

    placed = np.eye(4)
    forward, up = -to_world[:3, 2], to_world[:3, 1]
    placed[:3, 2] = forward / np.linalg.norm(forward)
    left = np.cross(up, placed[:3, 2])
    placed[:3, 0] = left / np.linalg.norm(left)
    placed[:3, 1] = np.cross(placed[:3, 2], placed[:3, 0])
    placed[:3, 3] = to_world[:3, 3]
    return placed
