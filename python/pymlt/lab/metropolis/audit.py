"""The audit of moves: does one step leave the target in detailed balance?"""

from __future__ import annotations

from collections.abc import Callable
from statistics import NormalDist
from typing import Any

from ... import _core
from .reversal import NINE_IN_TEN, MoveAudit, sequential
from .run import _run, _seed
from .state_sets import Numbers, set_around


def audit(
    target: Callable[[Any], Any],
    moves: Any,
    x0: Any,
    n: int = 10_000,
    *,
    seed: int = 0,
    vectorized: bool = False,
    significance: float = 1e-4,
) -> MoveAudit:
    """Test moves of functions: does a step go from x to y as often as from y to x?

    A chain of n steps finds out where the target is; then n states, uniform around these, make one
    step each, and every function of x and y that changes its sign when they change places must have
    the mean 0, weighted by the target. It sees a wrong `density`, and a wrong `symmetric = True`.
    While something looks suspicious, n doubles, up to sixteen times. No test can say that a move is
    right: the verdict tells which fault would have been found.

    target, moves, x0, vectorized
        as for `run`; `mlt.audit` is for mutations of light paths.
    significance
        the chance of finding fault with moves that have none.
    """
    import numpy as np

    if hasattr(target, "metropolis_chains"):
        raise _core.UsageError("mlt.audit(mutation, scene) audits mutations of light paths")
    pilot, form = _run(target, moves, x0, n, False, seed, None, vectorized)
    space = set_around(pilot.states, form)
    if space is None:
        why = "the chain has not visited a box of states, or many times the same few"
        return MoveAudit("inconclusive", f"{why}; give another x0, or more n", [], n)

    def values(x):
        if vectorized:
            return np.asarray(target(x), dtype=float)
        return np.array([float(target(s)) for s in x])

    def sample(sums, count, stage):
        rng = np.random.default_rng([_seed(seed), stage])
        x = space.draw(rng, count)
        f = values(x)
        bright = np.flatnonzero(f > 0)
        x, f = [x[i] for i in bright] if isinstance(x, list) else x[bright], f[bright]
        if not len(x):
            sums.count += count
            return
        step_seed = int(rng.integers(2**63))
        step, _ = _run(target, moves, x, 1, True, step_seed, len(x), vectorized)
        y = step.samples if isinstance(step.samples, list) else step.samples[:, 0]
        y = [chain[0] for chain in y] if isinstance(y, list) else y
        weights = f * step.weights.reshape(len(x), 2)[:, 0]
        inside = np.flatnonzero(space.contains(y) & (weights > 0))
        x, y = ([z[i] for i in inside] if isinstance(z, list) else z[inside] for z in (x, y))
        sums.add(space, x, y, weights[inside], count)

    tests, level, sums = sequential(sample, n, 16 * n, significance)
    if not tests:
        why = "too few steps were accepted between states that the chain has visited"
        return MoveAudit("inconclusive", f"{why}; give more n", [], sums.count)
    worst = tests[0]
    if worst.adjusted_p <= level:
        why = (
            f"'{worst.function}' goes one way by {worst.change:.3g} +- {worst.error:.2g} (z = "
            f"{worst.z:.1f}): f(x) q(x -> y) a(x -> y) is not what goes back"
        )
        return MoveAudit("wrong", why, tests, sums.count)
    z = NormalDist().inv_cdf(1 - level / len(tests) / 2) + NINE_IN_TEN
    return MoveAudit("nothing found", _power(space, tests, z, sums), tests, sums.count)


def _power(space, tests, z, sums) -> str:
    """What would have been found nine times in ten."""
    least = f"(least p = {tests[0].adjusted_p:.2g} of {len(tests)} tests after correction)"
    shifts = []
    if isinstance(space, Numbers):
        for j, width in enumerate(space.high - space.low):
            name = f"x[{j}]" if space.form == "array" else "x"
            shifts += [
                f"of {name} by more than {z * t.error * width * sums.count / sums.moved:.2g}"
                for t in tests
                if t.function == name
            ]
    if shifts:
        return f"in each accepted step a shift {', '.join(shifts)} would have been {least}"
    worst = max(tests, key=lambda t: t.error)
    return (
        f"a change of '{worst.function}' by more than {z * worst.error:.2g} would have been {least}"
    )
