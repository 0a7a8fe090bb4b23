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
from typing import Any, NamedTuple

from .targets import Target

LEAST_EFFECTIVE = 100  # changes of a function; its mean is not normal with fewer
MOST_STATES = 5000  # that are looked at to find the box
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


class Numbers:
    """A box around visited states of numbers. Coordinates with few values keep to these."""

    def __init__(self, rows, form: str):
        import numpy as np

        self.form = form
        self.low, self.high = rows.min(axis=0), rows.max(axis=0)
        self.values: list[Any] = [None] * rows.shape[1]
        distinct = np.unique(rows, axis=0)
        for j in range(rows.shape[1]):
            values = np.unique(rows[:, j])
            if len(values) <= len(distinct) / (10 * rows.shape[1]) or len(values) < 30:
                self.values[j] = values
            elif np.array_equal(values, np.floor(values)):
                self.values[j] = np.arange(values[0], values[-1] + 1)

    @staticmethod
    def around(states, form: str):
        """None where the states fill no box: few, or with a sum or a norm that stays the same."""
        import numpy as np

        rows = np.asarray(states, dtype=float)
        rows = rows.reshape(-1, rows.shape[-1] if form == "array" else 1)
        rows = rows[:: max(1, len(rows) // MOST_STATES)]
        box = Numbers(rows, form)
        free = [j for j, values in enumerate(box.values) if values is None]
        u = (np.unique(rows[:, free], axis=0) - box.low[free]) / (box.high - box.low)[free]
        terms = np.hstack([np.ones((len(u), 1)), u, u**2])
        if free and (len(u) < 30 + terms.shape[1] or _dependent(terms)):
            return None
        return box if (box.high > box.low).any() else None

    def draw(self, rng, count: int):
        import numpy as np

        x = self.low + rng.random((count, len(self.low))) * (self.high - self.low)
        for j, values in enumerate(self.values):
            if values is not None:
                x[:, j] = rng.choice(values, count)
        x = x.astype(np.int64) if self.form == "integer" else x
        return x if self.form == "array" else x[:, 0]

    def contains(self, y):
        import numpy as np

        rows = self._rows(y)
        inside = ((rows >= self.low) & (rows <= self.high)).all(axis=1)
        for j, values in enumerate(self.values):
            if values is not None:
                inside &= np.isin(rows[:, j], values)
        return inside

    def array(self, states):
        import numpy as np

        return np.asarray(states, dtype=float)

    def functions(self, x, y):
        """Pairs of a name and h(x, y)."""
        import numpy as np

        width = np.where(self.high > self.low, self.high - self.low, 1)
        u, v = ((self._rows(z) - self.low) / width for z in (x, y))
        step = abs(v - u).max(axis=1)
        for j in range(min(u.shape[1], 8)):
            name = "x" if self.form != "array" else f"x[{j}]"
            for text, g in (
                (name, lambda t: t),
                (f"{name} squared", lambda t: t * t),
                (f"cosine of {name}", lambda t: np.cos(np.pi * t)),
                (f"cosine of 2 {name}", lambda t: np.cos(2 * np.pi * t)),
                (f"sine of 2 {name}", lambda t: np.sin(2 * np.pi * t)),
            ):
                change = g(v[:, j]) - g(u[:, j])
                yield text, change
                yield f"{text}, by the step", step * change

    def _rows(self, states):
        import numpy as np

        return np.asarray(states, dtype=float).reshape(-1, len(self.low))


class Objects:
    """Visited states that are no numbers, if they are few."""

    def __init__(self, counts: dict):
        self.states = sorted(counts, key=lambda x: -counts[x])
        self.index = {x: i for i, x in enumerate(self.states)}

    @staticmethod
    def around(states):
        counts: dict = {}
        try:
            for x in states:
                counts[x] = counts.get(x, 0) + 1
        except TypeError:  # no hash
            return None
        return Objects(counts) if 1 < len(counts) <= len(states) / 4 else None

    def draw(self, rng, count: int):
        return [self.states[i] for i in rng.integers(len(self.states), size=count)]

    def contains(self, y):
        import numpy as np

        return np.array([x in self.index for x in y], dtype=bool)

    def array(self, states):
        return list(states)

    def functions(self, x, y):
        import numpy as np

        i, j = (np.array([self.index[s] for s in states]) for states in (x, y))
        yield "the order of the states", np.sign(j - i).astype(float)
        for k, state in enumerate(self.states[:16]):
            yield f"{state!r}", (j == k).astype(float) - (i == k)


def set_around(states, form: str):
    """The set of states to test moves on; None if there is none."""
    return Objects.around(states) if form == "object" else Numbers.around(states, form)


def _dependent(terms) -> bool:
    import numpy as np

    values = np.linalg.svd(terms, compute_uv=False)
    return bool(values[-1] < 1e-9 * values[0])


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
