"""
A mutation written in Python
============================

From the laboratory to the renderer: `run` is the same, but the states are light paths of a scene,
the target is L*, what a path brings to the image, and the moves are mutations. One of them is
written here. It moves the image position of a path by a few pixels, and the first surface that is
seen there takes the place of the old one.
"""

import matplotlib.pyplot as plt
import numpy as np

import pymlt as mlt
from pymlt.lab import gallery, metropolis

gallery.style()


class Nudge(mlt.Mutation):
    """Moves the image position, for paths (L|D)DE: their last two scatterings are not specular."""

    def __init__(self, radius: float):
        self.radius = radius

    def suitability(self, x):
        return len(x) > 2 and not x[-2].delta and not x[-3].delta

    def propose(self, x, rng):
        raster = x.raster + rng.uniform(-self.radius, self.radius, 2)
        direction = x.scene.camera_direction(x[-1], raster)
        seen = None if direction is None else x.scene.intersect(x[-1], direction, x.time)
        return seen and x.with_vertices([*x[:-2], seen, x[-1]])

    def density(self, x, y):
        per_pixel = 1 / (2 * self.radius) ** 2
        # Pixels per unit of area at y[-2]: a camera walk fills raster_area pixels evenly.
        return per_pixel * y.from_camera[-2] * y.scene.raster_area


class BrokenNudge(Nudge):
    """It takes what is symmetric on the image for symmetric in the scene, where areas differ."""

    def density(self, x, y):
        return 1.0


# %%
# A chain is a list of paths, which one can hold in one's hand. This one has the new mutation alone,
# so that the end of the path at the light stays where it is.

scene = mlt.load_dict(mlt.scenes.cornell_box(), size=(96, 96))
target = scene.path_target(max_depth=6)
paths = (scene.sample_path(seed=seed, max_depth=6) for seed in range(1000))
x0 = next(path for path in paths if path.signature == "LDDE")
walk = metropolis.run(target, Nudge(12), x0, n=150)
for path in walk.states[::30]:
    print(path, f"L* = {target(path):.3g}")

# %%
# In a mixture with the bidirectional mutation the chain reaches every path. Without a start, `run`
# finds one; the mean of a function g times b is then the integral of g L*.

run = metropolis.run(target, [(Nudge(12), 0.5), (mlt.Bidirectional(), 0.5)], n=2000)
for row in run.move_table:
    print(row)
print("brightness of paths of one reflection:", run.estimate(lambda path: path.edges == 2))

# %%
# Is the density right? The audit draws paths from the target, takes one step from each, and tests
# whether the mean of anything has changed. For the broken one it has; for the other nothing is
# found, and the audit says how large a fault would have been.

audits = {made: mlt.audit(made(12), scene, paths=4000, seed=1) for made in (Nudge, BrokenNudge)}
for audit in audits.values():
    print(audit.summary())

figure, axes = plt.subplots(1, 3, figsize=(12, 4.2), width_ratios=[1, 1, 1.15])
image = mlt.render(scene, mlt.BDPT(max_depth=6), spp=32)
raster = np.array([path.raster for path in walk.states])
axes[0].imshow((3 * image / (1 + 3 * image)) ** (1 / 2.2))
axes[0].plot(*raster.T, color="white", lw=0.5, alpha=0.7)
axes[0].scatter(*raster.T, c=range(len(raster)), s=9, cmap="viridis", zorder=3)
axes[0].set(title="150 steps on the image", xticks=[], yticks=[])

seen = np.concatenate([scene.sample_path(seed=seed).vertices[:-1] for seed in range(4000)])
axes[1].plot(*seen["position"][:, :2].T, ".", color="0.8", ms=1)
colors = plt.cm.viridis(np.linspace(0, 1, 30))
for path, color in zip(walk.states[::5], colors, strict=True):
    axes[1].plot(*path.vertices["position"][:, :2].T, color=color, lw=0.8)
axes[1].set(title="in the scene, every 5th path", xlabel="x", ylabel="y", aspect="equal")

for (made, audit), color in zip(audits.items(), (gallery.GREEN, gallery.RED), strict=True):
    z = sorted((abs(test.z) for test in audit.tests), reverse=True)
    axes[2].semilogy(z, "o", ms=4, color=color, label=f"{made.__name__}: {audit.verdict}")
axes[2].axhline(5.3, color="black", lw=1, ls="--")
axes[2].text(len(z), 5.8, "found wrong above", ha="right", fontsize=9)
axes[2].set(title="The audit: |change| / its standard error", ylim=(0.05, 60))
axes[2].set(xlabel="functions of a path, sorted")
axes[2].legend(loc="lower left")
plt.show()
