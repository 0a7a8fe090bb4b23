"""Targets that run without Python, so that a million steps take a fraction of a second.

Each can be called, with one state or with an array of states, as any other target can.
"""

from __future__ import annotations

from functools import cached_property

from ... import _core

_lab = _core.lab
PathTarget = _lab.PathTarget


class Target:
    """The base of the built-in targets."""

    dimensions = 1

    @cached_property
    def _native(self):
        return self._make()

    def __call__(self, x):
        import numpy as np

        points = np.asarray(x, dtype=float)
        axes = 0 if self.dimensions == 1 else 1
        if axes and points.shape[-1:] != (self.dimensions,):
            raise _core.UsageError(f"{self!r} needs states of {self.dimensions} numbers")
        values = self._native.values(points.reshape(-1, self.dimensions))
        values = values.reshape(points.shape[: points.ndim - axes])
        return values if values.ndim else float(values)

    def __getstate__(self):
        return {name: value for name, value in vars(self).items() if name != "_native"}


class Parabola(Target):
    """The lecture's example f(x) = (x - 1/2)^2 on [0, 1], and 0 outside; its integral is 1/12."""

    integral = 1 / 12

    def _make(self):
        return _lab.parabola()

    def __repr__(self) -> str:
        return "Parabola()"


class Table(Target):
    """f(i) = values[i] on the states 0 ... n - 1."""

    def __init__(self, values):
        self.values = values

    @property
    def integral(self) -> float:
        """The sum of all values."""
        return float(_values(self.values, 1).sum())

    def _make(self):
        return _lab.table(_values(self.values, 1))

    def __repr__(self) -> str:
        return f"Table({self.values!r})"


class Image(Target):
    """A grey image as a function of (x, y) in pixels, piecewise constant, row 0 on top."""

    dimensions = 2

    def __init__(self, pixels):
        self.pixels = pixels

    @property
    def integral(self) -> float:
        """The sum of all pixels, each of area 1."""
        return float(_values(self.pixels, 2).sum())

    def _make(self):
        return _lab.image(_values(self.pixels, 2))

    def __repr__(self) -> str:
        height, width = _values(self.pixels, 2).shape
        return f"Image(<{width} x {height} pixels>)"


class Normals(Target):
    """A weighted sum of normal densities; its integral is the sum of the weights.

    means: one number or point for each; deviations, weights: one number for each (weights: equal).
    """

    def __init__(self, means, deviations, weights=None):
        self.means, self.deviations, self.weights = means, deviations, weights
        import numpy as np

        array = np.asarray(means, dtype=float)
        self.dimensions = 1 if array.ndim == 1 else array.shape[-1]

    integral = property(lambda self: float(self._weights.sum()))

    @property
    def _weights(self):
        import numpy as np

        count = len(self.means)
        weights = np.full(count, 1 / count) if self.weights is None else self.weights
        return _values(weights, 1)

    def _make(self):
        import numpy as np

        means = np.asarray(self.means, dtype=float).reshape(len(self.means), self.dimensions)
        deviations = _values(self.deviations, 1)
        if not (len(means) == len(deviations) == len(self._weights) and (deviations > 0).all()):
            raise _core.UsageError(
                f"{self!r} needs a mean, a positive deviation and a weight for each normal density"
            )
        return _lab.normals(means, deviations, self._weights)

    def __repr__(self) -> str:
        return f"Normals({self.means!r}, {self.deviations!r}, {self.weights!r})"


def _values(given, axes: int):
    import numpy as np

    array = np.asarray(given, dtype=float)
    if array.ndim != axes or array.size == 0:
        raise _core.UsageError(f"expected an array with {axes} axes, not of shape {array.shape}")
    if not (np.isfinite(array).all() and (array >= 0).all()):
        raise _core.UsageError("the values of a target must be finite and not negative")
    return array
