"""Makes the meshes of this folder: python make.py"""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import lathe, write_ply  # noqa: E402

# How deep the flame has melted the wax.
POOL = 1.08

MESHES = {
    # Foot, side, rim, and down into the hollow around the wick.
    "candle": lathe([(0, 0.001), (0.35, 0.001), (0.35, 0.001), (0.372, 0.008), (0.38, 0.03),
                     (0.38, 0.03), (0.385, 0.6), (0.382, 1.13), (0.382, 1.13), (0.379, 1.17),
                     (0.36, 1.195), (0.335, 1.18), (0.3, 1.13), (0.24, 1.095), (0.12, POOL),
                     (0.12, POOL), (0, POOL)], 96, 4),
    "wick": lathe([(0, POOL - 0.02), (0.012, POOL - 0.02), (0.012, POOL - 0.02), (0.012, 1.24),
                   (0.009, 1.26), (0, 1.262)], 12, 2),
    "flame": lathe([(0, 1.27), (0.035, 1.29), (0.055, 1.34), (0.045, 1.42), (0.02, 1.52), (0, 1.6)],
                   24, 4),
}  # fmt: skip

if __name__ == "__main__":
    for name, mesh in MESHES.items():
        write_ply(HERE / f"{name}.ply", mesh)
