"""Metropolis as quadrature, in examples of the lecture as functions of what a slider sets: a chain
on f estimates the integrals of f g for many g at once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from ..lab import metropolis
from .lecture_chart import Chart, Curve, Shown

if TYPE_CHECKING:
    import numpy as np


def blur(log_n: float, width: float) -> Shown:
    """A row of 64 pixels, blurred by a bell of this width."""
    import numpy as np

    centres = np.arange(64) + 0.5
    row = np.full(64, 0.15)
    row[10:22], row[30], row[40:56] = 1, 4, np.linspace(0, 1.2, 16)

    def f(x):
        return np.interp(x, centres, row, left=0, right=0)

    def bells(x):
        z = (np.asarray(x)[:, None] - centres) / width
        return np.exp(-0.5 * z**2) / (width * np.sqrt(2 * np.pi))

    exact, found, _ = _by_one_chain(f, (0, 64), bells, int(10**log_n))
    error = np.sqrt(np.mean((found - exact) ** 2)) / exact.mean()
    text = (
        f"One chain of {int(10**log_n)} steps on the row gives all 64 pixels of the result, each "
        f"sample to all whose bell reaches it. The error is {100 * error:.2g} % of the mean: the "
        "wider the blur, the more samples a pixel has."
    )
    curves = [Curve("the row", row), Curve("blurred", exact), Curve("by the chain", found)]
    return Shown(text, [Chart("Brightness, by pixel", centres, curves)])


def reflection(log_n: float, log_exponent: float) -> Shown:
    """A sky with a sun in it, reflected by a surface with a lobe."""
    import numpy as np

    mirrors = np.radians(np.arange(-80, 81, 4.0))
    exponent = 2.0**log_exponent

    def sky(x):
        light = 0.3 + 8 * np.exp(-(((x - 0.7) / 0.06) ** 2)) + 1.5 * (np.abs(x + 0.6) < 0.12)
        return np.where(np.abs(x) < np.pi / 2, light, 0.0)

    def lobes(x):
        x = np.asarray(x)[:, None]
        peak = np.maximum(np.cos(x - mirrors), 0) ** exponent * np.sqrt(exponent / (2 * np.pi))
        return peak * np.cos(x)

    exact, found, run = _by_one_chain(sky, (-np.pi / 2, np.pi / 2), lobes, int(10**log_n))
    error = np.sqrt(np.mean((found - exact) ** 2)) / exact.mean()
    text = (
        f"One chain of {int(10**log_n)} steps on the sky gives the reflection for all directions "
        f"of the mirror, with an error of {100 * error:.2g} % of the mean. It goes where the sky "
        "is bright: a narrow lobe at a dark place gets few samples."
    )
    edges = np.radians(np.arange(-90, 91, 3.0))
    middles = (edges[1:] + edges[:-1]) / 2
    visited, _ = np.histogram(run, edges, density=True)
    curves = [Curve("samples", visited), Curve("L / ∫ L", sky(middles) / _integral(sky, edges))]
    reflected = [Curve("exact", exact), Curve("by the chain", found)]
    return Shown(
        text,
        [
            Chart("The sky, by angle in degrees", np.degrees(middles), curves),
            Chart("Reflected, by the angle of the mirror", np.degrees(mirrors), reflected),
        ],
    )


def _by_one_chain(
    f: Callable, domain: tuple[float, float], g: Callable, n: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The integrals of f g_j as they are, and from n samples of f; and these samples.

    g(x) has one row for each x and one column for each j.
    """
    import numpy as np

    low, high = domain
    start = metropolis.bootstrap(
        f,
        lambda rng, k: rng.uniform(low, high, k),
        lambda x: np.full(len(x), 1 / (high - low)),
        64,
        seed=1,
    )
    walk = metropolis.RandomWalk((high - low) / 12, "normal")
    moves = [(metropolis.Uniform(low, high), 0.2), (walk, 0.8)]
    samples = metropolis.run(f, moves, start.starts[0], n, seed=1).samples
    x = _grid(low, high)
    exact = (f(x)[:, None] * g(x)).mean(axis=0) * (high - low)
    return exact, _integral(f, domain) * g(samples).mean(axis=0), samples


def _integral(f: Callable, domain: Sequence[float]) -> float:
    low, high = domain[0], domain[-1]
    return float(f(_grid(low, high)).mean() * (high - low))


def _grid(low: float, high: float) -> np.ndarray:
    import numpy as np

    return low + (np.arange(4000) + 0.5) / 4000 * (high - low)
