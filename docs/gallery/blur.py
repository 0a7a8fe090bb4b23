"""
Blurring an image
=================

Metropolis quadrature of a product: I = ∫ f g = (mean of g(x_i)) ∫ f, with x_i ~ f. Here f is the
brightness of an image and g a blur kernel around a pixel, times the colour relative to the
brightness: a single chain that wanders over the image serves all pixels at once. This is how
Metropolis light transport makes a picture, with light paths in place of points.
"""

import matplotlib.pyplot as plt
import numpy as np

import pymlt as mlt
from pymlt.lab import gallery, metropolis

gallery.style()

SIZE, SIGMA = 72, 1.2
picture = mlt.render(mlt.load_dict(mlt.scenes.cornell_box(), size=(SIZE, SIZE)), "path", spp=100)
picture = np.minimum(picture.astype(float), 1)
brightness = picture.mean(axis=2)
f = metropolis.Image(brightness)
centres = np.arange(SIZE) + 0.5


def kernel(position):
    """The blur kernel from one coordinate of each sample to each row or column."""
    z = (centres[:, None] - position) / SIGMA
    return np.exp(-0.5 * z**2) / (SIGMA * np.sqrt(2 * np.pi))


def splat(points, weights):
    """The sum of weights times colour / brightness times kernel, for every pixel."""
    column, row = points.astype(int).T
    color = picture[row, column] / brightness[row, column, None] * weights[:, None]
    down, across = kernel(points[:, 1]), kernel(points[:, 0])
    return np.stack([(down * c) @ across.T for c in color.T], axis=2)


# %%
# Three ways to choose n points. The last one needs a table of all of f; Metropolis needs nothing
# but values of f, and the integral of f for the scale. Its samples are correlated, so for an image,
# which one can tabulate, the table is better. Of all light paths there is no table.

grid = np.stack(np.meshgrid(centres, centres), axis=2).reshape(-1, 2)
truth = splat(grid, brightness.ravel())


def uniform(n, seed):
    points = np.random.default_rng(seed).random((n, 2)) * SIZE
    return splat(points, f(points) * SIZE**2 / n)


def chain(n, seed):
    moves = [(metropolis.Uniform(0, SIZE), 0.2), (metropolis.RandomWalk(6, "normal"), 0.8)]
    start = metropolis.bootstrap(
        f,
        lambda rng, k: rng.random((k, 2)) * SIZE,
        lambda x: np.full(len(x), SIZE**-2),
        64,
        seed=seed,
    )
    run = metropolis.run(f, moves, start.starts[0], n - 64, expected_values=True, seed=seed)
    used = run.weights > 0
    return splat(run.samples[used], run.weights[used] / run.weights.sum() * f.integral)


def table(n, seed):
    rng = np.random.default_rng(seed)
    pixel = rng.choice(SIZE**2, n, p=brightness.ravel() / f.integral)
    points = np.stack([pixel % SIZE, pixel // SIZE], axis=1) + rng.random((n, 2))
    return splat(points, np.full(n, f.integral / n))


methods = {"uniform points": uniform, "Metropolis": chain, "importance, from a table": table}
counts = [500, 1000, 2000, 4000, 8000, 16_000]
pictures = {}
errors: dict[str, list[float]] = {name: [] for name in methods}
for name, method in methods.items():
    for n in counts:
        pictures[name] = method(n, seed=n)
        errors[name].append(np.sqrt(np.mean((pictures[name] - truth) ** 2)))

# %%

figure, axes = plt.subplots(2, 3, figsize=(11, 7.2))
panels = {"the image": picture, "blurred, exactly": truth, **pictures}
for ax, (name, pixels) in zip(axes.ravel(), panels.items(), strict=False):
    ax.imshow(np.clip(pixels, 0, 1) ** (1 / 2.2))
    ax.set(title=name if name not in pictures else f"{name}, n = {counts[-1]}")
    ax.axis("off")
ax = axes[1, 2]
for (name, error), color in zip(
    errors.items(), (gallery.BLUE, gallery.GREEN, gallery.ORANGE), strict=True
):
    ax.loglog(counts, error, "o-", ms=4, color=color, label=name)
ax.set(xlabel="evaluations of f", title="RMS error")
ax.legend(fontsize=9)
plt.show()
