"""
Combining techniques
====================

A glossy surface under a lamp, in one dimension: f(x) = L(x) B(x), where the lamp L is a box of some
width and the lobe B is a bell. One may sample the lamp or the lobe. Either is hopeless where the
other one is narrow. Weights that sum to one combine both so that the better one counts (Veach &
Guibas 1995).
"""

from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from pymlt.lab import gallery, quadrature

gallery.style()

LOBE = 0.1  # standard deviation of B


def problem(width):
    """The integrand and its two techniques, for a lamp of this width."""
    low, high = 0.05 - width / 2, 0.05 + width / 2

    def lamp(x):
        return np.where((x >= low) & (x <= high), 1 / width, 0)

    def lobe(x):
        return np.exp(-0.5 * (x / LOBE) ** 2) / (LOBE * np.sqrt(2 * np.pi))

    techniques = [
        quadrature.Technique(lambda rng, n: rng.uniform(low, high, n), lamp),
        quadrature.Technique(lambda rng, n: rng.normal(0, LOBE, n), lobe),
    ]
    return lambda x: lamp(x) * lobe(x), techniques


widths = np.geomspace(0.005, 5, 25)
names = ("sample the lamp", "sample the lobe", *quadrature.HEURISTICS)
curves: dict[str, list[float]] = {name: [] for name in names}
for width in widths:
    f, techniques = problem(width)
    for technique, name in zip(techniques, curves, strict=False):
        result = quadrature.importance(f, technique.sample, technique.pdf, 40_000)
        curves[name].append(result.standard_error / result.estimate * np.sqrt(40_000))
    for name in quadrature.HEURISTICS:
        result = quadrature.combined(f, techniques, 20_000, heuristic=name)
        curves[name].append(result.standard_error / result.estimate * np.sqrt(40_000))

# %%
# Weights that do not sum to one would give a wrong answer, so they are refused:

f, techniques = problem(0.1)
try:
    quadrature.combined(f, techniques, 100, heuristic=lambda q: 0.6 * quadrature.balance(q))
except ValueError as error:
    print(error)

# %%
# The error of one sample, relative to the integral; the error of n samples is this over √n.

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.2), width_ratios=[1, 1.3])
x = np.linspace(-0.4, 0.4, 801)
for width, color, at in ((0.3, gallery.GREEN, (0.21, 0.7)), (0.02, gallery.BLUE, (0.21, 0.9))):
    f, (lamp, lobe) = problem(width)
    left.fill_between(x, lamp.pdf(x) / lamp.pdf(x).max(), step="mid", alpha=0.3, color=color, lw=0)
    left.text(*at, f"L, width {width}", color=color)
left.plot(x, lobe.pdf(x) / lobe.pdf(x).max(), color=gallery.ORANGE)
left.text(-0.11, 0.6, "B", color=gallery.ORANGE, ha="right", fontsize=12)
left.set(xlabel="x", yticks=[], title="The lamp L and the lobe B, scaled to 1", ylim=(0, 1.05))

styles: list[dict[str, Any]] = [
    {"color": gallery.BLUE, "ls": "--"},
    {"color": gallery.ORANGE, "ls": "--"},
    {"color": gallery.GREEN, "lw": 2.5},
    {"color": gallery.RED},
    {"color": "#8e5ea2"},
    {"color": gallery.GREY},
]
for (name, errors), look in zip(curves.items(), styles, strict=True):
    right.loglog(widths, errors, label=name, **look)
right.set(xlabel="width of the lamp", ylabel="relative error × √n", title="Error of each way")
right.set_ylim(0.02, 60)
right.legend(ncols=2, fontsize=9, loc="upper center")
plt.show()
