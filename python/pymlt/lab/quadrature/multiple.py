"""Multiple importance sampling (Veach & Guibas 1995; Veach 1997, sec. 9.2)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ... import _core
from .checks import check_count, evaluate
from .heuristics import HEURISTICS
from .single import Estimate
from .technique import Technique, draw


def combined(
    f: Callable,
    techniques: Sequence[Technique | tuple[Callable, Callable]],
    counts: int | Sequence[int],
    *,
    heuristic: str | Callable = "balance",
    seed: int = 0,
) -> Estimate:
    """Multiple importance sampling: the sum over techniques of the mean of w_i f / p_i.

    Parameters
    ----------
    techniques
        `Technique` objects, or (sample, pdf) pairs.
    counts
        Number of samples of each technique; one number: the same for all.
    heuristic
        "balance", "power", "cutoff" or "maximum"; or a function of the array
        q[i, j] = n_i p_i(x_j) that returns the weights w[i, j] of technique i at sample j. They
        must sum to 1 over the techniques wherever f is not 0, and be 0 where p_i is; this is
        checked.
    """
    import numpy as np

    techniques = [t if isinstance(t, Technique) else Technique(*t) for t in techniques]
    if not techniques:
        raise _core.UsageError("combined needs at least one technique")
    counts = [counts] * len(techniques) if np.ndim(counts) == 0 else list(counts)
    if len(counts) != len(techniques):
        raise _core.UsageError(f"{len(counts)} counts for {len(techniques)} techniques")
    for count in counts:
        check_count(count, "each of counts")
    weigh = _heuristic(heuristic)
    rng = np.random.default_rng(seed)
    estimate, variance, samples, contributions = 0.0, 0.0, [], []
    for i, (technique, count) in enumerate(zip(techniques, counts, strict=True)):
        x, p = draw(technique, rng, count)
        q = np.stack(
            [c * evaluate(t.pdf, x, "pdf") for t, c in zip(techniques, counts, strict=True)]
        )
        values = evaluate(f, x, "f")
        weights = _checked_weights(weigh(q), q, values, x)
        part = weights[i] * values / p
        estimate += part.mean()
        variance += part.var(ddof=1) / count
        samples.append(x)
        contributions.append(part)
    return Estimate(
        float(estimate),
        float(np.sqrt(variance)),
        np.concatenate(samples),
        np.concatenate(contributions),
    )


def _heuristic(heuristic) -> Callable:
    if callable(heuristic):
        return heuristic
    if heuristic not in HEURISTICS:
        raise _core.UsageError(
            f"unknown heuristic {heuristic!r}{_core.suggestion(str(heuristic), list(HEURISTICS))}"
        )
    return HEURISTICS[heuristic]


def _checked_weights(weights, q, values, x):
    """They must sum to 1 where f is not 0, and be 0 where p_i is (Veach 1997, sec. 9.2)."""
    import numpy as np

    weights = np.asarray(weights, dtype=float)
    if weights.shape != q.shape:
        raise _core.UsageError(f"the weights have the shape {weights.shape}, not {q.shape}")
    error = np.where(values != 0, np.abs(weights.sum(axis=0) - 1), 0)
    if not (error < 1e-9).all():
        j = int(np.argmax(np.where(np.isnan(error), np.inf, error)))
        raise _core.UsageError(
            f"the weights sum to {weights[:, j].sum():.6g} at x = {x[j]}, where f is not 0; they "
            "must sum to 1"
        )
    if ((weights != 0) & (q == 0) & (values != 0)).any():
        raise _core.UsageError("a technique has weight where its pdf is 0; the weight must be 0")
    return weights
