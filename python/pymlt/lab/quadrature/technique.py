"""A way to draw samples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ... import _core
from .checks import box, check_density, evaluate, points


@dataclass(frozen=True)
class Technique:
    """A way to draw samples: `sample(rng, n)`, and `pdf(x)`, its density."""

    sample: Callable
    pdf: Callable

    @staticmethod
    def uniform(domain) -> Technique:
        """Uniform in a box."""
        import numpy as np

        low, high = box(domain)
        density = 1 / np.prod(high - low)

        def sample(rng, n):
            return points(low + rng.random((n, len(low))) * (high - low), domain)

        def pdf(x):
            x = np.asarray(x).reshape(len(x), -1)
            return np.where(((x >= low) & (x <= high)).all(axis=1), density, 0.0)

        return Technique(sample, pdf)


def draw(technique: Technique, rng, n: int):
    """n samples and their densities."""
    import numpy as np

    x = np.asarray(technique.sample(rng, n), dtype=float)
    if x.shape[:1] != (n,) or x.ndim > 2:
        raise _core.UsageError(f"sample(rng, {n}) returned an array of the shape {x.shape}")
    p = evaluate(technique.pdf, x, "pdf")
    if not (p > 0).all():
        raise _core.UsageError(
            f"pdf is {p.min():.6g} at x = {x[p.argmin()]}, which sample has drawn"
        )
    check_density(technique.pdf, x)
    return x, p
