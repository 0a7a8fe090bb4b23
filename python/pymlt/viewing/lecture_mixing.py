"""How soon a chain comes everywhere: the lecture's examples, as functions of what a slider sets."""

from __future__ import annotations

from ..lab import metropolis
from .lecture_chains import STEPS, histogram
from .lecture_chart import Chart, Curve, Shown


def ergodicity(gap: float, uniform: float, bridge: float) -> Shown:
    """Two islands, f in the gap between them, and steps of up to 0.1 either way."""
    import numpy as np

    left, right = 0.4 - gap / 2, 0.4 + gap / 2
    moves = [(metropolis.RandomWalk(0.2), 1 - uniform), (metropolis.Uniform(0, 1), uniform)]

    def f(x):
        land = np.where((x > left) & (x < right), bridge, 1.0)
        return np.where((x >= 0) & (x <= 1), land, 0.0)

    run = metropolis.run(f, moves, 0.1, 4000, seed=1)
    x = np.asarray(run.states)
    area = 1 - gap * (1 - bridge)
    there, truth = float((x > 0.4).mean()), (1 - right + bridge * gap / 2) / area
    crossings = int((np.diff(x > 0.4)).sum())
    text = (
        f"{100 * there:.0f} % of the samples are on the right, and should be {100 * truth:.0f} %; "
        f"the chain has crossed {crossings} times. "
    )
    text += (
        "Over a bridge it is ergodic, and mixes the worse the lower the bridge is: for a long time "
        "its error is that of a few samples."
        if bridge
        else "A gap of more than 0.1 cannot be crossed by these steps at all: without a uniform "
        "proposal now and then the chain is not ergodic, and nothing in its samples says so."
    )
    steps = np.arange(len(x), dtype=float)
    shores = [Curve("gap from", 0 * x + left), Curve("gap to", 0 * x + right)]
    return Shown(
        text,
        [
            Chart("x by step", steps, [Curve("x", x, True), *shores], (0, 1)),
            histogram(run.samples, "f / ∫ f", lambda at: f(at) / area),
        ],
    )


def adaptivity(decay: float, rate: float) -> Shown:
    """A walk that learns its size, on a narrow peak upon a broad hill."""
    from math import erf, sqrt

    import numpy as np

    f = metropolis.Normals([0, 0], [0.03, 1], [0.5, 0.5])
    walk = metropolis.AdaptiveWalk(1, "normal", rate=rate, decay=decay)
    run = metropolis.run(f, walk, 0.0, STEPS, chains=8, seed=1)
    states = np.asarray(run.states)
    truth = 0.5 * erf(3 / sqrt(2)) + 0.5 * erf(0.09 / sqrt(2))
    shares = (np.abs(states) < 0.09).mean(axis=0).cumsum() / np.arange(1, STEPS + 1)
    text = (
        f"After each step the size grows or shrinks by up to rate · i^-decay. {STEPS} steps, mean "
        f"acceptance {run.acceptance:.2f}, whatever the decay is. The peak has "
        f"{100 * shares[-1]:.1f} % of the samples and should have {100 * truth:.1f} %: with a "
        "decay of 0 the walk never stops to learn, is no Markov chain with the target f, and "
        "stays wrong."
    )
    at = np.arange(0, STEPS, 50)
    curves = [Curve("samples", shares[at]), Curve("truth", np.full(len(at), truth))]
    return Shown(text, [Chart("Share of the peak, by step", at.astype(float), curves, (0, 1))])


def acceptance(log_size: float) -> Shown:
    """A random walk on a normal density: how far to move?"""
    import numpy as np

    size = 10.0**log_size
    walk = metropolis.RandomWalk(size, "normal")
    starts = np.random.default_rng(1).normal(size=8)
    run = metropolis.run(metropolis.Normals([0], [1]), walk, starts, STEPS, chains=8, seed=1)
    correlation = metropolis.autocorrelation(run.states, 2000)
    sums = 2 * np.cumsum(correlation) - 1
    steps = float(sums[np.argmax(np.arange(len(sums)) >= 5 * sums)])  # Sokal (1997)
    text = (
        f"Size {size:.3g}: mean acceptance {run.acceptance:.2f}, and about {max(steps, 1):.0f} "
        "steps for one independent sample. Steps that are too small are nearly always accepted: "
        "the samples hardly differ; large ones are rejected, and the samples repeat themselves."
    )
    lags = np.arange(61.0)
    first = np.arange(400.0)
    return Shown(
        text,
        [
            Chart(
                "x in the first 400 steps",
                first,
                [Curve("x", np.asarray(run.states)[0, :400])],
                (-4, 4),
            ),
            Chart(
                "Correlation of samples, by the steps between", lags, [Curve("ρ", correlation[:61])]
            ),
        ],
    )
