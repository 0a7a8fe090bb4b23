"""
Two mutations and their mixture
===============================

The target is f(x) = (x - 1/2)^2 on [0, 1]. mutate_1 proposes anywhere, uniformly. mutate_2 moves a
little, x + 0.1 (u - 1/2). The first one is rejected often and repeats itself; the second one cannot
cross the middle, where f is 0, and stays in its branch. The mixture takes mutate_1 in 10 % of the
steps: it sees both branches, and its small moves fill in the detail.
"""

import matplotlib.pyplot as plt
import numpy as np

from pymlt.lab import gallery, metropolis

gallery.style()

f = metropolis.Parabola()
mutations = {
    "mutate_1: uniform": metropolis.Uniform(0, 1),
    "mutate_2: x + 0.1 (u − ½)": metropolis.RandomWalk(0.1),
    "10 % / 90 % mixture": [(metropolis.Uniform(0, 1), 0.1), (metropolis.RandomWalk(0.1), 0.9)],
}
colors = [gallery.BLUE, gallery.ORANGE, gallery.GREEN]
STEPS, CHAINS, BINS = 30_000, 16, 500
runs = {
    name: metropolis.run(f, moves, 0.9, STEPS, chains=CHAINS) for name, moves in mutations.items()
}
for name, run in runs.items():
    print(f"{name:26} mean acceptance {run.acceptance:.2f}, mean of x {run.mean():.3f}")

# %%
# How far is a histogram of n samples from the truth? Three answers: its share of the left branch;
# its detail, the difference between neighbouring fine bins; and all of it. What is slow about
# mutate_1 is the detail, and the more so the sharper the target is: dashed lines are for
# (2x - 1)^32, where it is rejected in 19 of 20 steps. In a picture, detail is what one sees.

edges = np.linspace(0, 1, BINS + 1)
counts = np.unique(np.geomspace(100, STEPS, 14).astype(int))


def errors(run, power):
    """RMS errors over chains: of the left half, of neighbouring bins, and of all bins."""
    u = 2 * edges - 1
    truth = np.maximum(np.diff(np.sign(u) * np.abs(u) ** (power + 1)) / 2, 1e-12)
    found = []
    for n in counts:
        h = np.stack([np.histogram(chain[:n], edges)[0] / n for chain in run.samples])
        scaled = ((h - truth) / np.sqrt(truth))[:, truth > 1e-5]
        left = h[:, : BINS // 2].sum(axis=1) - 0.5
        detail = np.diff(scaled, axis=1)
        found.append([np.mean(e**2) for e in (left, detail)] + [np.sum(scaled**2) / CHAINS])
    return np.sqrt(found).T


def sharp(x):
    return np.where((x >= 0) & (x <= 1), (2 * x - 1) ** 32, 0)


figure, axes = plt.subplots(3, 3, figsize=(11, 8.6), height_ratios=[1, 1, 1.35])
x = np.linspace(0, 1, 400)
for column, ((name, run), color) in enumerate(zip(runs.items(), colors, strict=True)):
    top, middle = axes[0, column], axes[1, column]
    top.hist(run.samples[0], 100, range=(0, 1), density=True, color=color, alpha=0.6)
    top.plot(x, 12 * (x - 0.5) ** 2, color="black", lw=1)
    top.set(title=name, ylim=(0, 7), xlabel="x")
    middle.plot(run.states[0][:600], np.arange(600), color=color, lw=0.8)
    middle.set(xlim=(0, 1), xlabel="x", ylabel="step" if column == 0 else "")

measures = ("Share of the left branch", "Detail: neighbouring bins", "The whole histogram")
for (name, run), color in zip(runs.items(), colors, strict=True):
    for ax, error in zip(axes[2], errors(run, 2), strict=True):
        ax.loglog(counts, error, "o-", ms=3, color=color, label=name.split(":")[0])
for name, color in (("mutate_1: uniform", gallery.BLUE), ("10 % / 90 % mixture", gallery.GREEN)):
    run = metropolis.run(sharp, mutations[name], 0.95, STEPS // 3, chains=CHAINS, vectorized=True)
    detail = errors(run, 32)[1][counts <= STEPS // 3]
    axes[2, 1].loglog(counts[counts <= STEPS // 3], detail, "--", color=color, lw=1)
for ax, measure in zip(axes[2], measures, strict=True):
    ax.set(title=measure, xlabel="steps", ylabel="RMS error" if ax is axes[2, 0] else "")
axes[2, 0].legend(fontsize=9)
plt.show()
