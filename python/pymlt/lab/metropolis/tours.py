"""Tours: chains that start over and over, so that none needs a good start.

R. Wang, M. Pollock, G. Roberts, D. Steinsaltz, "Regeneration-enriched Markov processes with
application to Monte Carlo", 2021. `cpp/markov/tour.h` has the proof.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .run import run
from .start import candidate_weights
from .targets import Target

if TYPE_CHECKING:
    import numpy as np

    from ..quadrature import Estimate


@dataclass(frozen=True)
class Tours:
    """What tours have visited."""

    states: np.ndarray  #: after each step, those of all tours, (steps, ...)
    tour: np.ndarray  #: from which sample the tour has started that each belongs to: int, (steps,)
    samples: int  #: how many there were, each with a tour, if of no step
    kappa0: float

    def estimate(self, g: Callable | None = None) -> Estimate:
        """The integral of g f; of the target f itself without g, which takes an array of states.

        Tours are independent of each other: the standard error is that of their mean.
        """
        import numpy as np

        from ..quadrature import Estimate

        values = np.ones(len(self.states)) if g is None else g(self.states)
        sums = self.kappa0 * np.bincount(self.tour, values, minlength=self.samples)
        error = sums.std(ddof=1) / np.sqrt(self.samples)
        return Estimate(float(sums.mean()), float(error), self.samples, sums)


def tours(
    target: Callable[[Any], Any],
    moves: Any,
    sample: Callable,
    density: Callable[[Any], Any],
    n: int = 10_000,
    *,
    steps: float = 10,
    seed: int = 0,
) -> Tours:
    """Start a tour from each of n samples of a known density p, and let it die by chance.

    In a state x it dies with probability kappa / (1 + kappa), kappa = kappa0 p(x) / f(x), else it
    makes a Metropolis step. Then the states after the steps have the density f / kappa0 per sample,
    for any kappa0 and any moves. kappa0 is chosen so that a sample has about `steps` steps.

    `sample(rng, count)` returns an array of states, `density` their p and `target` their f; all
    take arrays, and so do moves written in Python, as for `run` with `vectorized=True`. Raises what
    `bootstrap` raises.
    """
    import numpy as np

    pilot, rng = np.random.default_rng([seed, 1]), np.random.default_rng(seed)
    kappa0 = candidate_weights(target, sample, density, 1000, pilot)[1].mean() / steps
    x, over_density = candidate_weights(target, sample, density, n, rng)
    survival, u, tour = np.ones(n), rng.random(n), np.arange(n)
    visited, belongs = [x[:0]], [tour[:0]]
    while True:
        with np.errstate(divide="ignore"):
            survival = survival / (1 + kappa0 / over_density)
        alive = survival > u
        if not alive.any():
            return Tours(np.concatenate(visited), np.concatenate(belongs), n, float(kappa0))
        survival, u, tour = survival[alive], u[alive], tour[alive]
        vectorized = not isinstance(target, Target)
        step_seed = int(rng.integers(2**63))
        step = run(target, moves, x[alive], 1, chains=len(u), seed=step_seed, vectorized=vectorized)
        x = step.states[:, -1]
        visited.append(x)
        belongs.append(tour)
        with np.errstate(divide="ignore"):
            over_density = np.asarray(target(x), dtype=float) / np.asarray(density(x), dtype=float)
