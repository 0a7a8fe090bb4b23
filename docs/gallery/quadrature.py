"""
Four ways to integrate
======================

The integral of f(x) = 4 sqrt(1 - x^2) over [0, 1] is pi. Uniform samples have an error that falls
with the square root of their number, whatever is done to constants. Jittered samples, one or two in
each of many small intervals, do better as long as f is smooth. Importance sampling with a density
that looks like f lowers the constant. Combining two techniques is safe if one of them is bad.
"""

import matplotlib.pyplot as plt
import numpy as np

from pymlt.lab import gallery, quadrature

gallery.style()


def f(x):
    return 4 * np.sqrt(1 - x**2)


# A straight line that falls from 3/2 to 1/2 is a density that looks a little like f.
def sample_line(rng, n):
    return (3 - np.sqrt(9 - 8 * rng.random(n))) / 2


def line_pdf(x):
    return 1.5 - x


uniform = quadrature.Technique.uniform((0, 1))
line = quadrature.Technique(sample_line, line_pdf)
methods = {
    "naive": lambda n, seed: quadrature.naive(f, (0, 1), n, seed=seed),
    "importance, p a line": lambda n, seed: quadrature.importance(
        f, sample_line, line_pdf, n, seed=seed
    ),
    "combined, half uniform": lambda n, seed: quadrature.combined(
        f, [uniform, line], n // 2, seed=seed
    ),
    "stratified, 2 in each": lambda n, seed: quadrature.stratified(f, (0, 1), n, seed=seed),
    "stratified, 1 in each": lambda n, seed: quadrature.stratified(
        f, (0, 1), n, per_stratum=1, seed=seed
    ),
}

# %%
# Each method says how far off it expects to be.

for name, method in methods.items():
    print(f"{name:24} {method(1024, 1)}")

# %%
# The error that it really has, over 200 repetitions:

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2), width_ratios=[1, 1.15])
x = np.linspace(0, 1, 500)
left.plot(x, f(x), color="black", label="f(x) = 4 √(1 − x²)")
left.plot(x, 4 * line_pdf(x) / 1.5, ":", color=gallery.ORANGE, label="p(x), scaled")
rows = ["naive", "importance, p a line", "stratified, 1 in each"]
for row, (name, color) in enumerate(
    zip(rows, (gallery.BLUE, gallery.ORANGE, gallery.RED), strict=True)
):
    samples = methods[name](32, 3).samples
    height = -0.3 - 0.35 * row
    left.plot(samples, np.full(32, height), "|", color=color, markersize=10)
    left.text(1.03, height, name.split(",")[0], color=color, va="center", fontsize=9)
left.set(xlabel="x", title="f, and 32 samples of three methods", xlim=(0, 1), ylim=(-1.25, 4.2))
left.set_yticks(range(5))
left.legend(loc="upper right")

counts = 2 ** np.arange(4, 13)
for name, method in methods.items():
    errors = [[method(n, seed).estimate - np.pi for seed in range(200)] for n in counts]
    right.loglog(counts, np.sqrt(np.square(errors).mean(axis=1)), "o-", ms=3.5, label=name)
right.loglog(counts, 1.3 * counts**-0.5, "--", color="black", lw=0.8)
right.text(counts[-1], 1.5 * counts[-1] ** -0.5, "$n^{-1/2}$", ha="right", va="bottom")
right.loglog(counts, 0.5 * counts**-1.5, "--", color="black", lw=0.8)
right.text(counts[-3], 0.35 * counts[-3] ** -1.5, "$n^{-3/2}$", ha="right", va="top")
right.set(xlabel="samples n", ylabel="RMS error", title="Error over 200 repetitions")
right.legend(fontsize=9, loc="lower left")
plt.show()
