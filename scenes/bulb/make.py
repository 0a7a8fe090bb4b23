"""Makes the meshes of this folder: python make.py"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import grid_triangles, lathe, smooth_normals, write_ply  # noqa: E402

# The glass, 0.02 thick: a bulb that narrows to its neck, seen from outside, then from inside,
# where the normals point into the bulb.
OUTSIDE = [(0.14, 0), (0.15, 0.12), (0.24, 0.32), (0.39, 0.55), (0.45, 0.8), (0.39, 1.05),
           (0.22, 1.2), (0, 1.25)]  # fmt: skip
INSIDE = [(0, 1.23), (0.21, 1.183), (0.375, 1.04), (0.43, 0.8), (0.372, 0.557), (0.222, 0.33),
          (0.13, 0.125), (0.12, 0)]  # fmt: skip


def ribbed(mesh, depth=0.004, ribs=14):
    """The outside with ribs that wind about it: they gather the light into lines."""
    positions, normals, uvs, triangles = mesh
    angle = np.arctan2(positions[:, 2], positions[:, 0]) + 0.5 * positions[:, 1]
    size = np.clip(positions[:, 1] / 0.4, 0, 1) * np.clip((1.25 - positions[:, 1]) / 0.3, 0, 1)
    moved = positions + normals * (depth * size * np.cos(ribs * angle))[:, None]
    return moved, smooth_normals(moved, triangles), uvs, triangles


def filament(turns=24, radius=0.014, wire=0.004, low=0.52, high=1.0):
    """A coil about the axis of the bulb: a thin tube along a helix."""
    t = np.linspace(0, 1, 16 * turns + 1)[:, None]
    phase = 2 * np.pi * turns * t
    out = np.concatenate([np.cos(phase), 0 * t, np.sin(phase)], axis=1)
    centre = radius * out + (low + (high - low) * t) * np.array([0, 1, 0])
    tangent = np.gradient(centre, axis=0)
    side = np.cross(out, tangent / np.linalg.norm(tangent, axis=1, keepdims=True))
    a = np.linspace(0, 2 * np.pi, 6, endpoint=False)[None, :, None]
    normals = (np.cos(a) * out[:, None] + np.sin(a) * side[:, None]).reshape(-1, 3)
    positions = np.repeat(centre, 6, axis=0) + wire * normals
    return positions, normals, None, grid_triangles(len(centre), 6, wrap=True)


MESHES = {
    "outside": ribbed(lathe(OUTSIDE, 196, 7)),
    "inside": lathe(INSIDE, 96, 6),
    "socket": lathe([(0, -0.42), (0.07, -0.42), (0.12, -0.36), (0.12, -0.36), (0.14, -0.3),
                     (0.125, -0.25), (0.14, -0.2), (0.125, -0.15), (0.14, -0.1), (0.125, -0.05),
                     (0.16, 0), (0.16, 0.03), (0.1, 0.035), (0, 0.035)], 64, 4),
    "filament": filament(),
}  # fmt: skip

if __name__ == "__main__":
    for name, mesh in MESHES.items():
        write_ply(HERE / f"{name}.ply", mesh)
