"""Light that is even around an axis: maps of all directions, whose first row is that axis.

No plug-in has both a size and light that depends on its direction, so such lamps become many that
have no size. Their places are a lattice: whatever edge they are seen past, they appear singly.
"""

import math

import numpy as np

ROWS = 64  #: of a map, from its axis to the edge of the beam
LEAST = 64  #: lamps without a size that stand for one with a size
GOLDEN = (math.sqrt(5) - 1) / 2

#: Turns the axis of a map, +y, to the lamp's -z, in which it shines; or to +z, where it is seen.
FORWARDS = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
BACKWARDS = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])


def rows(half: float, profile) -> np.ndarray:
    """The brightness in each row of a map, (rows,), for a beam of this half angle.

    `profile` takes angles from the axis; a row has its mean over the angles that are closest.
    """
    count = math.ceil(ROWS * math.pi / half)
    within = (np.arange(8) + 0.5) / 8 - 0.5
    angles = np.arange(count + 1)[:, None] + within
    return profile(np.abs(angles) * math.pi / count).mean(axis=1)


def image(brightness: np.ndarray, colour: np.ndarray) -> np.ndarray:
    """A map, (rows, 2, 3), of a colour times the brightness of each row."""
    return np.tile((brightness[:, None, None] * colour).astype(np.float32), (1, 2, 1))


def upright(axes: np.ndarray) -> np.ndarray:
    """This place with axes at right angles, of which z is that of `axes`."""
    turned = axes.copy()
    z = axes[:3, 2] / np.linalg.norm(axes[:3, 2])
    x = axes[:3, 0] - z * (axes[:3, 0] @ z)
    x /= np.linalg.norm(x)
    turned[:3, :3] = np.stack([x, np.cross(z, x), z], axis=1)
    return turned


def lattice(count: int, *, disk: bool) -> np.ndarray:
    """Places that fill the square [-1, 1]^2 or the disk in it evenly, (count, 2)."""
    u = (np.arange(count) + 0.5) / count
    v = np.arange(count) * GOLDEN % 1
    if not disk:
        return 2 * np.stack([u, v], axis=1) - 1
    return np.sqrt(u)[:, None] * np.stack([np.cos(2 * math.pi * v), np.sin(2 * math.pi * v)], 1)


def lamps(brightness: np.ndarray, colour, axes: np.ndarray, places: np.ndarray) -> list[dict]:
    """Lights without a size at these places (n, 2) across the axis -z; together of one map.

    The lengths of the axes scale the places.
    """
    turned = upright(axes)
    data, made = image(brightness, colour / len(places)), []
    for x, y in places:
        to_world = turned @ FORWARDS
        to_world[:3, 3] = axes[:3] @ [x, y, 0, 1]
        made.append({"type": "goniometric", "data": data, "to_world": to_world})
    return made
