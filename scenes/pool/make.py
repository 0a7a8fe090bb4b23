"""Makes the mesh of this folder: python make.py"""

import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import height_field, waves, write_ply  # noqa: E402

# Waves: direction (degrees), length (m), height (m), phase.
WAVES = [(20, 1.7, 0.018, 0.3), (75, 1.15, 0.013, 1.9), (-40, 0.83, 0.009, 4.0),
         (130, 0.62, 0.006, 2.2), (5, 0.47, 0.004, 5.1), (-75, 0.55, 0.004, 0.9)]  # fmt: skip

height, slope = waves(WAVES)


if __name__ == "__main__":
    write_ply(HERE / "water.ply", height_field(height, slope, 3, 2, 65, 97))
