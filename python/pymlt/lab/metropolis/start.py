"""Starting without start-up bias (Veach & Guibas 1997, sec. 5.1)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ... import _core


@dataclass(frozen=True)
class Start:
    """Where chains start, and what the candidates said about the integral b of the target."""

    b: float
    b_error: float
    starts: Any

    def __repr__(self) -> str:
        return f"Start(b={self.b:.6g} ± {self.b_error:.2g}, {len(self.starts)} starts)"


def bootstrap(
    target: Callable[[Any], Any],
    sample: Callable,
    density: Callable[[Any], Any],
    candidates: int,
    chains: int = 1,
    *,
    seed: int = 0,
) -> Start:
    """Draw candidates from a known density p and start chains in proportion to f / p.

    `sample(rng, count)` returns an array of states, `density` their p and `target` their f; all
    take arrays. The mean of f / p estimates b, the integral of the target. b times a mean over
    chains that start there is unbiased from the first step on.
    """
    import numpy as np

    rng = np.random.default_rng(seed)
    x, weights = candidate_weights(target, sample, density, candidates, rng)
    b, b_error, chosen = _core.lab.resample(weights, chains, seed)
    order = np.random.default_rng([seed, 1]).permutation(len(chosen))
    return Start(b, b_error, x[np.asarray(chosen)[order]])


def candidate_weights(target, sample, density, count: int, rng) -> tuple:
    """This number of candidates, and their f / p. Raises UsageError for what these cannot be."""
    import numpy as np

    x = np.asarray(sample(rng, count))
    f, p = (np.asarray(function(x), dtype=float) for function in (target, density))
    if f.shape != (count,) or p.shape != (count,):
        raise _core.UsageError("target and density must return one number for each candidate")
    if not (p > 0).all():
        raise _core.UsageError("density is not positive at a candidate that sample has drawn")
    weights = f / p
    if not (np.isfinite(weights).all() and (weights >= 0).all()):
        raise _core.UsageError("the target must be finite and not negative at every candidate")
    if not weights.any():
        raise _core.UsageError(f"the target is 0 at all of {count} candidates; draw more")
    return x, weights
