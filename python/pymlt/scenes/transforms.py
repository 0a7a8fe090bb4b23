"""Affine transforms for `to_world`, chained like matrices: the right-most one acts first."""

from __future__ import annotations

import math
from collections.abc import Callable


def _vector(values) -> list[float]:
    """Three numbers, given as one sequence, three arguments, or one number for all axes."""
    if len(values) == 1:
        values = values[0] if hasattr(values[0], "__len__") else [values[0]] * 3
    if len(values) != 3:
        raise ValueError(f"expected 3 numbers, not {len(values)}")
    return [float(v) for v in values]


def _translate(*offset):
    """Moves by a vector."""
    x, y, z = _vector(offset)
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def _scale(*factors):
    """Scales by one factor, or by one for each axis."""
    x, y, z = _vector(factors)
    return [[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]]


def _rotate(axis, angle):
    """Rotates about an axis through the origin by an angle in degrees (Rodrigues 1840)."""
    x, y, z = _vector([axis])
    length = math.sqrt(x * x + y * y + z * z)
    if length == 0:
        raise ValueError("the axis of a rotation has no length")
    x, y, z = x / length, y / length, z / length
    s, c = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    t = 1 - c
    return [
        [t * x * x + c, t * x * y - s * z, t * x * z + s * y, 0],
        [t * x * y + s * z, t * y * y + c, t * y * z - s * x, 0],
        [t * x * z - s * y, t * y * z + s * x, t * z * z + c, 0],
        [0, 0, 0, 1],
    ]


def _look_at(origin, target, up):
    """Puts the origin at `origin`, with z towards `target` and y as near to `up` as can be."""
    import numpy as np

    origin, target, up = (np.array(_vector([v])) for v in (origin, target, up))
    forward = target - origin
    if not np.any(forward):
        raise ValueError("look_at: 'origin' and 'target' must not be the same point")
    left = np.cross(up, forward)
    if not np.any(left):
        raise ValueError("look_at: 'up' must not be parallel to the direction of view")
    forward /= np.linalg.norm(forward)
    left /= np.linalg.norm(left)
    matrix = np.eye(4)
    matrix[:3] = np.stack([left, np.cross(forward, left), forward, origin], axis=1)
    return matrix


class _Chained:
    """A function of a matrix that can be called on the class and on an object, where it follows
    what is already there: `Transform.scale(2)`, `Transform().translate(0, 1, 0).scale(2)`."""

    def __init__(self, function):
        self.function = function
        self.__doc__ = function.__doc__

    def __get__(self, instance, owner) -> Callable[..., Transform]:
        def call(*args, **kwargs):
            made = owner(self.function(*args, **kwargs))
            return made if instance is None else instance @ made

        call.__doc__ = self.__doc__
        return call


class Transform:
    """A 4 x 4 matrix in float64, row by row as scenes write it (`matrix`).

    `Transform.translate(0, 1, 0) @ Transform.rotate([0, 1, 0], 90)` rotates, then translates;
    `Transform().translate(0, 1, 0).rotate([0, 1, 0], 90)` is the same.
    """

    def __init__(self, matrix=None):
        import numpy as np

        self.matrix = np.eye(4) if matrix is None else np.array(matrix, dtype=float)
        if self.matrix.shape != (4, 4):
            raise ValueError(f"a transform is a 4 x 4 matrix, not {self.matrix.shape}")

    translate = _Chained(_translate)
    scale = _Chained(_scale)
    rotate = _Chained(_rotate)
    look_at = _Chained(_look_at)

    def inverse(self) -> Transform:
        import numpy as np

        return Transform(np.linalg.inv(self.matrix))

    def __matmul__(self, other) -> Transform:
        return Transform(self.matrix @ Transform(getattr(other, "matrix", other)).matrix)

    def __array__(self, dtype=None, copy=None):
        import numpy as np

        return np.array(self.matrix, dtype=dtype)

    def __eq__(self, other) -> bool:
        return isinstance(other, Transform) and bool((self.matrix == other.matrix).all())

    __hash__ = None

    def __repr__(self) -> str:
        return f"Transform({self.matrix.tolist()})"
