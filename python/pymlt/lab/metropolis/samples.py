"""What a run leaves: samples with weights, and what they say."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ... import _core
from ...diagnostics._arviz import import_arviz

if TYPE_CHECKING:
    from ..quadrature import Estimate


@dataclass(frozen=True, repr=False)
class Samples:
    """The samples of one chain, or of several (then with a first axis for chains).

    samples
        The samples, (chains,) samples (, dimensions). Lists if the states are Python objects.
    weights
        Their weights, which sum to the number of steps: all 1, or a and 1 - a in turn.
    states
        The chain itself, the state after each step. Without expected values, the same as samples.
    acceptance_probability
        a of each step; 0 where there was no proposal.
    accepted
        Whether each proposal was taken.
    move
        The index of the move of each step; -1 if none suited the state.
    sizes
        The size of the adaptive move after each step, or None.
    moves
        The moves, in their order.
    b, b_error
        The integral of the target and its error, if the run started from a bootstrap.
    """

    samples: Any
    weights: Any
    states: Any
    acceptance_probability: Any
    accepted: Any
    move: Any
    sizes: Any
    moves: list
    b: float | None = None
    b_error: float | None = None
    _axis: bool = field(default=False)

    @classmethod
    def _from_trace(cls, trace: dict, form: str, chains, moves, b, b_error) -> Samples:
        import numpy as np

        def shaped(x):
            if x is None:
                return None
            if form == "object":
                return x if chains is not None else x[0]
            x = x if form == "array" else x[..., 0]
            x = x.astype(np.int64) if form == "integer" else x
            return x if chains is not None else x[0]

        def row(x):
            return x if chains is not None else x[0]

        states = shaped(trace["states"])
        samples = shaped(trace["samples"])
        weights = trace["weights"]
        sizes = trace["sizes"]
        return cls(
            samples=states if samples is None else samples,
            weights=row(np.ones_like(trace["acceptance"]) if weights is None else weights),
            states=states,
            acceptance_probability=row(trace["acceptance"]),
            accepted=row(trace["accepted"]),
            move=row(trace["moves"]),
            sizes=None if np.isnan(sizes).all() else row(sizes),
            moves=moves,
            b=b,
            b_error=b_error,
            _axis=chains is not None,
        )

    @property
    def acceptance(self) -> float:
        """The mean acceptance probability over all steps."""
        return float(self.acceptance_probability.mean())

    @property
    def move_table(self) -> list[dict]:
        """For each move: how often it was chosen and accepted, and its mean acceptance."""
        rows = []
        for i, move in enumerate(self.moves):
            chosen = self.move == i
            count = int(chosen.sum())
            rows.append(
                {
                    "move": repr(move),
                    "proposed": count,
                    "accepted": int(self.accepted[chosen].sum()),
                    "acceptance": float(self.acceptance_probability[chosen].mean())
                    if count
                    else float("nan"),
                }
            )
        return rows

    def mean(self, g=None):
        """The weighted mean over all samples of g, which takes an array of states (None: x)."""
        import numpy as np

        values, weights = self._values(g)
        return np.tensordot(weights.ravel(), values.reshape(weights.size, *values.shape[2:]), 1) / (
            weights.sum()
        )

    def estimate(self, g=None, integral: float | None = None) -> Estimate:
        """Metropolis quadrature: the integral of g f = mean of g times the integral of f.

        `integral` is that of f (None: b of the bootstrap, else 1, which leaves the mean of g). The
        standard error comes from the spread between 8 chains or more, else between batches of
        consecutive steps; it counts correlation, and the error of b.
        """
        import numpy as np

        from ..quadrature import Estimate

        scale = integral if integral is not None else 1.0 if self.b is None else self.b
        values, weights = self._values(g)
        if values.ndim != 2:
            raise _core.UsageError("estimate needs a g that returns one number for each sample")
        chains, length = values.shape
        batches = 1 if chains >= 8 else max(2, int(np.sqrt(length)) // 2)
        usable = length // batches * batches
        parts = (chains * batches, usable // batches)
        v, w = (x[:, :usable].reshape(parts) for x in (values, weights))
        means = (v * w).sum(axis=1) / w.sum(axis=1)
        error = means.std(ddof=1) / np.sqrt(len(means)) * abs(scale)
        mean = float((values * weights).sum() / weights.sum())
        if integral is None and self.b_error:
            error = np.hypot(error, self.b_error * mean)
        return Estimate(mean * scale, float(error), self.samples, values.ravel() * scale)

    def to_arviz(self, name: str = "x", g=None):
        """The chains as an ArviZ `InferenceData`: for R-hat, effective sample sizes, plots.

        `g` is a function of one state; states that are Python objects, such as light paths, need
        it.
        """
        import numpy as np

        arviz = import_arviz("to_arviz")
        states = self.states if self._axis else [self.states]
        if g is not None:
            states = [[g(x) for x in chain] for chain in states]
        try:
            states = np.asarray(states, dtype=float)
        except (TypeError, ValueError):
            raise _core.UsageError("to_arviz needs states that are numbers, or g") from None
        probability = np.atleast_2d(self.acceptance_probability)
        return arviz.from_dict(
            posterior={name: states}, sample_stats={"acceptance_rate": probability}
        )

    def _values(self, g):
        """g at all samples, shape (chains, samples, ...), and the weights."""
        import numpy as np

        samples, weights = self.samples, np.atleast_2d(self.weights)
        if isinstance(samples, list):
            if g is None:
                raise _core.UsageError("the states are Python objects; say which number to average")
            chains = samples if self._axis else [samples]
            return np.array([[g(x) for x in chain] for chain in chains], dtype=float), weights
        samples = samples if self._axis else samples[None]
        if g is None:
            return samples.astype(float), weights
        flat = samples.reshape(-1, *samples.shape[2:])
        values = np.asarray(g(flat), dtype=float)
        if values.shape[:1] != flat.shape[:1]:
            raise _core.UsageError(
                f"g must return one value for each sample of an array of {len(flat)}, but its "
                f"result has the shape {values.shape}"
            )
        return values.reshape(*weights.shape, *values.shape[1:]), weights

    def __repr__(self) -> str:
        chains = len(self.samples) if self._axis else 1
        steps = self.accepted.shape[-1]
        return f"<Samples: {chains} x {steps} steps, mean acceptance {self.acceptance:.3f}>"


def autocorrelation(values, lags: int = 100):
    """The correlation of a sequence with itself, 0 to `lags` steps later; the mean over chains."""
    import numpy as np

    x = np.atleast_2d(np.asarray(values, dtype=float))
    x = x - x.mean()
    n = x.shape[1]
    if not 0 < lags < n:
        raise _core.UsageError(f"lags must be between 1 and {n - 1}, not {lags}")
    spectrum = np.fft.rfft(x, 2 * n, axis=1)
    covariance = np.fft.irfft(np.abs(spectrum) ** 2, axis=1)[:, : lags + 1].mean(axis=0)
    covariance /= n - np.arange(lags + 1)
    return covariance / covariance[0]
