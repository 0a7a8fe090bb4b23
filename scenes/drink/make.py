"""Makes the meshes of this folder: python make.py"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import lathe, smooth_normals, write_ply  # noqa: E402


def rounded_cube(half: float, n: int = 24):
    """The superellipsoid |x|^6 + |y|^6 + |z|^6 = half^6, from a cube's faces."""
    t = np.tan(np.linspace(-np.pi / 4, np.pi / 4, n))
    u, v = (q.ravel() for q in np.meshgrid(t, t, indexing="ij"))
    positions, triangles = [], []
    i, j = (q.ravel() for q in np.mgrid[0 : n - 1, 0 : n - 1])
    quad = [i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1, i * n + j + 1]
    for axis in range(3):
        for side in (-1, 1):
            first = len(positions) * n * n
            face = np.empty((n * n, 3))
            face[:, axis] = side
            face[:, (axis + 1) % 3], face[:, (axis + 2) % 3] = u, v
            positions.append(half * face / (np.abs(face) ** 6).sum(1, keepdims=True) ** (1 / 6))
            order = (0, 1, 2, 3) if side > 0 else (0, 3, 2, 1)
            for k in ((0, 1, 2), (0, 2, 3)):
                triangles.append(first + np.stack([quad[order[c]] for c in k], 1))
    positions, where = np.unique(np.concatenate(positions).round(9), axis=0, return_inverse=True)
    triangles = where.reshape(-1)[np.concatenate(triangles)]
    return positions, smooth_normals(positions, triangles), None, triangles


MESHES = {
    # Up the outside, over the rim, down the inside to the floor of the glass.
    "glass": lathe([(0, 0), (0.28, 0), (0.28, 0), (0.3, 0.02), (0.31, 0.1), (0.35, 0.94),
                    (0.351, 0.985), (0.343, 1.0), (0.334, 0.985), (0.331, 0.94), (0.29, 0.12),
                    (0.27, 0.08), (0.27, 0.08), (0, 0.08)], 96, 4),
    # In the midst of the glass's wall, and over its rim as surface tension lets it.
    "water": lathe([(0, 0.04), (0.28, 0.04), (0.28, 0.04), (0.3, 0.1), (0.34, 0.94),
                    (0.343, 0.985), (0.343, 0.985), (0.338, 1.0), (0.325, 1.012), (0.25, 1.024),
                    (0.1, 1.03), (0, 1.03)], 96, 4),
    "ice": rounded_cube(0.11),
}  # fmt: skip

if __name__ == "__main__":
    for name, mesh in MESHES.items():
        write_ply(HERE / f"{name}.ply", mesh)
