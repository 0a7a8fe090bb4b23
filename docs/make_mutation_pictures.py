"""Makes the pictures of docs/mutations: python docs/make_mutation_pictures.py [MUTATION ...]

For each mutation: a path x of a scene in black, and what the mutation makes of it, coloured by
the probability of accepting it. On the left in the image, on the right in the scene, which is drawn
as the points where sampled paths have their vertices. The wavelength mutation, whose proposals meet
one point of the image, has its acceptance by wavelength on the left. Needs matplotlib.
"""

import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

import pymlt as mlt
from pymlt.viewing.path_tables import colour

HERE = Path(__file__).parent / "mutations"
SIZE = (320, 320)
MOST_LINES = 60  # more could not be told from each other


@dataclass
class Picture:
    mutation: mlt.Mutation
    scene: str
    signature: str  # of x
    view: tuple[str, str]  # the axes of the view, such as ("x", "y")
    where: tuple[float, float]  # about where x meets the image
    shortest: float = 0.1  # edge of x; between near vertices a path cannot be compared with others
    exposure: float = 1  # stops


PICTURES = [
    Picture(mlt.Bidirectional(), "cornell_box", "LDDE", ("x", "y"), (0.4, 0.9), shortest=0.8),
    Picture(mlt.Lens(), "glass_ball", "LDSSE", ("z", "y"), (0.33, 0.66)),
    Picture(mlt.Caustic(), "glass_ball", "LSSDE", ("x", "y"), (0.32, 0.85)),
    Picture(mlt.MultiChain(), "glass_ball", "LDSSDE", ("x", "y"), (0.3, 0.8)),
    Picture(mlt.Multiplexed(), "glass_ball", "LSSDE", ("x", "y"), (0.32, 0.85)),
    Picture(mlt.Manifold(), "glass_ball", "LDSSDE", ("x", "y"), (0.3, 0.8)),
    Picture(mlt.Propagation(), "fog", "LDDE", ("x", "y"), (0.55, 0.5), exposure=3),
    Picture(mlt.LensSubpath(), "cornell_box", "LDDE", ("x", "y"), (0.4, 0.9), shortest=0.8),
]


@cache
def load(name: str) -> mlt.Scene:
    return mlt.load_dict(getattr(mlt.scenes, name)(), size=SIZE)


@cache
def render(name: str) -> np.ndarray:
    return mlt.render(load(name), mlt.BDPT(max_depth=8), spp=32)


def shortest_edge(path) -> float:
    return np.linalg.norm(np.diff(path.vertices["position"], axis=0), axis=1).min()


def find_path(picture: Picture):
    """Of the sampled paths that suit the picture the one closest to a place in the image."""
    scene = load(picture.scene)
    goal = np.multiply(picture.where, SIZE)
    paths = (scene.sample_path(seed=s, max_depth=8) for s in range(20_000))
    suited = [path for path in paths if path.signature == picture.signature]
    suited = [path for path in suited if shortest_edge(path) > picture.shortest]
    return min(suited, key=lambda path: np.linalg.norm(np.subtract(path.raster, goal)))


def points_of(scene) -> np.ndarray:
    """Where sampled paths have their vertices: the surfaces, as far as light gets there."""
    paths = (scene.sample_path(seed=s, max_depth=8) for s in range(20_000))
    vertices = np.concatenate([path.vertices for path in paths if path.edges > 1])
    return vertices[~vertices["infinite"] & (vertices["kind"] != "camera")]["position"]


def draw(picture: Picture) -> None:
    scene = load(picture.scene)
    x = find_path(picture)
    proposals = scene.propose(x, picture.mutation, seed=1, count=1000)
    axes = ["xyz".index(axis) for axis in picture.view]
    colours = plt.get_cmap("plasma_r")
    print(picture.mutation.name, x, f"{len(proposals)} of 1000 tries found a path", flush=True)

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.8), layout="constrained")
    image = render(picture.scene) * 2**picture.exposure
    left.imshow(np.clip(image, 0, 1) ** (1 / 2.2), extent=(0, *SIZE, 0))
    rasters = np.array([y.raster for y in proposals])
    acceptance = np.array([y.acceptance for y in proposals])
    order = np.argsort(acceptance)
    style = {"c": acceptance[order], "cmap": colours, "vmin": 0, "vmax": 1}
    dots = left.scatter(*rasters[order].T, s=7, linewidths=0, **style)
    left.plot(*x.raster, "o", ms=9, mfc="none", mec="white", mew=2)
    left.set(xlim=(0, SIZE[0]), ylim=(SIZE[1], 0), xticks=[], yticks=[], title="in the image")

    points = points_of(scene)[:, axes]
    right.scatter(*points.T, s=2, c="0.75", linewidths=0)
    some = sorted(proposals[:MOST_LINES], key=lambda y: y.acceptance)
    lines = LineCollection(
        [y.vertices["position"][:, axes] for y in some],
        colors=colours([y.acceptance for y in some]),
        linewidths=0.8,
        alpha=0.8,
    )
    right.add_collection(lines)
    right.plot(*x.vertices["position"][:, axes].T, "ko-", ms=4, lw=1.8)
    low, high = points.min(axis=0), points.max(axis=0)
    edge = 0.06 * (high - low).max()
    right.set(xlim=(low[0] - edge, high[0] + edge), ylim=(low[1] - edge, high[1] + edge))
    right.set(xticks=[], yticks=[], aspect="equal", title=f"in the scene, along {along(axes)}")
    figure.suptitle(f"{picture.mutation!r} of a path {x.signature}")
    figure.colorbar(dots, ax=right, label="acceptance", shrink=0.9)
    figure.savefig(HERE / f"{picture.mutation.name}.png", dpi=80, metadata={"Software": None})
    plt.close(figure)


# ---- the wavelength mutation, whose proposals lie behind one point of the image


def lamp_before_prism() -> mlt.Scene:
    """The built-in scene with a lamp in place of its beam, which has one direction alone."""
    scene = mlt.scenes.prism()
    for name in ("slit", "jaw_before", "jaw_behind", "emitter"):
        del scene[name]
    lamp = {"type": "area", "radiance": 60.0}
    scene["lamp"] = {"type": "sphere", "center": [-2.2, 0.7, 0], "radius": 0.06, "emitter": lamp}
    return mlt.load_dict(scene, size=SIZE)


def path_through_prism(scene: mlt.Scene):
    """Of the paths that go from the lamp to the screen the one closest to its middle, in green."""
    paths = (scene.sample_path(seed=s, max_depth=4) for s in range(20_000))
    suited = [p for p in paths if p.signature == "LSSDE" and 520 < p.wavelengths[0] < 550]
    suited = [p for p in suited if p.vertices["position"][3][2] < -3.9]
    return min(suited, key=lambda path: abs(path.vertices["position"][3][0] - 1.5))


def draw_wavelength() -> None:
    scene, mutation = lamp_before_prism(), mlt.Wavelength()
    x = path_through_prism(scene)
    proposals = scene.propose(x, mutation, seed=1, count=300)
    print(mutation.name, x, f"{len(proposals)} of 300 tries found a path", flush=True)
    waves = np.array([y.wavelengths[0] for y in proposals])
    colours = np.array([colour(y) for y in proposals]) / 255
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(10, 4.8), layout="constrained", width_ratios=(1, 1)
    )
    for axes in (left, right):
        axes.set_facecolor("0.07")
    left.scatter(waves, [y.acceptance for y in proposals], s=22, c=colours, linewidths=0)
    left.axvline(x.wavelengths[0], color="white", lw=1.2, ls="--")
    left.set(xlabel="wavelength in nm", ylabel="acceptance", title="the proposals")
    order = np.argsort(waves)
    some = order[np.unique(np.searchsorted(waves[order], np.arange(400, 690, 12)))]
    draw_from_above(
        right, scene, x, [proposals[i].vertices["position"] for i in some], colours[some]
    )
    figure.suptitle(f"{mutation!r} of a path {x.signature} of {x.wavelengths[0]:.0f} nm")
    figure.savefig(HERE / "wavelength.png", dpi=80, metadata={"Software": None})
    plt.close(figure)


def draw_from_above(axes, scene: mlt.Scene, x, proposals, colours) -> None:
    """Plan: the prism, the screen, and the paths from the lamp to the screen."""
    prism = next(shape for shape in scene.triangles() if len(shape["faces"]) == 8)
    corners = np.unique(np.round(prism["positions"][:, [0, 2]], 6), axis=0)
    axes.add_patch(plt.Polygon(corners, fc="0.25", ec="none"))
    lines = [path[:-1, [0, 2]] for path in proposals]
    axes.add_collection(LineCollection(lines, colors=colours, linewidths=1.3))
    axes.add_patch(plt.Polygon(corners, fc="none", ec="0.8", lw=1, zorder=3))
    axes.plot(*x.vertices["position"][:-1, [0, 2]].T, "o--", color="white", ms=5, lw=1.2)
    axes.axhline(-4, color="0.8", lw=4)
    axes.text(-2.2, 0.12, "lamp", color="0.8", ha="center")
    axes.text(-0.3, -3.9, "screen", color="0.8", va="bottom")
    axes.set(xticks=[], yticks=[], aspect="equal", title="in the scene, along y")
    axes.set(xlim=(-2.5, 2.1), ylim=(-4.15, 0.45))


def along(axes: list[int]) -> str:
    """The axis that a view looks along."""
    return next(name for i, name in enumerate("xyz") if i not in axes)


if __name__ == "__main__":
    for picture in PICTURES:
        if not sys.argv[1:] or picture.mutation.name in sys.argv[1:]:
            draw(picture)
    if not sys.argv[1:] or "wavelength" in sys.argv[1:]:
        draw_wavelength()
