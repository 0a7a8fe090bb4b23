"""Makes the meshes of this folder: python make.py"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import height_field, lathe, smooth_normals, waves, write_ply  # noqa: E402


def fluted(mesh, depth=0.03, flutes=16):
    """A column with grooves along its shaft."""
    positions, normals, uvs, triangles = mesh
    x, y, z = positions.T
    angle = np.arctan2(z, x)
    shaft = np.clip((y - 0.3) / 0.05, 0, 1) * np.clip((3.45 - y) / 0.05, 0, 1)
    groove = depth * shaft * np.abs(np.sin(flutes / 2 * angle))
    radius = np.hypot(x, z)
    scale = np.where(radius > 0, 1 - groove / np.maximum(radius, 1e-9), 1)
    moved = np.stack([x * scale, y, z * scale], 1)
    smooth = smooth_normals(moved, triangles)
    return moved, np.where(shaft[:, None] > 0, smooth, normals), uvs, triangles


# Waves on the lake: direction (degrees), length (m), height (m), phase.
WAVES = [
    (85, 2.3, 0.006, 0.3),
    (60, 1.4, 0.004, 1.9),
    (110, 0.9, 0.0025, 4.0),
    (35, 0.7, 0.0015, 2.2),
]

height, slope = waves(WAVES)


MESHES = {
    "column": fluted(lathe([(0, 0), (0.46, 0), (0.46, 0), (0.46, 0.1), (0.46, 0.1), (0.43, 0.2),
                            (0.37, 0.28), (0.34, 0.3), (0.34, 0.3), (0.34, 1.3), (0.325, 2.2),
                            (0.3, 3.45), (0.3, 3.45), (0.33, 3.5), (0.42, 3.62), (0.42, 3.62),
                            (0.46, 3.64), (0.46, 3.76), (0.46, 3.76), (0, 3.76)],
                           96, 4)),
    "steps": lathe([(0, 0), (4.9, 0), (4.9, 0), (4.9, 0.22), (4.9, 0.22), (4.5, 0.22),
                    (4.5, 0.22), (4.5, 0.44), (4.5, 0.44), (4.1, 0.44), (4.1, 0.44), (4.1, 0.66),
                    (4.1, 0.66), (0, 0.66)], 128, 1),
    "roof": lathe([(2.75, 4.42), (3.8, 4.42), (3.8, 4.42), (3.8, 4.75), (3.8, 4.75),
                   (3.9, 4.78), (3.9, 4.95), (3.9, 4.95), (4.1, 5.05), (4.1, 5.2), (4.1, 5.2),
                   (3.7, 5.45), (3.0, 6.1), (2.0, 6.75), (0.9, 7.12), (0.25, 7.2), (0.2, 7.3),
                   (0.24, 7.45), (0.12, 7.6), (0, 7.65)], 128, 4),
    "ceiling": lathe([(0, 4.9), (2.75, 4.9), (2.75, 4.9), (2.75, 4.42)], 128, 1),
    "lake": height_field(height, slope, 22, 9, 90, 220),
}  # fmt: skip

if __name__ == "__main__":
    for name, mesh in MESHES.items():
        write_ply(HERE / f"{name}.ply", mesh)
