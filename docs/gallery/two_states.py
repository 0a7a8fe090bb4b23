"""
Two states
==========

The smallest example: the states are a and b, f(a) = 9 and f(b) = 1, so that a chain should spend
9/10 of its time in a. With a fair coin as proposal, q = 1/2, the step from a to b is accepted with
probability 1/9 and every other one always. With the proposal q = (9/10, 1/10), which is the target
itself, every acceptance is 1.
"""

import matplotlib.pyplot as plt
import numpy as np

from pymlt.lab import gallery, metropolis

gallery.style()

f = metropolis.Table([9, 1])
proposals = {"q = 1/2": [1 / 2, 1 / 2], "q = (9/10, 1/10)": [9 / 10, 1 / 10]}
tables = {name: metropolis.detailed_balance([9, 1], T, "ab") for name, T in proposals.items()}

# %%
# Detailed balance, written out: as much goes from a to b as from b to a.

for name, table in tables.items():
    print(name, table, f"balanced: {table.holds()}", "", sep="\n")

# %%
# 20 000 chains from each state: how likely are they in a after so many steps? With the better
# proposal the first step already forgets where it came from.

figure, axes = plt.subplots(1, 3, figsize=(11, 3.8), width_ratios=[1, 1, 1.5])
for ax, (name, table) in zip(axes, tables.items(), strict=False):
    ax.imshow(table.flow, cmap="Blues", vmin=0, vmax=14)
    for i in range(2):
        for j in range(2):
            text = (
                f"q = {table.T[i, j]:.1f}\na = {table.a[i, j]:.3g}\nf q a = {table.flow[i, j]:.3g}"
            )
            ax.text(j, i, text, ha="center", va="center")
    ax.set(xticks=[0, 1], yticks=[0, 1], xticklabels="ab", yticklabels="ab", title=name)
    ax.set(xlabel="to", ylabel="from")
    ax.grid(False)

steps = np.arange(13)
ax = axes[2]
for (name, table), color in zip(tables.items(), (gallery.BLUE, gallery.ORANGE), strict=True):
    for start in (0, 1):
        exact = [np.linalg.matrix_power(table.K, n)[start, 0] for n in steps]
        ax.plot(steps, exact, color=color, lw=1, label=name if start == 0 else None)
        run = metropolis.run(
            f, metropolis.Discrete(table.T), start, len(steps) - 1, chains=20_000, seed=start
        )
        share = np.r_[start == 0, (run.states == 0).mean(axis=0)]
        ax.plot(steps, share, "o", color=color, ms=4)
ax.axhline(0.9, color="black", lw=0.8, ls="--")
ax.text(12, 0.88, "9/10", ha="right", va="top")
ax.set(xlabel="steps", title="Share of chains in a (dots: 20 000 runs)", ylim=(-0.03, 1.03))
ax.legend(loc="lower right")
plt.show()
