"""Makes the mesh of this folder: python make.py"""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import lathe, write_ply  # noqa: E402

# Outer wall up, a rounded rim, and the inner wall down: a plain wedding ring, lying on its side.
RING = lathe([(1.08, 0.02), (1.1, 0.05), (1.1, 0.05), (1.1, 0.55), (1.1, 0.55), (1.085, 0.585),
              (1.05, 0.6), (1.015, 0.585), (1.0, 0.55), (1.0, 0.55), (1.0, 0.05), (1.0, 0.05),
              (1.02, 0.02)], 256, 2)  # fmt: skip

if __name__ == "__main__":
    write_ply(HERE / "ring.ply", RING)
