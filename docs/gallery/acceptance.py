"""
How far to move
===============

A random walk on a normal density. Tiny steps are nearly always accepted, and each sample is nearly
the one before; giant steps are nearly always rejected, and each sample mostly is the one before. In
between samples are least correlated. Neither a high acceptance nor a low one is good by itself:
what counts is how many independent samples a chain is worth.
"""

import matplotlib.pyplot as plt
import numpy as np

from pymlt.lab import gallery, metropolis

gallery.style()

f = metropolis.Normals([0], [1])
SIZES = np.geomspace(0.15, 60, 20)
STEPS, CHAINS, LAGS = 20_000, 8, 3000
START = np.random.default_rng(1).normal(size=CHAINS)


def steps_per_sample(run):
    """1 + 2 times the sum of the autocorrelations, up to where noise takes over (Sokal 1997)."""
    sums = 2 * np.cumsum(metropolis.autocorrelation(run.states, LAGS)) - 1
    window = np.arange(len(sums))
    return sums[np.argmax(window >= 5 * sums)]


def chains(size):
    walk = metropolis.RandomWalk(size, "normal")
    return metropolis.run(f, walk, START, STEPS, chains=CHAINS)


runs = [chains(size) for size in SIZES]
acceptance = [run.acceptance for run in runs]
worth = [1 / steps_per_sample(run) for run in runs]
best = int(np.argmax(worth))
print(
    f"best size {SIZES[best]:.2g}: acceptance {acceptance[best]:.2f}, "
    f"{1 / worth[best]:.1f} steps for one independent sample"
)

# %%

figure, axes = plt.subplots(2, 3, figsize=(11, 6), height_ratios=[1, 1.4])
three = [
    (0.1, "too small", gallery.BLUE),
    (2.4, "about right", gallery.GREEN),
    (40, "too large", gallery.RED),
]
for ax, (size, words, color) in zip(axes[0], three, strict=True):
    run = chains(size)
    ax.plot(run.states[0][:500], color=color, lw=0.8)
    ax.set(title=f"size {size}: {words}", ylim=(-3.5, 3.5), xlabel="step")
    axes[1, 0].plot(metropolis.autocorrelation(run.states, 60), color=color, label=f"size {size}")
axes[0, 0].set_ylabel("x")
axes[1, 0].set(xlabel="steps between", title="Correlation of samples")
axes[1, 0].legend()
axes[1, 1].semilogx(SIZES, acceptance, "o-", ms=3.5)
axes[1, 1].set(xlabel="size of the move", title="Mean acceptance", ylim=(0, 1))
axes[1, 2].plot(acceptance, worth, "o-", ms=3.5)
axes[1, 2].axvline(0.44, color="black", lw=0.8, ls="--")
axes[1, 2].text(0.45, 0.01, "0.44", va="bottom")
axes[1, 2].set(xlabel="mean acceptance", title="Independent samples per step", xlim=(0, 1))
axes[1, 2].set_ylim(bottom=0)
plt.show()
