"""Makes the mesh of this folder: python make.py"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import grid_triangles, write_ply  # noqa: E402

HOLE, WIDTH, HEIGHT = 0.1, 5, 4  # The radius of the hole, and half of the screen.
SEGMENTS = 128


def screen():
    """A rectangle with a round hole, in the plane z = 0; it faces +z."""
    angle = 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    corner = np.arctan2(HEIGHT, WIDTH)
    for at in (corner, np.pi - corner, np.pi + corner, 2 * np.pi - corner):
        angle[np.abs(angle - at).argmin()] = at
    around = np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    reach = np.minimum(WIDTH / np.maximum(np.abs(around[:, 0]), 1e-9),
                       HEIGHT / np.maximum(np.abs(around[:, 1]), 1e-9))  # fmt: skip
    positions = np.concatenate([HOLE * around, reach[:, None] * around])
    triangles = grid_triangles(2, SEGMENTS, wrap=True)
    corners = positions[triangles[0]]
    if np.cross(corners[1] - corners[0], corners[2] - corners[0])[2] < 0:
        triangles = triangles[:, ::-1]
    return positions, None, None, triangles


if __name__ == "__main__":
    write_ply(HERE / "screen.ply", screen())
