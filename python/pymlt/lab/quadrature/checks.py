"""What users give, checked: domains, counts, functions."""

from __future__ import annotations

from collections.abc import Callable

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
