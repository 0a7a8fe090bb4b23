"""Moves: how a chain proposes where to go next.

`RandomWalk`, `AdaptiveWalk`, `Uniform` and `Discrete` run without Python. Any other move is a
subclass of `Move`, or made of functions by `Symmetric` and `Independent`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from ... import _core

_lab = _core.lab


class Move:
    """A move that is written in Python: subclass it.

    propose(x, rng)
        returns y, drawn from q(x -> y), or None for no proposal. `rng` is a
        `numpy.random.Generator` on the random stream of the chain; draw from nothing else, and the
        run depends on its seed alone.
    density(x, y)
        returns q(x -> y). Only quotients of densities matter, so a constant factor may be left out.
        Not needed if `symmetric = True` says that q(x -> y) = q(y -> x).
    suitability(x)
        may return a factor of the move's weight, 0 where it cannot act. It becomes a part of q.
    adapt(acceptance)
        may learn from how the last proposal fared. Each chain learns in a copy of its own. Let the
        changes die out, or the chain forgets its target. If there is a number `size`, it is traced.
    """

    symmetric = False

    def propose(self, x, rng):
        raise NotImplementedError(f"{type(self).__name__} needs a method propose(x, rng)")

    def density(self, x, y) -> float:
        raise NotImplementedError(
            f"{type(self).__name__} needs a method density(x, y), or symmetric = True"
        )

    def suitability(self, x) -> float:
        return 1.0

    def adapt(self, acceptance: float) -> None:
        pass

    @property
    def _suits_all(self) -> bool:
        return type(self).suitability is Move.suitability

    @property
    def _adapts(self) -> bool:
        return type(self).adapt is not Move.adapt


@dataclass
class Symmetric(Move):
    """A function `propose(x, rng)` whose q(x -> y) = q(y -> x)."""

    propose: Callable[[Any, Any], Any]
    symmetric = True


class Independent(Move):
    """Proposals that do not depend on x: `sample(rng)` returns y, and `density(y)` is its density.

    In a vectorized run they are `sample(rng, count)` and `density(y)` of an array.
    """

    def __init__(self, sample: Callable, density: Callable[[Any], float]):
        self.sample, self.pdf = sample, density

    def propose(self, x, rng):
        return self.sample(rng)

    def density(self, x, y) -> float:
        return self.pdf(y)

    def __repr__(self) -> str:
        return f"Independent({self.sample!r}, {self.pdf!r})"


@dataclass(frozen=True)
class RandomWalk:
    """y = x + size (u - 1/2) with u uniform in [0, 1), or x + size N(0, 1). Symmetric.

    size: the full width of the step, or its standard deviation; one number, or one per coordinate.
    shape: "uniform" or "normal".
    """

    size: float | Sequence[float]
    shape: str = "uniform"

    def _native(self, dimensions: int):
        return _lab.random_walk(_sizes(self, dimensions), _shape(self))


@dataclass(frozen=True)
class AdaptiveWalk:
    """A random walk that learns its size: small while too little is accepted, large while too much.

    After its i-th proposal, log(size) += rate * i**-decay * (acceptance - goal) (Andrieu & Thoms
    2008). With decay = 0 the size never settles; it then depends on where the chain has just been,
    and the chain no longer samples its target.
    """

    size: float | Sequence[float]
    shape: str = "uniform"
    goal: float = 0.44
    rate: float = 1.0
    decay: float = 0.6

    def _native(self, dimensions: int):
        if not 0 < self.goal < 1:
            raise _core.UsageError(f"{self}: goal must be between 0 and 1")
        if not (self.rate >= 0 and self.decay >= 0):
            raise _core.UsageError(f"{self}: rate and decay must not be negative")
        sizes = _sizes(self, dimensions)
        return _lab.adaptive_walk(sizes, _shape(self), self.goal, self.rate, self.decay)


@dataclass(frozen=True)
class Uniform:
    """y uniform in the box from low to high (numbers, or one per coordinate), whatever x is."""

    low: float | Sequence[float] = 0.0
    high: float | Sequence[float] = 1.0

    def _native(self, dimensions: int):
        import numpy as np

        low, high = (_spread(self, side, dimensions) for side in (self.low, self.high))
        if not np.all(low < high):
            raise _core.UsageError(f"{self}: low must be below high")
        return _lab.uniform(low, high)


class Discrete:
    """q(x -> y) between the states 0 ... n - 1, as a matrix with one row for each x.

    A single row means that y does not depend on x, as in the lecture's (9/10, 1/10).
    """

    def __init__(self, T):
        self.T = T

    def _native(self, dimensions: int):
        return _lab.discrete(transition_matrix(self.T))

    def __repr__(self) -> str:
        return f"Discrete({self.T!r})"


def transition_matrix(T):
    """T as a square matrix of probabilities whose rows sum to 1, or an error that says why not."""
    import numpy as np

    matrix = np.asarray(T, dtype=float)
    if matrix.ndim == 1:
        matrix = np.tile(matrix, (matrix.size, 1))
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or matrix.size == 0:
        raise _core.UsageError(f"T must be a square matrix or one row, not of shape {matrix.shape}")
    if not (np.isfinite(matrix).all() and (matrix >= 0).all()):
        raise _core.UsageError("T must hold probabilities, which are not negative")
    sums = matrix.sum(axis=1)
    wrong = np.flatnonzero(np.abs(sums - 1) > 1e-9)
    if wrong.size:
        raise _core.UsageError(f"row {wrong[0]} of T sums to {sums[wrong[0]]:.6g}, not to 1")
    return matrix


def _shape(move) -> str:
    if move.shape not in ("uniform", "normal"):
        raise _core.UsageError(f"{move}: shape must be 'uniform' or 'normal'")
    return move.shape


def _sizes(move, dimensions: int):
    sizes = _spread(move, move.size, dimensions)
    if not (sizes > 0).all():
        raise _core.UsageError(f"{move}: size must be positive")
    return sizes


def _spread(move, value, dimensions: int):
    """One number per coordinate."""
    import numpy as np

    array = np.asarray(value, dtype=float)
    if array.shape not in ((), (dimensions,)):
        raise _core.UsageError(f"{move} does not fit a state of {dimensions} numbers")
    if not np.isfinite(array).all():
        raise _core.UsageError(f"{move}: numbers must be finite")
    return np.broadcast_to(array, (dimensions,))
