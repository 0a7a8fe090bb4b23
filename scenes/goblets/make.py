"""Makes the meshes of this folder: python make.py"""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import lathe, write_ply  # noqa: E402

MESHES = {
    # A full goblet, glass and wine as one: foot, stem, the bowl up, over the rim, down to the wine.
    "goblet": lathe([(0, 0), (0.34, 0), (0.34, 0), (0.345, 0.015), (0.33, 0.03), (0.12, 0.075),
                     (0.055, 0.16), (0.045, 0.4), (0.06, 0.56), (0.17, 0.64), (0.33, 0.8),
                     (0.4, 1.02), (0.385, 1.24), (0.34, 1.44), (0.333, 1.45), (0.326, 1.44),
                     (0.368, 1.24), (0.3665, 1.22), (0.3665, 1.22), (0, 1.22)], 96, 4),
    # A tumbler, filled in the same way.
    "tumbler": lathe([(0, 0), (0.27, 0), (0.27, 0), (0.295, 0.02), (0.31, 0.1), (0.34, 0.6),
                      (0.333, 0.61), (0.326, 0.6), (0.32, 0.47), (0.32, 0.47), (0, 0.47)], 96, 4),
}  # fmt: skip

if __name__ == "__main__":
    for name, mesh in MESHES.items():
        write_ply(HERE / f"{name}.ply", mesh)
