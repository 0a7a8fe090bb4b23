"""The images of the techniques (s, t) of bidirectional path tracing, and the table of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from .._extras import import_extra
from .tonemapping import encode_srgb, tonemap

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

CELL = 1.1  #: inches
TITLES = {"raw": "what each technique finds alone", "weighted": "weighted: the sum is the render"}


class Technique(NamedTuple):
    """The image of one technique (s, t) of bidirectional path tracing."""

    raw: NDArray[np.float32]  #: what it finds alone, without weights
    weighted: NDArray[np.float32]  #: what it brings to the render


def techniques_of(layers: dict[str, NDArray[np.float32]]) -> dict[tuple[int, int], Technique]:
    """Those among the layers of a render, by (s, t)."""
    found = {}
    for name, weighted in layers.items():
        kind, *numbers = name.split(".")
        if kind == "weighted":
            s, t = (int(number[1:]) for number in numbers)
            found[s, t] = Technique(layers[f"raw.s{s}.t{t}"], weighted)
    return found


def technique_figure(techniques: dict[tuple[int, int], Technique], exposure: float) -> Figure:
    """The table of strategies: C_{i,j} joins light vertex i = s - 1 with camera vertex j = t - 1.

    Paths of equal length lie on a diagonal. Without t = 0 if no light walk has hit the lens. Needs
    the extra `plots`.
    """
    lens_is_hit = any(t == 0 and image.raw.any() for (_, t), image in techniques.items())
    cells = {(s - 1, t - 1): c for (s, t), c in techniques.items() if t > 0 or lens_is_hit}
    figures = import_extra("matplotlib.figure", "plots", "the picture of the techniques")
    height, width = next(iter(cells.values())).raw.shape[:2]
    light, camera = (sorted(set(vertices)) for vertices in zip(*cells, strict=True))
    size = 2 * (CELL * len(camera) + 0.5), CELL * len(light) * height / width + 0.8
    figure: Figure = figures.Figure(figsize=size, layout="constrained", dpi=150)
    for axes, kind in zip(figure.subplots(1, 2), TITLES, strict=True):
        axes.set_title(TITLES[kind], fontsize=10)
        for place, technique in cells.items():
            _draw(axes, place, tonemap(getattr(technique, kind), "srgb", exposure=exposure))
        axes.set(xlabel="camera vertex j", ylabel="light vertex i", aspect=height / width)
        axes.set(xticks=camera, xlim=(camera[0] - 0.5, camera[-1] + 0.5))
        axes.set(yticks=light, ylim=(light[-1] + 0.5, light[0] - 0.5))
        axes.spines[:].set_visible(False)
    return figure


def _draw(axes: Axes, place: tuple[int, int], image: np.ndarray) -> None:
    """An image in its cell; grey if it is black."""
    i, j = place
    picture = encode_srgb(image) if image.any() else image + 0.8
    axes.imshow(picture, extent=(j - 0.47, j + 0.47, i + 0.47, i - 0.47))
