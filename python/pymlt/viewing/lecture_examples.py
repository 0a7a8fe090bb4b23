"""The lecture's examples as functions of what a slider sets; all chains are those of
`pymlt.lab.metropolis`, whose kernel renders.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..lab import metropolis
from .lecture_chart import Chart, Curve, Example, Shown, Slider
from .lecture_quadrature import combination, integrals

if TYPE_CHECKING:
    import numpy as np

STEPS = 20_000


def two_states(fa: float, to_a: float) -> Shown:
    """f(a) : 1, and the probability of proposing a."""
    import numpy as np

    f, T = [fa, 1.0], [[to_a, 1 - to_a]] * 2
    balance = metropolis.detailed_balance(f, T, "ab")
    steps = np.arange(13)
    curves = []
    for start, name in ((0, "a"), (1, "b")):
        exact = np.array([np.linalg.matrix_power(balance.K, n)[start, 0] for n in steps])
        move = metropolis.Discrete(balance.T)
        run = metropolis.run(
            metropolis.Table(f), move, start, len(steps) - 1, chains=4000, seed=start
        )
        share = np.r_[start == 0, (run.states == 0).mean(axis=0)]
        curves += [Curve(f"from {name}, exact", exact), Curve(f"from {name}, chains", share, True)]
    goal = fa / (fa + 1)
    curves.append(Curve("target", np.full(len(steps), goal)))
    text = (
        f"a(a → b) = {balance.a[0, 1]:.3g}, a(b → a) = {balance.a[1, 0]:.3g}. As much goes from a "
        f"to b as back: f q a = {balance.flow[0, 1]:.3g} = {balance.flow[1, 0]:.3g}. In the end "
        f"{100 * goal:.3g} % of the chains are in a."
    )
    return Shown(text, [Chart("Share of 4000 chains in a, by step", steps.astype(float), curves)])


def parabola(size: float, start: float) -> Shown:
    """A random walk of this size on f(x) = (x - 1/2)^2."""
    return _on_parabola([(metropolis.RandomWalk(size), 1.0)], start)


def mixture(share: float, size: float, start: float) -> Shown:
    """The same with a uniform move in a share of the steps."""
    moves = [(metropolis.Uniform(0, 1), share), (metropolis.RandomWalk(size), 1 - share)]
    return _on_parabola(moves, start)


def _on_parabola(moves: list, start: float) -> Shown:
    import numpy as np

    run = metropolis.run(metropolis.Parabola(), moves, start, STEPS, seed=1)
    left = float((run.samples < 0.5).mean())
    text = (
        f"{STEPS} steps, mean acceptance {run.acceptance:.2f}. The left branch has "
        f"{100 * left:.1f} % of the samples, and should have 50 %."
    )
    steps = np.arange(400.0)
    return Shown(
        text,
        [
            _beside_parabola(run.samples),
            Chart("x in the first 400 steps", steps, [Curve("x", np.asarray(run.states)[:400])]),
        ],
    )


def _beside_parabola(samples: np.ndarray) -> Chart:
    import numpy as np

    edges = np.linspace(0, 1, 51)
    middles = (edges[:-1] + edges[1:]) / 2
    found, _ = np.histogram(samples, edges, density=True)
    curves = [Curve("samples", found), Curve("12 (x - 1/2)²", 12 * (middles - 0.5) ** 2)]
    return Chart("Histogram and f, normalised", middles, curves)


def start_up(start: float, size: float) -> Shown:
    """How long do chains remember a fixed start, and what does the bootstrap change?"""
    import numpy as np

    f, steps, chains = metropolis.Parabola(), 60, 4000
    moves = [(metropolis.Uniform(0, 1), 0.1), (metropolis.RandomWalk(size), 0.9)]
    fixed = metropolis.run(f, moves, start, steps, chains=chains, seed=1)
    chosen = metropolis.bootstrap(
        f, lambda rng, n: rng.random(n), lambda x: np.ones_like(x), 40_000, chains, seed=2
    )
    drawn = metropolis.run(f, moves, chosen, steps, seed=3)
    at = np.arange(steps + 1.0)
    means = [
        np.r_[first, np.asarray(run.states).mean(axis=0)]
        for run, first in ((fixed, start), (drawn, np.mean(chosen.starts)))
    ]
    text = (
        f"{chains} chains. The mean of x is 1/2. Those that all start at {start:.2f} come to it by "
        f"and by (after 5 steps {means[0][5]:.3f}, after 60 {means[0][60]:.3f}); those that start "
        f"where a bootstrap put them are right from the first step on ({means[1][0]:.3f}). It also "
        f"found b = {chosen.b:.4f}, which is 1/12 = 0.0833."
    )
    curves = [
        Curve("fixed start", means[0]),
        Curve("bootstrap", means[1]),
        Curve("truth", np.full(steps + 1, 0.5)),
    ]
    return Shown(text, [Chart("Mean of x over the chains, by step", at, curves)])


def tours(steps: float, size: float) -> Shown:
    """Chains that start over and over, from uniform samples, and end by chance."""
    import numpy as np

    moves = [(metropolis.RandomWalk(size), 1.0)]
    made = metropolis.tours(
        metropolis.Parabola(),
        moves,
        lambda rng, n: rng.random(n),
        lambda x: np.ones(len(x)),
        int(40_000 / steps),
        steps=steps,
        seed=1,
    )
    text = (
        f"From each uniform sample {steps:g} steps in the mean, and none crosses the middle if "
        "they are small. Still the states have the density f from the first one on: tours die "
        f"soon where f is small. They tell the integral of f, too: "
        f"{made.estimate(lambda x: np.ones(len(x)))}, which is 1/12 = 0.0833."
    )
    return Shown(text, [_beside_parabola(made.states)])


def ergodicity(gap: float, uniform: float) -> Shown:
    """Two islands with nothing between them, and steps of up to 0.1 either way."""
    import numpy as np

    left, right = 0.4 - gap / 2, 0.4 + gap / 2
    moves = [(metropolis.RandomWalk(0.2), 1 - uniform), (metropolis.Uniform(0, 1), uniform)]

    def f(x):
        return float(0 <= x <= left or right <= x <= 1)

    run = metropolis.run(f, moves, 0.1, 4000, seed=1)
    x = np.asarray(run.states)
    there, truth = float((x > 0.4).mean()), (1 - right) / (1 - right + left)
    crossings = int((np.diff(x > 0.4)).sum())
    text = (
        f"{100 * there:.0f} % of the samples are on the right island, and should be "
        f"{100 * truth:.0f} %; the chain has crossed {crossings} times. A gap of more than 0.1 "
        "cannot be crossed by these steps at all: without a uniform proposal now and then the "
        "chain is not ergodic, and nothing in its samples says so."
    )
    return Shown(text, [Chart("x by step", np.arange(len(x), dtype=float), [Curve("x", x, True)])])


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
    return Shown(text, [Chart("Share of the peak, by step", at.astype(float), curves)])


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
            Chart("x in the first 400 steps", first, [Curve("x", np.asarray(run.states)[0, :400])]),
            Chart(
                "Correlation of samples, by the steps between", lags, [Curve("ρ", correlation[:61])]
            ),
        ],
    )


EXAMPLES = (
    Example(
        "Quadrature",
        "Samples may be spread evenly, one or two to a stratum, or drawn where f is large.",
        (Slider("log₁₀ samples", 1, 4, 0.25, 3), Slider("k of x^k", 0.5, 6, 0.5, 2)),
        integrals,
    ),
    Example(
        "Combined sampling",
        "A lamp is reflected by a glossy surface. Where one of both is narrow, samples of the "
        "other seldom meet it; weights that sum to one take the better of both at each x.",
        (Slider("Lamp", 0.01, 1, 0.01, 0.1), Slider("Lobe", 0.01, 0.5, 0.01, 0.1)),
        combination,
    ),
    Example(
        "Two states",
        "The smallest example: f(b) = 1, and a chain should be in a by the share of f(a).",
        (Slider("f(a)", 1, 20, 0.5, 9), Slider("q(→ a)", 0.05, 0.95, 0.05, 0.5)),
        two_states,
    ),
    Example(
        "Parabola",
        "f(x) = (x - 1/2)² on [0, 1], and a move by up to half of the size either way. Small moves "
        "do not cross the middle, where f is 0.",
        (Slider("Size", 0.02, 2, 0.02, 0.1), Slider("Start", 0, 1, 0.05, 0.9)),
        parabola,
    ),
    Example(
        "Mixture",
        "The same with a uniform proposal in a share of the steps, which finds the other branch.",
        (
            Slider("Uniform", 0, 1, 0.01, 0.1),
            Slider("Size", 0.02, 2, 0.02, 0.1),
            Slider("Start", 0, 1, 0.05, 0.9),
        ),
        mixture,
    ),
    Example(
        "Start-up bias",
        "Chains that all start at one place are not yet where f is; a bootstrap puts them there.",
        (Slider("Start", 0, 1, 0.05, 0.9), Slider("Size", 0.02, 1, 0.02, 0.1)),
        start_up,
    ),
    Example(
        "Tours",
        "Chains that start over and over and end by chance: no start is left to be forgotten.",
        (Slider("Steps", 0.2, 40, 0.2, 4), Slider("Size", 0.02, 1, 0.02, 0.1)),
        tours,
    ),
    Example(
        "Acceptance",
        "How far should a random walk on a normal density move?",
        (Slider("log₁₀ size", -1, 1.8, 0.1, 0.4),),
        acceptance,
    ),
    Example(
        "Adaptivity",
        "A random walk that learns its size: less and less, or for ever?",
        (Slider("Decay", 0, 1, 0.1, 0), Slider("Rate", 0.05, 1, 0.05, 0.3)),
        adaptivity,
    ),
    Example(
        "Ergodicity",
        "f is 1 on two islands and 0 in the gap between them. Does the chain come across?",
        (Slider("Gap", 0.02, 0.5, 0.02, 0.3), Slider("Uniform", 0, 0.3, 0.01, 0)),
        ergodicity,
    ),
)
