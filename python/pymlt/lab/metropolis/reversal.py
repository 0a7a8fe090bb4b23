"""Do the moves of a chain go from x to y as often as back?

Let X be uniform on a set of states, and Y what a move makes of it. If q(x -> y) = q(y -> x), then
the pairs (X, Y) in the set have the same distribution as (Y, X): E[h(X, Y)] = 0 for every h with
h(y, x) = -h(x, y), whatever the set is. If X has the weight f(X), the same holds for a step that
leaves f in detailed balance. The set is a box around the states that a chain has visited, without
those where the target is 0.
"""

from __future__ import annotations

import copy
import math
import warnings
from dataclasses import dataclass
from typing import NamedTuple

from .state_sets import set_around
from .targets import Target

LEAST_EFFECTIVE = 100  # changes of a function; its mean is not normal with fewer
LEAST_PROPOSALS = 100  # with which a run tests its moves
SUSPICIOUS = 0.02  # p-values that are a reason for more samples, but no proof
NINE_IN_TEN = 1.2816  # standard errors, above which a normal variable is nine times in ten


class MoveTest(NamedTuple):
    """One function of a step, and its mean, which is 0 if the step is reversible."""

    function: str
    change: float
    error: float  #: its standard error
    z: float
    p: float
    adjusted_p: float  #: after Holm's correction for all tests


@dataclass(frozen=True)
class MoveAudit:
    """What `metropolis.audit` found; true if it found nothing wrong."""

    verdict: str  #: "nothing found", "wrong" or "inconclusive"
    reason: str
    tests: list[MoveTest]  #: the least probable first
    steps: int

    def __bool__(self) -> bool:
        return self.verdict == "nothing found"

    def summary(self) -> str:
        return f"{self.verdict}{';' if self else ':'} {self.reason}"

    def __repr__(self) -> str:
        return f"MoveAudit({self.verdict!r}{';' if self else ':'} {self.reason})"


class Sums:
    """Means of h(X, Y) over all samples so far."""

    def __init__(self):
        self.count = 0
        self.moved = 0.0  # sum of the weights of all steps
        self.sums: dict = {}

    def add(self, space, x, y, weights, count: int) -> None:
        import numpy as np

        self.count += count
        self.moved += float(np.sum(weights * np.ones(len(x))))
        for name, change in space.functions(x, y):
            h = weights * change
            found = np.array([h.sum(), (h * h).sum(), abs(h).sum()])
            self.sums[name] = self.sums.get(name, 0) + found

    def tests(self) -> list[MoveTest]:
        n = self.count
        found = []
        for name, (total, squares, size) in self.sums.items():
            if not size**2 >= LEAST_EFFECTIVE * squares or squares == 0:
                continue
            error = math.sqrt(squares / n - (total / n) ** 2) / math.sqrt(n)
            z = total / n / error if error > 0 else math.copysign(math.inf, total)
            found.append((math.erfc(abs(z) / math.sqrt(2)), name, total / n, error, z))
        found.sort()
        largest, result = 0.0, []
        for i, (p, name, change, error, z) in enumerate(found):
            largest = max(largest, min(1.0, p * (len(found) - i)))
            result.append(MoveTest(name, change, error, z, p, largest))
        return result


def sequential(sample, first: int, most: int, significance: float):
    """The tests after the last stage, the significance that it had, and the sums of the samples.

    `sample(sums, count, stage)` adds samples; half of the significance left is spent on each stage.
    """
    sums, count, level, stage = Sums(), first, significance, 0
    while True:
        sample(sums, count, stage)
        last = 2 * sums.count > most
        level = level if last else level / 2
        tests = sums.tests()
        if last or not tests or not level < tests[0].adjusted_p < SUSPICIOUS:
            return tests, level, sums
        count, stage = sums.count, stage + 1


def unlike_their_reverse(target, moves, states, form, vectorized, steps, seed) -> list[str]:
    """Tells of moves in Python that claim wrongly to be symmetric, a sentence for each."""
    claims = [move for move in moves if getattr(move, "symmetric", False) and _in_python(move)]
    enough = claims and steps >= 8 * LEAST_PROPOSALS
    space = set_around(states, form) if enough else None
    if space is None:
        return []
    first = min(2000, steps // 8)
    told = []
    for index, move in enumerate(claims):
        sample = _proposals(target, move, space, vectorized, [seed, index])
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                tests, level, sums = sequential(sample, first, 16 * first, 1e-6)
        except Exception:  # the move or the target means nothing beyond what the chain can reach
            continue
        if tests and tests[0].adjusted_p <= level:
            worst = tests[0]
            told.append(
                f"{move!r} claims that q(x -> y) = q(y -> x) per unit of x, but does not go both "
                f"ways equally often: in {sums.count} proposals from where the chain has been, "
                f"'{worst.function}' changes by {worst.change:.3g} +- {worst.error:.2g} (z = "
                f"{worst.z:.1f}). Give it density(x, y) in place of symmetric = True"
            )
    return told


def _in_python(move) -> bool:
    return hasattr(move, "propose") and not hasattr(move, "_native")


def _proposals(target, move, space, vectorized, seed):
    """For `sequential`: states where the target is not 0, and what the move makes of them."""
    import numpy as np

    mine = copy.deepcopy(move) if getattr(move, "_adapts", False) else move

    def suits(x):
        if vectorized:
            return np.asarray(target(x), dtype=float) > 0
        if mine._suits_all and isinstance(target, Target):
            return target(x) > 0
        return np.array([target(s) > 0 and mine.suitability(s) > 0 for s in x], dtype=bool)

    def sample(sums, count, stage):
        rng = np.random.default_rng([*seed, stage])
        x = space.draw(rng, count)
        x = _chosen(x, suits(x))
        if vectorized:
            y = mine.propose(x, rng)
        else:
            y = [mine.propose(s, rng) for s in x]
            made = np.array([s is not None for s in y], dtype=bool)
            x, y = _chosen(x, made), space.array(_chosen(y, made))
        inside = space.contains(y)
        x, y = _chosen(x, inside), _chosen(y, inside)
        inside = suits(y)
        x, y = _chosen(x, inside), _chosen(y, inside)
        sums.add(space, x, y, 1.0, count)

    return sample


def _chosen(states, which):
    if isinstance(states, list):
        return [x for x, chosen in zip(states, which, strict=True) if chosen]
    return states[which]
