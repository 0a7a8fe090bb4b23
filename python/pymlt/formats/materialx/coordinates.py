"""Texture coordinates as functions of those of the surface, where v points up as in MaterialX."""

from __future__ import annotations

import numpy as np

IDENTITY = np.eye(2, 3)  #: from u, v and 1


def fitted(before: np.ndarray, after: np.ndarray) -> np.ndarray | None:
    """The affine map (2, 3) between points (..., 2); None if there is none."""
    points = np.concatenate([before.reshape(-1, 2), np.ones((before.size // 2, 1))], axis=1)
    target = np.broadcast_to(after, before.shape).reshape(-1, 2)
    if not np.isfinite(target).all():
        return None
    solution = np.linalg.lstsq(points, target, rcond=None)[0].round(12)
    worst = np.abs(points @ solution - target).max()
    return solution.T if worst <= 1e-6 * max(1.0, np.abs(target).max()) else None


def square(affine: np.ndarray) -> np.ndarray:
    return np.vstack([affine, [0, 0, 1]])


def is_invertible(affine: np.ndarray) -> bool:
    return bool(abs(np.linalg.det(affine[:, :2])) > 1e-9)


def applied(affine: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """To coordinates (..., 2)."""
    moved: np.ndarray = uv @ affine[:, :2].T + affine[:, 2]
    return moved


def inverse(affine: np.ndarray) -> np.ndarray:
    turned: np.ndarray = np.linalg.inv(square(affine))[:2]
    return turned


def to_uv(affine: np.ndarray) -> np.ndarray:
    """A map where v points down instead, (4, 4), for `to_uv` of a `bitmap`."""
    flip = np.array([[1, 0, 0], [0, -1, 1], [0, 0, 1.0]])
    turned = flip @ square(affine) @ flip
    matrix = np.eye(4)
    matrix[:2, :2] = turned[:2, :2]
    matrix[:2, 3] = turned[:2, 2]
    return matrix
