"""Makes the mesh of this folder: python make.py"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import write_ply  # noqa: E402

# Light along +x meets the middle of a face, at the origin, at this angle to its normal: that of
# least deviation at 550 nm, where the index of SF11 is 1.791. It leaves at the same angle.
INCIDENCE = np.degrees(np.arcsin(1.7912 * np.sin(np.radians(30))))
SIDE, HEIGHT = 1, 1.4


def prism():
    """An equilateral prism that stands on y = 0; each face has vertices of its own."""
    away = np.radians(180 - INCIDENCE + np.array([0, 120, 240]))
    normals = np.stack([np.cos(away), np.sin(away)], 1)
    centre = -SIDE / np.sqrt(12) * normals[0]
    x, z = (centre - SIDE / np.sqrt(3) * normals).T
    low, high = np.stack([x, 0 * x, z], 1), np.stack([x, 0 * x + HEIGHT, z], 1)
    faces = [low[[0, 1, 2]], high[[2, 1, 0]]]
    for i in range(3):
        j = (i + 1) % 3
        faces.append(np.stack([low[i], high[i], high[j], low[j]]))
    positions, triangles = [], []
    middle = np.array([centre[0], HEIGHT / 2, centre[1]])
    for face in faces:
        if np.cross(face[1] - face[0], face[2] - face[0]) @ (face[0] - middle) < 0:
            face = face[::-1]
        first = len(positions)
        positions += list(face)
        triangles += [(first, first + k, first + k + 1) for k in range(1, len(face) - 1)]
    return np.array(positions), None, None, np.array(triangles)


if __name__ == "__main__":
    write_ply(HERE / "prism.ply", prism())
