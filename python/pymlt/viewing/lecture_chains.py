"""The lecture's examples of chains and their starts as functions of what a slider sets; all chains
are those of `pymlt.lab.metropolis`, whose kernel renders.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ..lab import metropolis
from .lecture_chart import Chart, Curve, Shown

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
    title = "Share of 4000 chains in a, by step"
    return Shown(text, [Chart(title, steps.astype(float), curves, (0, 1))])


def recording(decades: float) -> Shown:
    """Ten states whose f spans so many decades; a uniform proposal, recorded in both ways."""
    import numpy as np

    f, chains, steps = np.geomspace(1, 10**decades, 10), 500, 500
    truth = f / f.sum()
    noise = []
    for expected_values in (False, True):
        run = metropolis.run(
            metropolis.Table(f),
            metropolis.Discrete(np.full(10, 0.1)),
            np.random.default_rng(1).choice(10, chains, p=truth),
            steps,
            chains=chains,
            expected_values=expected_values,
        )
        shares = np.zeros((chains, 10))
        chain = np.broadcast_to(np.arange(chains)[:, None], run.samples.shape)
        np.add.at(shares, (chain, run.samples), run.weights / steps)
        noise.append(shares.std(axis=0) / truth)
    gain = noise[1] / noise[0]
    text = (
        f"{chains} chains of {steps} steps. Recorded by both states, the darkest has {gain[0]:.2f} "
        f"and the brightest {gain[-1]:.2f} of the noise. Where f is small nearly all proposals are "
        "rejected, and the basic recording forgets them."
    )
    curves = [Curve("basic", np.log10(noise[0])), Curve("extended", np.log10(noise[1]))]
    title = "log₁₀ of a chain's relative noise, by state from dark to bright"
    return Shown(text, [Chart(title, np.arange(10.0), curves)])


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
            Chart(
                "x in the first 400 steps",
                steps,
                [Curve("x", np.asarray(run.states)[:400])],
                (0, 1),
            ),
        ],
    )


def _beside_parabola(samples: np.ndarray) -> Chart:
    return histogram(samples, "12 (x - 1/2)²", lambda x: 12 * (x - 0.5) ** 2)


def histogram(samples: np.ndarray, name: str, density: Callable) -> Chart:
    """Of samples in [0, 1], with the density that they should have."""
    import numpy as np

    edges = np.linspace(0, 1, 51)
    middles = (edges[:-1] + edges[1:]) / 2
    found, _ = np.histogram(samples, edges, density=True)
    curves = [Curve("samples", found), Curve(name, density(middles))]
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
    return Shown(text, [Chart("Mean of x over the chains, by step", at, curves, (0, 1))])


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
