"""Sets of states around those that a chain has visited: boxes of numbers, or lists of objects."""

from __future__ import annotations

from typing import Any

MOST_STATES = 5000  # that are looked at to find the box


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
