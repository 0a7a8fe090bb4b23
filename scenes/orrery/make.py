"""Makes the meshes of this folder: python make.py"""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import lathe, write_ply  # noqa: E402

MESHES = {
    # The foot and the column that carries the sun, up to its axis of gears.
    "stand": lathe([(0, 0), (0.62, 0), (0.62, 0), (0.64, 0.03), (0.6, 0.07), (0.6, 0.07),
                    (0.36, 0.12), (0.16, 0.22), (0.1, 0.36), (0.15, 0.44), (0.07, 0.52),
                    (0.06, 0.9), (0.09, 0.96), (0.05, 1.02), (0.045, 1.2), (0, 1.2)], 64, 4),
    # The ring of Saturn.
    "ring": lathe([(0.2, -0.006), (0.33, -0.006), (0.33, -0.006), (0.33, 0.006), (0.33, 0.006),
                   (0.2, 0.006), (0.2, 0.006), (0.2, -0.006)], 64, 1),
}  # fmt: skip

if __name__ == "__main__":
    for name, mesh in MESHES.items():
        write_ply(HERE / f"{name}.ply", mesh)
