"""An image beside its reference, and maps of what differs."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from .._extras import import_extra
from ..pictures.tonemapping import Exposure, encode_srgb, stops_of
from ..pictures.tonemapping import tonemap as tone_mapped
from .metrics import compare, flip_map, image_pair, relative_error

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

SHARE = 0.99  #: of the pixels that lie within the range of a map's colours


def comparison_figure(
    image: ArrayLike | str | os.PathLike[str],
    reference: ArrayLike | str | os.PathLike[str],
    *,
    exposure: Exposure = 0,
    tonemap: str = "srgb",
) -> Figure:
    """A matplotlib figure of an image a, its reference r, and how they differ.

    image, reference
        arrays, results or file names, of one size, as `compare` takes them.
    exposure, tonemap
        how both are shown, as `write_image` has them ("auto" suits the reference);
        the maps and numbers are of linear light.

    The maps are a - r (the mean of the channels; red is too bright, blue too dark), the relative
    error `|a - r| / (|r| + 0.01)`, and HDR-FLIP (Andersson et al. 2021) from 0 to 1. The colours of
    the first two reach as far as 99 % of the pixels do. The numbers are those of `compare`.

    Needs the extras `plots` and `flip`. Raises what `compare` and `tonemap` raise, and UsageError
    without those.
    """
    figures = import_extra("matplotlib.figure", "plots", "a picture of a comparison")
    a, r = image_pair(image, reference)
    stops = stops_of(exposure, r)
    flip, _ = flip_map(a, r)
    height, width = a.shape[:2]
    figure: Figure = figures.Figure(
        figsize=(13, 1.2 + 7.4 * min(2, height / width)), layout="constrained"
    )
    axes = list(figure.subplots(2, 3).flat)
    for cell in axes:
        cell.set_axis_off()
    for cell, pixels, title in zip(axes, (a, r), ("image", "reference"), strict=False):
        shown = encode_srgb(tone_mapped(pixels, tonemap, exposure=stops))
        _show(cell, title, shown.repeat(3 // shown.shape[2], axis=2))
    axes[2].text(0, 1, _numbers(compare(a, r)), family="monospace", va="top", fontsize=12)
    difference, relative = (a - r).mean(axis=2), relative_error(a, r)
    reach = _reach(difference)
    _show(axes[3], "image - reference", difference, cmap="RdBu_r", vmin=-reach, vmax=reach)
    _show(axes[4], "relative error", relative, cmap="viridis", vmin=0, vmax=_reach(relative))
    _show(axes[5], "FLIP", flip, cmap="magma", vmin=0, vmax=1)
    return figure


def _show(cell: Axes, title: str, pixels: np.ndarray, **colours: Any) -> None:
    cell.set_title(title)
    shown = cell.imshow(pixels, interpolation="nearest", **colours)
    if colours:
        above, below = pixels.max() > colours["vmax"], pixels.min() < colours["vmin"]
        extend = ("both" if above else "min") if below else ("max" if above else "neither")
        cell.figure.colorbar(shown, ax=cell, extend=extend, fraction=0.046, pad=0.03)


def _reach(errors: np.ndarray) -> float:
    """The size that 99 % of the errors do not exceed."""
    import numpy as np

    finite = abs(errors[np.isfinite(errors)])
    return float(np.quantile(finite, SHARE) if finite.size else 0) or 1e-6


def _numbers(metrics: dict[str, float]) -> str:
    return "\n".join(f"{name:15} {value:.4g}" for name, value in metrics.items())
