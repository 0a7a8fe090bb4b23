"""
Where to start
==============

A chain remembers where it started. Throwing its first samples away helps, but nobody knows how many
are enough. Better: draw candidates x from a known density p, and start chains from candidates that
are chosen in proportion to f(x) / p(x). The mean of f / p estimates b, the integral of f. Then b
times what the chains record is right in the mean from the very first step (Veach & Guibas 1997).

Or let chains start over and over, and end by chance: then what they record needs no b.
"""

import matplotlib.pyplot as plt
import numpy as np

from pymlt.lab import gallery, metropolis

gallery.style()

f = metropolis.Parabola()
moves = [(metropolis.Uniform(0, 1), 0.02), (metropolis.RandomWalk(0.1), 0.98)]
CHAINS, STEPS = 20_000, 200


def uniform(rng, n):
    return rng.random(n)


def one(x):
    return np.ones(len(x))


# Many small bootstraps of 32 candidates for 4 chains each, as independent experiments.
starts = [
    metropolis.bootstrap(f, uniform, one, candidates=32, chains=4, seed=s)
    for s in range(CHAINS // 4)
]
b = np.repeat([start.b for start in starts], 4)
resampled = np.concatenate([start.starts for start in starts])
print(f"b: {np.mean(b):.5f} in the mean; the integral is {1 / 12:.5f}")

ways = {
    "all chains from x = 0.6": (np.full(CHAINS, 0.6), 1 / 12),
    "from uniform candidates": (np.random.default_rng(2).random(CHAINS), 1 / 12),
    "from candidates resampled by f / p": (resampled, b[:, None]),
}

# %%
# What is estimated is the integral of g f with ``g(x) = |x - 1/2|``, that is 1/32. The lines are
# means of 20 000 chains after each step; the dashed lines, of all steps up to there.

figure = plt.figure(figsize=(11, 7.6))
above, below = figure.subfigures(2, 1, height_ratios=[1.3, 1])
left, right = above.subplots(1, 2, width_ratios=[1, 1.4])
left.set(xlabel="x", title="Where chains are at step 0 and after 200", yticks=[])
left.grid(False)
x = np.linspace(0, 1, 300)
for row, ((name, (x0, scale)), color) in enumerate(
    zip(ways.items(), (gallery.RED, gallery.ORANGE, gallery.GREEN), strict=True)
):
    run = metropolis.run(f, moves, x0, STEPS, chains=CHAINS, seed=row)
    for states, alpha in ((x0, 0.3), (run.states[:, -1], 0.7)):
        h, edges = np.histogram(states, 50, (0, 1), density=True)
        left.stairs(
            np.minimum(h, 4) + 4.8 * (2 - row),
            edges,
            baseline=4.8 * (2 - row),
            fill=True,
            color=color,
            alpha=alpha,
            lw=0,
        )
    left.plot(x, 12 * (x - 0.5) ** 2 + 4.8 * (2 - row), color="black", lw=0.8)
    g = scale * np.abs(np.column_stack([x0, run.states]) - 0.5)
    each = g.mean(axis=0)
    right.plot(each, color=color, label=name)
    right.plot(np.cumsum(each) / np.arange(1, STEPS + 2), color=color, lw=1, ls="--")
right.axhline(1 / 32, color="black", lw=0.8)
right.set(xlabel="step", title="Estimate of the integral of |x − ½| f(x)", ylim=(0.012, 0.034))
right.legend(loc="lower right")

# %%
# Tours start from uniform samples, too, and die in each state with a probability that p / f tells:
# soon where f is small. The states after their steps have the density f, however long they are.

for axis, length in zip(below.subplots(1, 3, sharey=True), (0.3, 3, 30), strict=True):
    tours = metropolis.tours(f, moves, uniform, one, int(60_000 / length), steps=length, seed=1)
    axis.hist(tours.states, 50, range=(0, 1), density=True, color=gallery.GREEN, alpha=0.7)
    axis.plot(x, 12 * (x - 0.5) ** 2, color="black", lw=0.8)
    found = tours.estimate(lambda x: np.abs(x - 0.5))
    axis.set(xlabel="x", title=f"{length:g} steps from each sample")
    print(f"{length:g} steps: {found.estimate:.5f} ± {found.standard_error:.5f}; {1 / 32:.5f}")
plt.show()
