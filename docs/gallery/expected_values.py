"""
Expected values
===============

The basic algorithm keeps one sample a step: the state that was chosen. Its choice by a random
number is noise that one can do without: record both states, the proposal with weight a and the
present state with weight 1 - a. The mean is the same. Where f is small, proposals are mostly
rejected, and the basic algorithm has hardly a sample there; the extended one keeps every proposal.
"""

import matplotlib.pyplot as plt
import numpy as np

from pymlt.lab import gallery, metropolis

gallery.style()

# An "image" of ten pixels whose brightness spans three decades.
brightness = np.geomspace(1, 1000, 10)
f = metropolis.Table(brightness)
move = metropolis.Discrete(np.full(10, 0.1))
CHAINS, STEPS = 2000, 500
start = np.random.default_rng(1).choice(10, CHAINS, p=brightness / brightness.sum())


def pixels(expected_values):
    """The share of each pixel in each chain."""
    run = metropolis.run(f, move, start, STEPS, chains=CHAINS, expected_values=expected_values)
    of_chain = np.broadcast_to(np.arange(CHAINS)[:, None], run.samples.shape)
    shares = np.zeros((CHAINS, 10))
    np.add.at(shares, (of_chain.ravel(), run.samples.ravel()), run.weights.ravel())
    return shares / STEPS


truth = brightness / brightness.sum()
basic, extended = pixels(False), pixels(True)
print("mean, relative to the truth:")
for name, shares in (("basic", basic), ("extended", extended)):
    print(f"{name:9}", np.round(shares.mean(axis=0) / truth, 3))

# %%
# Ten chains of 500 steps, and the noise of 2000.

figure, axes = plt.subplots(1, 3, figsize=(11, 3.9))
for ax, shares, color, name in (
    (axes[0], basic, gallery.BLUE, "basic: one sample a step"),
    (axes[1], extended, gallery.ORANGE, "extended: two, weights a and 1 − a"),
):
    shown = np.where(shares[:10] > 0, shares[:10], 1.3e-4)
    jitter = np.linspace(-0.25, 0.25, 10)[:, None]
    ax.semilogy(np.arange(10) + jitter, shown, ".", color=color, alpha=0.7)
    ax.step(np.arange(-0.5, 10), np.r_[truth, truth[-1]], where="post", color="black", lw=1)
    ax.set(title=name, xlabel="pixel", ylim=(1e-4, 2), xticks=range(0, 10, 3))
    ax.text(
        9.5, 1.3e-4, "← no sample at all", ha="right", va="center", fontsize=8, color=gallery.GREY
    )
axes[0].set_ylabel("share of the samples")
for shares, color, name in ((basic, gallery.BLUE, "basic"), (extended, gallery.ORANGE, "extended")):
    axes[2].semilogy(shares.std(axis=0) / truth, "o-", color=color, label=name)
axes[2].set(title="Relative noise of a chain", xlabel="pixel, from dark to bright")
axes[2].legend()
plt.show()
