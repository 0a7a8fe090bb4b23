"""
Moves that learn
================

A move may learn its size from how its proposals fare: larger after an acceptance, smaller after a
rejection. If it learns less and less as time goes by, the chain still samples its target. If it
never stops, its size depends on where the chain has just been, this is no Markov chain with the
given target any more, and the answer is wrong, however long it runs.
"""

from math import erf, sqrt

import matplotlib.pyplot as plt
import numpy as np

from pymlt.lab import gallery, metropolis

gallery.style()

# A narrow peak on a broad hill: no single size suits both.
f = metropolis.Normals([0, 0], [0.03, 1], [0.5, 0.5])
STEPS, CHAINS = 40_000, 16
walks = {
    "diminishing: rate i^-0.6": metropolis.AdaptiveWalk(1, "normal", rate=0.3, decay=0.6),
    "never stops: rate 0.3": metropolis.AdaptiveWalk(1, "normal", rate=0.3, decay=0),
    "fixed size 0.6": metropolis.RandomWalk(0.6, "normal"),
}
runs = {
    name: metropolis.run(f, walk, 0.0, STEPS, chains=CHAINS, expected_values=True)
    for name, walk in walks.items()
}


def in_peak(x):
    return np.abs(x) < 0.09


truth = 0.5 * erf(3 / sqrt(2)) + 0.5 * erf(0.09 / sqrt(2))
print(f"share of |x| < 0.09: {truth:.4f}")
for name, run in runs.items():
    print(f"{name:26} {run.estimate(in_peak)}, acceptance {run.acceptance:.3f}")

# %%
# Both adaptive walks reach the acceptance that they aim at, 0.44: acceptance alone tells nothing.

figure, axes = plt.subplots(1, 3, figsize=(11, 4), width_ratios=[1.1, 1, 1.1])
colors = (gallery.GREEN, gallery.RED, gallery.GREY)
for (name, run), color in zip(runs.items(), colors, strict=True):
    if run.sizes is not None:
        axes[0].semilogy(run.sizes[0][:4000], color=color, lw=0.8, label=name)
axes[0].set(title="The size that is learnt", xlabel="step", ylim=(2e-3, 60))
axes[0].legend(loc="upper right")

edges = np.linspace(-0.3, 0.3, 61)
centre = (edges[1:] + edges[:-1]) / 2
for run, color in zip(list(runs.values())[:2], colors, strict=False):
    h = np.histogram(run.samples, edges, weights=run.weights)[0]
    axes[1].stairs(h / run.weights.sum() / np.diff(edges), edges, color=color, lw=1.5)
axes[1].plot(centre, f(centre), color="black", lw=1, label="target")
axes[1].set(title="Histogram", xlabel="x", xlim=(-0.3, 0.3))
axes[1].legend()

steps = np.unique(np.geomspace(200, STEPS, 15).astype(int))
for (name, run), color in zip(runs.items(), colors, strict=True):
    inside = np.cumsum(in_peak(run.samples) * run.weights, axis=1)
    off = inside[:, 2 * steps - 1] / steps - truth
    axes[2].loglog(steps, np.sqrt((off**2).mean(axis=0)), "o-", ms=3, color=color, label=name)
axes[2].set(title="RMS error of the share of the peak", xlabel="steps")
axes[2].legend(loc="lower left")
plt.show()
