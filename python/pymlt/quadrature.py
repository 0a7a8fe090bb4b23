"""Monte Carlo quadrature: naive, stratified, by importance sampling, and by several techniques.

For example::

    from pymlt import quadrature

    quadrature.naive(lambda x: x**2, (0, 1), 10_000)          # 0.333 ± 0.003
    quadrature.stratified(lambda x: x**2, (0, 1), 10_000)     # far closer, for the same work

Functions take numpy arrays: in one dimension of shape (n,), in d dimensions of shape (n, d); and
return n values. A domain is (low, high), or a list of these for several dimensions. The source of
the methods is Veach 1997, chapters 2 and 9.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from . import _core

__all__ = [
    "HEURISTICS",
    "Estimate",
    "Technique",
    "combined",
    "importance",
    "naive",
    "stratified",
]


@dataclass(frozen=True)
class Estimate:
    """An estimate of an integral with its standard error.

    samples: where the function was evaluated. contributions: what each sample says of the integral;
    their mean (or, with several strata or techniques, the sum of the means) is the estimate.
    """

    estimate: float
    standard_error: float
    samples: Any = field(repr=False)
    contributions: Any = field(repr=False)

    def __str__(self) -> str:
        return f"{self.estimate:.6g} ± {self.standard_error:.2g}"


# ---- the methods --------------------------------------------------------------------------------


def naive(f: Callable, domain, n: int, *, seed: int = 0) -> Estimate:
    """n samples, uniform in the domain: the mean of f times the volume."""
    import numpy as np

    low, high = _box(domain)
    _check_count(n)
    u = np.random.default_rng(seed).random((n, len(low)))
    x = _points(low + u * (high - low), domain)
    values = _evaluate(f, x, "f") * np.prod(high - low)
    return _plain(x, values)


def stratified(
    f: Callable,
    domain,
    n: int | None = None,
    *,
    strata=None,
    per_stratum: int = 2,
    seed: int = 0,
) -> Estimate:
    """Jittered samples: uniform within each part A_i of the domain, weighted by mu(A_i).

    The estimate is the sum over all parts of mu(A_i) times the mean of f over the samples there.

    Parameters
    ----------
    n
        About how many samples in all; it chooses the number of strata.
    strata
        In place of n: the number of intervals, in each dimension the same; or a list with, for each
        dimension, the number or the ascending edges of the intervals (in one dimension: the edges).
    per_stratum
        With 2 or more the standard error is unbiased. With 1 it is taken from the differences
        between neighbouring strata and errs on the safe side.
    """
    import numpy as np

    low, high = _box(domain)
    _check_count(per_stratum, "per_stratum", 1)
    edges = _edges(low, high, n, strata, per_stratum)
    widths = [np.diff(e) for e in edges]
    grid = np.stack(
        [g.ravel() for g in np.meshgrid(*map(np.arange, map(len, widths)), indexing="ij")]
    )
    start = np.stack([e[i] for e, i in zip(edges, grid, strict=True)], axis=1)
    width = np.stack([w[i] for w, i in zip(widths, grid, strict=True)], axis=1)
    u = np.random.default_rng(seed).random((len(start), per_stratum, len(low)))
    x = start[:, None] + u * width[:, None]
    x = _points(x.reshape(-1, len(low)), domain)
    measure = width.prod(axis=1)
    values = _evaluate(f, x, "f").reshape(len(start), per_stratum) * measure[:, None]
    if per_stratum > 1:
        variance = (values.var(axis=1, ddof=1) / per_stratum).sum()
    else:
        variance = _collapsed_variance(values[:, 0])
    return Estimate(
        float(values.mean(axis=1).sum()), float(np.sqrt(variance)), x, values.ravel() * len(start)
    )


def importance(f: Callable, sample: Callable, pdf: Callable, n: int, *, seed: int = 0) -> Estimate:
    """Samples x ~ p: the mean of f / p.

    `sample(rng, n)` draws n samples with a numpy Generator, `pdf(x)` is their density p, which must
    be positive wherever f is not 0.
    """
    import numpy as np

    _check_count(n)
    x, p = Technique(sample, pdf)._draw(np.random.default_rng(seed), n)
    return _plain(x, _evaluate(f, x, "f") / p)


@dataclass(frozen=True)
class Technique:
    """A way to draw samples: `sample(rng, n)`, and `pdf(x)`, its density."""

    sample: Callable
    pdf: Callable

    @staticmethod
    def uniform(domain) -> Technique:
        """Uniform in a box."""
        import numpy as np

        low, high = _box(domain)
        density = 1 / np.prod(high - low)

        def sample(rng, n):
            return _points(low + rng.random((n, len(low))) * (high - low), domain)

        def pdf(x):
            x = np.asarray(x).reshape(len(x), -1)
            return np.where(((x >= low) & (x <= high)).all(axis=1), density, 0.0)

        return Technique(sample, pdf)

    def _draw(self, rng, n: int):
        import numpy as np

        x = np.asarray(self.sample(rng, n), dtype=float)
        if x.shape[:1] != (n,) or x.ndim > 2:
            raise _core.UsageError(f"sample(rng, {n}) returned an array of the shape {x.shape}")
        p = _evaluate(self.pdf, x, "pdf")
        if not (p > 0).all():
            raise _core.UsageError(
                f"pdf is {p.min():.6g} at x = {x[p.argmin()]}, which sample has drawn"
            )
        return x, p


# ---- several techniques (Veach & Guibas 1995; Veach 1997, sec. 9.2) -----------------------------


def balance(q):
    """w_i = q_i / sum of all q_j."""
    return q / q.sum(axis=0)


def power(q, beta: float = 2.0):
    """w_i = q_i^beta / sum of all q_j^beta."""
    scaled = (q / q.max(axis=0)) ** beta
    return scaled / scaled.sum(axis=0)


def cutoff(q, alpha: float = 0.1):
    """As balance, but among those with q_i >= alpha max q_j."""
    import numpy as np

    kept = np.where(q >= alpha * q.max(axis=0), q, 0.0)
    return kept / kept.sum(axis=0)


def maximum(q):
    """All weight to the technique with the largest q_i."""
    import numpy as np

    return (np.arange(len(q))[:, None] == q.argmax(axis=0)).astype(float)


HEURISTICS = {"balance": balance, "power": power, "cutoff": cutoff, "maximum": maximum}


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
        _check_count(count, "each of counts")
    weigh = _heuristic(heuristic)
    rng = np.random.default_rng(seed)
    estimate, variance, samples, contributions = 0.0, 0.0, [], []
    for i, (technique, count) in enumerate(zip(techniques, counts, strict=True)):
        x, p = technique._draw(rng, count)
        q = np.stack(
            [c * _evaluate(t.pdf, x, "pdf") for t, c in zip(techniques, counts, strict=True)]
        )
        values = _evaluate(f, x, "f")
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


# ---- shared -------------------------------------------------------------------------------------


def _plain(x, values) -> Estimate:
    import numpy as np

    error = values.std(ddof=1) / np.sqrt(len(values))
    return Estimate(float(values.mean()), float(error), x, values)


def _collapsed_variance(values) -> float:
    """One value per stratum: neighbours as if they were two samples of one ("collapsed strata")."""
    import numpy as np

    if len(values) < 2:
        return float("nan")
    difference = np.diff(values)
    return float((difference**2).mean() / 2 * len(values))


def _box(domain):
    import numpy as np

    box = np.atleast_2d(np.asarray(domain, dtype=float))
    if box.ndim != 2 or box.shape[1] != 2 or not np.isfinite(box).all():
        raise _core.UsageError("the domain must be (low, high), or a list of these, and finite")
    if not (box[:, 0] < box[:, 1]).all():
        raise _core.UsageError(f"the domain {domain} is empty: low must be below high")
    return box[:, 0], box[:, 1]


def _points(x, domain):
    """Without an axis for dimensions if the domain is a single interval."""
    import numpy as np

    return x[:, 0] if np.ndim(domain) == 1 else x


def _edges(low, high, n, strata, per_stratum):
    """The edges of the intervals in each dimension."""
    import numpy as np

    d = len(low)
    if (n is None) == (strata is None):
        raise _core.UsageError("stratified needs either n or strata")
    if strata is None:
        _check_count(n)
        strata = max(1, round((n / per_stratum) ** (1 / d)))
    if np.ndim(strata) == 0:
        given = [strata] * d
    elif d == 1:
        given = [strata]
    else:
        given = list(strata)
    if len(given) != d:
        raise _core.UsageError(f"strata for {len(given)} dimensions, but the domain has {d}")
    edges = []
    for a, b, s in zip(low, high, given, strict=True):
        if np.ndim(s) == 0:
            _check_count(s, "strata", 1)
            edges.append(np.linspace(a, b, s + 1))
            continue
        e = np.asarray(s, dtype=float)
        if e.ndim != 1 or len(e) < 2 or not (np.diff(e) > 0).all() or e[0] != a or e[-1] != b:
            raise _core.UsageError(f"the edges of strata must ascend from {a:g} to {b:g}")
        edges.append(e)
    return edges


def _check_count(n, name: str = "n", least: int = 2) -> None:
    if int(n) != n or n < least:
        raise _core.UsageError(f"{name} must be an integer of {least} or more, not {n!r}")


def _evaluate(function: Callable, x, name: str):
    """One finite number for each sample."""
    import numpy as np

    values = np.asarray(function(x), dtype=float)
    if values.shape != x.shape[:1]:
        raise _core.UsageError(
            f"{name} must return one value for each of {len(x)} samples, but its result has the "
            f"shape {values.shape}; functions take numpy arrays"
        )
    if not np.isfinite(values).all():
        j = int(np.flatnonzero(~np.isfinite(values))[0])
        raise _core.UsageError(f"{name} is {values[j]} at x = {x[j]}")
    return values
