"""Quadrature by one kind of samples: uniform, stratified, or from a density (Veach 1997, ch. 2)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from ... import _core
from .checks import box, check_count, evaluate, points
from .technique import Technique, draw


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


def naive(f: Callable, domain, n: int, *, seed: int = 0) -> Estimate:
    """n samples, uniform in the domain: the mean of f times the volume."""
    import numpy as np

    low, high = box(domain)
    check_count(n)
    u = np.random.default_rng(seed).random((n, len(low)))
    x = points(low + u * (high - low), domain)
    values = evaluate(f, x, "f") * np.prod(high - low)
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

    low, high = box(domain)
    check_count(per_stratum, "per_stratum", 1)
    edges = _edges(low, high, n, strata, per_stratum)
    widths = [np.diff(e) for e in edges]
    grid = np.stack(
        [g.ravel() for g in np.meshgrid(*map(np.arange, map(len, widths)), indexing="ij")]
    )
    start = np.stack([e[i] for e, i in zip(edges, grid, strict=True)], axis=1)
    width = np.stack([w[i] for w, i in zip(widths, grid, strict=True)], axis=1)
    u = np.random.default_rng(seed).random((len(start), per_stratum, len(low)))
    x = start[:, None] + u * width[:, None]
    x = points(x.reshape(-1, len(low)), domain)
    measure = width.prod(axis=1)
    values = evaluate(f, x, "f").reshape(len(start), per_stratum) * measure[:, None]
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
    be positive wherever f is not 0. Raises UsageError where samples and pdf disagree, as far as 256
    samples or more tell, in up to three dimensions.
    """
    import numpy as np

    check_count(n)
    x, p = draw(Technique(sample, pdf), np.random.default_rng(seed), n)
    return _plain(x, evaluate(f, x, "f") / p)


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


def _edges(low, high, n, strata, per_stratum):
    """The edges of the intervals in each dimension."""
    import numpy as np

    d = len(low)
    if (n is None) == (strata is None):
        raise _core.UsageError("stratified needs either n or strata")
    if strata is None:
        check_count(n)
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
            check_count(s, "strata", 1)
            edges.append(np.linspace(a, b, s + 1))
            continue
        e = np.asarray(s, dtype=float)
        if e.ndim != 1 or len(e) < 2 or not (np.diff(e) > 0).all() or e[0] != a or e[-1] != b:
            raise _core.UsageError(f"the edges of strata must ascend from {a:g} to {b:g}")
        edges.append(e)
    return edges
