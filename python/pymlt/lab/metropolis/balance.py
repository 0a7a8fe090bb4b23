"""Detailed balance on a discrete space, written out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ... import _core
from .moves import transition_matrix


@dataclass(frozen=True)
class DetailedBalance:
    """For each pair of states: how much goes from one to the other, and back. Print it.

    f: the target. T: the proposals q(x -> y). a: acceptances. K: the chain's transition
    probabilities, with what is rejected on the diagonal. flow: f(x) q(x -> y) a(x -> y), which is
    symmetric.
    """

    f: Any
    T: Any
    a: Any
    K: Any
    names: tuple[str, ...]

    @property
    def flow(self):
        return self.f[:, None] * self.T * self.a

    @property
    def stationary(self):
        """f as probabilities."""
        return self.f / self.f.sum()

    def holds(self) -> bool:
        """Is the flow between any two states the same both ways?"""
        import numpy as np

        return bool(np.allclose(self.flow, self.flow.T, rtol=1e-12, atol=0))

    def __str__(self) -> str:
        width = max(len(name) for name in self.names)
        head = f"{'x -> y':>{2 * width + 4}}  {'f(x)':>8}  {'q(x->y)':>8}  {'a(x->y)':>8}  f(x) q a"
        lines = [head]
        for i, x in enumerate(self.names):
            for j, y in enumerate(self.names):
                lines.append(
                    f"{x:>{width}} -> {y:>{width}}  {self.f[i]:8.4g}  {self.T[i, j]:8.4f}  "
                    f"{self.a[i, j]:8.4f}  {self.flow[i, j]:8.4f}"
                )
        return "\n".join(lines)


def detailed_balance(f, T, names=None) -> DetailedBalance:
    """The table of a target f on n states with the proposals T: a matrix, or one row for all x."""
    import numpy as np

    f = np.asarray(f, dtype=float)
    T = transition_matrix(T)
    n = len(T)
    if f.shape != (n,) or not (np.isfinite(f).all() and (f > 0).all()):
        raise _core.UsageError(f"f must be positive on each of the {n} states of T")
    acceptance = _core.lab.acceptance
    a = np.array(
        [
            [acceptance(T[i, j] / f[j], T[j, i] / f[i]) if T[i, j] > 0 else 0 for j in range(n)]
            for i in range(n)
        ]
    )
    K = T * a
    K[np.diag_indices(n)] += 1 - K.sum(axis=1)
    names = tuple(map(str, names)) if names is not None else tuple(map(str, range(n)))
    return DetailedBalance(f, T, a, K, names)
