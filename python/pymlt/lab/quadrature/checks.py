"""What users give, checked: domains, counts, functions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from ... import _core


def box(domain):
    import numpy as np

    box = np.atleast_2d(np.asarray(domain, dtype=float))
    if box.ndim != 2 or box.shape[1] != 2 or not np.isfinite(box).all():
        raise _core.UsageError("the domain must be (low, high), or a list of these, and finite")
    if not (box[:, 0] < box[:, 1]).all():
        raise _core.UsageError(f"the domain {domain} is empty: low must be below high")
    return box[:, 0], box[:, 1]


def points(x, domain):
    """Without an axis for dimensions if the domain is a single interval."""
    import numpy as np

    return x[:, 0] if np.ndim(domain) == 1 else x


def check_count(n, name: str = "n", least: int = 2) -> None:
    if int(n) != n or n < least:
        raise _core.UsageError(f"{name} must be an integer of {least} or more, not {n!r}")


def evaluate(function: Callable, x, name: str):
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


def check_density(pdf: Callable, x) -> None:
    """Refuse a pdf that does not integrate to 1 over where its samples x are, or not as they do.

    Looks only in up to three dimensions, at 256 samples or more. The mass beyond the outermost
    samples is below 20 / n on each side, but for one case in 10^8. The samples are compared with
    the pdf in the halves, quarters and eighths that hold equally many of them.
    """
    import numpy as np

    n, dimensions = x.shape[0], 1 if x.ndim == 1 else x.shape[1]
    if n < 256 or dimensions > 3:
        return
    cells = _cells_among(pdf, x)
    integral, error = cells.mass.sum(), np.sqrt(cells.variance.sum())
    margin = 40 * dimensions / n + 0.02
    if abs(integral - 1) > 6 * error + margin:
        raise _core.UsageError(
            f"pdf integrates to {integral:.3g} over the samples' domain; a density integrates to 1"
        )
    for level in (1, 2, 3):
        for part in np.array_split(np.arange(len(cells.mass)), 2**level):
            share, mass = cells.share[part].sum(), cells.mass[part].sum()
            error = np.sqrt(cells.variance[part].sum() + share * (1 - share) / n)
            if abs(mass - share) > 6 * error + margin:
                low, high = cells.low[part].min(axis=0), cells.high[part].max(axis=0)
                where = " x ".join(f"[{a:.4g}, {b:.4g}]" for a, b in zip(low, high, strict=True))
                raise _core.UsageError(
                    f"sample does not draw from pdf: {100 * share:.3g} % of {n} samples lie in "
                    f"{where}, where pdf has {100 * mass:.3g} % of its integral"
                )


class _Cells(NamedTuple):
    """Boxes that hold about equally many samples: each next to those that it was cut from."""

    low: Any
    high: Any
    share: Any  # of the samples
    mass: Any  # the integral of the pdf
    variance: Any  # of this estimate of the integral


def _cells_among(pdf: Callable, x) -> _Cells:
    """The integrals of a density over the parts of the box around samples x.

    Halves of equal numbers of samples cut the box into cells that hold about the same mass each,
    where uniform samples are good. Where pdf is not finite it counts as 0.
    """
    import numpy as np

    rng, per_cell = np.random.default_rng(0), 4
    samples = x.reshape(len(x), -1)
    cells = [(samples.min(axis=0), samples.max(axis=0), samples)]
    for level in range(min(8, int(np.log2(len(x) / 16)))):
        cells = [half for cell in cells for half in _halves(*cell, level % samples.shape[1])]
    low, high = (np.array([cell[i] for cell in cells])[:, None] for i in (0, 1))
    u = rng.random((len(cells), per_cell, samples.shape[1]))
    at = (low + u * (high - low)).reshape(-1, samples.shape[1])
    with np.errstate(all="ignore"):
        values = np.asarray(pdf(at[:, 0] if x.ndim == 1 else at), dtype=float)
    values = np.where(np.isfinite(values), values, 0).reshape(len(cells), per_cell)
    parts = values * (high - low).prod(axis=2)
    share = np.array([len(cell[2]) for cell in cells]) / len(x)
    return _Cells(
        low[:, 0], high[:, 0], share, parts.mean(axis=1), parts.var(axis=1, ddof=1) / per_cell
    )


def _halves(low, high, samples, axis: int):
    """A cell cut where as many of its samples lie on either side."""
    import numpy as np

    middle = np.median(samples[:, axis])
    below = samples[:, axis] < middle
    end, begin = high.copy(), low.copy()
    end[axis] = begin[axis] = middle
    return (low, end, samples[below]), (begin, high, samples[~below])
