"""
Ergodicity
==========

A chain must be able to come from everywhere to everywhere; then it is *ergodic*, and its mean over
time is the mean over f. Small steps do not cross a gap that is wider than they are. Each such chain
looks perfectly well, and is wrong: nothing in its samples tells of the light that it has never met.
A move that may propose everything, however rarely, mends that.
"""

import matplotlib.pyplot as plt
import numpy as np

import pymlt as mlt
from pymlt.lab import gallery, metropolis

gallery.style()

LEFT, RIGHT, STEPS = 0.3, 0.6, 4000


def f(x):
    """Two islands: 30 % and 40 % of [0, 1], of the same height."""
    return float(0 <= x <= LEFT or RIGHT <= x <= 1)


walk = metropolis.RandomWalk(0.2)  # by up to 0.1 either way, and the gap is 0.3 wide
mixtures = {
    "small steps alone": [(walk, 1.0)],
    "5 % uniform proposals": [(walk, 0.95), (metropolis.Uniform(0, 1), 0.05)],
}
truth = (1 - RIGHT) / (1 - RIGHT + LEFT)
runs = {name: metropolis.run(f, moves, 0.1, STEPS, seed=1) for name, moves in mixtures.items()}
for name, run in runs.items():
    right = (run.samples > RIGHT).mean()
    print(f"{name}: {100 * right:.0f} % on the right, which should be {100 * truth:.0f} %")

# %%
# The same with light. A glass ball throws a caustic on the floor. Caustic perturbations move the
# directions in which a path leaves the lamp, and keep its kind: a chain of them alone stays with
# light that went through the ball, LSSDE. Bidirectional mutations build paths anew.

scene = mlt.load_dict(mlt.scenes.glass_ball(), size=(160, 160))
target = scene.path_target(max_depth=6)
paths = (scene.sample_path(seed=seed, max_depth=6) for seed in range(10_000))
start = next(path for path in paths if path.signature == "LSSDE")
image = mlt.render(scene, mlt.MLT(max_depth=6), spp=64, seed=1)
light = {
    "caustic perturbations alone": [mlt.Caustic()],
    "and bidirectional mutations": [mlt.Caustic(), mlt.Lens(), mlt.Bidirectional()],
}
chains = {name: metropolis.run(target, moves, start, 3000, seed=2) for name, moves in light.items()}
for name, run in chains.items():
    kinds = {path.signature for path in run.states}
    print(f"{name}: {', '.join(sorted(kinds, key=len))}")

figure, axes = plt.subplots(2, 3, figsize=(12, 6), width_ratios=[1.2, 1, 1.1])
colors = (gallery.RED, gallery.GREEN)
for (name, run), row, color in zip(runs.items(), axes, colors, strict=True):
    row[0].plot(run.states[:1500], ".", ms=2, color=color)
    row[0].axhspan(LEFT, RIGHT, color="0.9", lw=0)
    row[0].set(title=name, xlabel="step", ylabel="x", ylim=(0, 1))
    row[1].hist(run.samples, 50, range=(0, 1), density=True, color=color, alpha=0.7)
    row[1].set(xlabel="x", title="histogram")
for (name, run), row, color in zip(chains.items(), axes, colors, strict=True):
    raster = np.array([path.raster for path in run.states])
    row[2].imshow((3 * image / (1 + 3 * image)) ** (1 / 2.2))
    row[2].plot(*raster.T, ".", ms=1.5, color=color)
    row[2].set(title=name, xticks=[], yticks=[], xlim=(0, 160), ylim=(160, 0))
plt.show()
