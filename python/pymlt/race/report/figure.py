"""The pictures of a race beside each other, for papers: a figure of matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..._extras import import_extra
from ...pictures.tonemapping import Exposure, encode_srgb, stops_of, tonemap
from ..insets import Inset

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure, SubFigure

    from ..result import Outcome
    from ..score import Score

COLUMN = 2.4  #: inches
FRAMES = ("#ff3d6e", "#12b5ff", "#ffc400")


def draw(results: Sequence[Outcome], exposure: Exposure, curve: str) -> Figure:
    """For each scene a row of whole images, and below each its insets."""
    figures = import_extra("matplotlib.figure", "plots", "a picture of a race")
    heights = [_height(result) for result in results]
    most = max(len(result.ranked) for result in results) + 1
    engines = import_extra("matplotlib.layout_engine", "plots", "a picture of a race")
    layout = engines.ConstrainedLayoutEngine(w_pad=0.02, h_pad=0.02, wspace=0, hspace=0)
    figure: Figure = figures.Figure(figsize=(COLUMN * most, sum(heights)), layout=layout)
    rows = figure.subfigures(len(results), 1, squeeze=False, height_ratios=heights)[:, 0]
    for row, result in zip(rows, results, strict=True):
        stops = stops_of(exposure, result.scale)
        _draw_scene(
            row, result, most, lambda x, s=stops: encode_srgb(tonemap(x, curve, exposure=s))
        )
    return figure


def _height(result: Outcome) -> float:
    """Inches of a scene: image, insets, titles."""
    width, height = result.settings.size
    insets = COLUMN * _inset_aspect(result) if result.insets else 0
    return COLUMN * height / width + insets + 0.9


def _inset_aspect(result: Outcome) -> float:
    """Height over width of a row of insets."""
    return 1 / sum(inset.width / inset.height for inset in result.insets)


def _draw_scene(row: SubFigure, result: Outcome, columns: int, shown: Any) -> None:
    width, height = result.settings.size
    count = max(1, len(result.insets))
    ratios = [height / width, _inset_aspect(result)] if result.insets else [1]
    grid = row.add_gridspec(len(ratios), count * columns, height_ratios=ratios)
    row.suptitle(result.settings.name, x=0.01, ha="left", fontsize=10, fontweight="bold")
    blind = result.reference_error is None
    reference = "median" if blind else "reference"
    images = [(reference, result.scale), *((e.label, e.image) for e in result.ranked)]
    captions = ["", *(_caption(e.score, blind) for e in result.ranked)]
    for i, (label, image) in enumerate(images):
        whole = row.add_subplot(grid[0, i * count : (i + 1) * count])
        whole.set_title(f"{label}\n{captions[i]}".rstrip(), fontsize=8)
        whole.set_anchor("S")
        _show(whole, shown(image))
        for k, inset in enumerate(result.insets):
            _outline(whole, inset, FRAMES[k % len(FRAMES)])
            part = row.add_subplot(grid[1, i * count + k])
            part.set_anchor("N")
            _show(part, shown(inset.crop(image)), FRAMES[k % len(FRAMES)])


def _caption(score: Score | None, blind: bool) -> str:
    """Two lines: relMSE, or without a reference what is in its place, and the pixels' quantiles."""
    if not (score and score.relmse and score.pixel_median and score.percentile_90):
        return ""
    return (
        f"{'spread of the seeds' if blind else 'relMSE'} {score.relmse}\n"
        f"median pixel {score.pixel_median.value:.2g}, 90 % {score.percentile_90.value:.2g}"
    )


def _show(axes: Axes, picture: np.ndarray, frame: str = "") -> None:
    axes.imshow(picture, interpolation="nearest")
    axes.set(xticks=[], yticks=[])
    for spine in axes.spines.values():
        spine.set(visible=bool(frame), color=frame or "none", linewidth=1.5)


def _outline(axes: Axes, inset: Inset, colour: str) -> None:
    patches = import_extra("matplotlib.patches", "plots", "a picture of a race")
    corner = (inset.x - 0.5, inset.y - 0.5)
    axes.add_patch(
        patches.Rectangle(corner, inset.width, inset.height, fill=False, ec=colour, lw=1.2)
    )
