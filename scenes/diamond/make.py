"""Makes the mesh of this folder: python make.py"""

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))

from modeling import write_ply  # noqa: E402

# A round brilliant of ideal proportions; lengths are shares of its diameter, which is 1.
TABLE, GIRDLE = 0.57, 0.025
CROWN_SLOPE, PAVILION_SLOPE = np.tan(np.radians([34.5, 40.75]))
STAR, LOWER_HALF = 0.5, 0.77  # Shares of the way that these facets take, seen from above.


def point(degrees: float, radius: float, height: float) -> np.ndarray:
    turn = np.radians(degrees)
    return np.array([radius * np.cos(turn), height, radius * np.sin(turn)])


def facets() -> list[list[np.ndarray]]:
    """The 57 facets and the 16 of the girdle, which goes from y = -GIRDLE to y = 0."""
    half = np.cos(np.radians(22.5))

    def crown(degrees, radius, across):  # On the bezel facets; `across` is seen from their middle.
        return point(degrees, radius, (0.5 - radius * across) * CROWN_SLOPE)

    def pavilion(degrees, radius, across):  # On the main facets.
        return point(degrees, radius, -GIRDLE - (0.5 - radius * across) * PAVILION_SLOPE)

    edge = TABLE / 2 * half
    star = edge + STAR * (0.5 - edge)
    culet = pavilion(0, 0, 1)
    found = [[crown(45 * k, TABLE / 2, 1) for k in range(8)]]
    for a in range(0, 360, 45):
        before, after = crown(a - 22.5, star, half), crown(a + 22.5, star, half)
        corner, girdle = crown(a, TABLE / 2, 1), crown(a, 0.5, 1)
        found.append([corner, after, crown(a + 45, TABLE / 2, 1)])
        found.append([corner, before, girdle, after])
        below = pavilion(a, 0.5, 1)
        sides = [pavilion(a + b, (1 - LOWER_HALF) / 2, half) for b in (-22.5, 22.5)]
        found.append([culet, sides[0], below, sides[1]])
        for turn, upper, lower in ((-22.5, before, sides[0]), (22.5, after, sides[1])):
            high, low = point(a + turn, 0.5, 0), point(a + turn, 0.5, -GIRDLE)
            found += [[upper, girdle, high], [lower, below, low], [girdle, high, low, below]]
    return found


def brilliant():
    """The stone as it lies on y = 0, on a main facet of its pavilion, with its table towards +z."""
    positions, triangles = [], []
    for facet in facets():
        corners = np.array(facet)
        if np.cross(corners[1] - corners[0], corners[2] - corners[0]) @ corners.mean(0) < 0:
            corners = corners[::-1]
        first = len(positions)
        positions += list(corners)
        triangles += [(first, first + k, first + k + 1) for k in range(1, len(corners) - 1)]
    x, y, z = np.array(positions).T
    # The facet at +x turns down to y = 0, and then the lower part of the stone to the camera.
    c, s = np.cos(np.arctan(PAVILION_SLOPE)), np.sin(np.arctan(PAVILION_SLOPE))
    x, y = c * x + s * y, c * y - s * x
    return np.stack([-z, y - y.min(), x], 1), None, None, np.array(triangles)


if __name__ == "__main__":
    write_ply(HERE / "brilliant.ply", brilliant())
