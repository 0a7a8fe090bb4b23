"""Makes the meshes of this folder: python make.py"""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import lathe, write_ply  # noqa: E402

# Where the surface of the milk meets the glass: radius and height.
EDGE = (0.315, 0.66)

MESHES = {
    # Glass next to air: foot, wall, over the rim, and down inside to the milk.
    "glass": lathe([(0, 0), (0.27, 0), (0.27, 0), (0.295, 0.02), (0.31, 0.1), (0.345, 0.86),
                    (0.337, 0.87), (0.329, 0.86), EDGE], 96, 4),
    # Glass next to milk: the floor and the wall, up to the surface.
    "wet": lathe([(0, 0.07), (0.24, 0.07), (0.24, 0.07), (0.272, 0.085), (0.287, 0.14), EDGE],
                 96, 4),
    "surface": lathe([EDGE, (0, EDGE[1])], 96, 4),
}  # fmt: skip

if __name__ == "__main__":
    for name, mesh in MESHES.items():
        write_ply(HERE / f"{name}.ply", mesh)
