"""Charts of a race, drawn by matplotlib in colours that suit a light and a dark page."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING

from ..._extras import import_extra

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Of algorithms, one after the other; --c0 to --c9 of page.css.
COLOURS = ["#2f6fb3", "#d9730d", "#c23b4a", "#2a9087", "#4d9a3a"]
COLOURS += ["#9a7a00", "#8f5bb5", "#cf5f92", "#8a6248", "#6b7280"]
INK = "#7d8590"


@dataclass(frozen=True)
class Series:
    """What is known of one algorithm."""

    index: int  #: its number, which tells its colour
    points: list[tuple[float, float, float | None]]  #: x, y, standard error of y

    @property
    def colour(self) -> str:
        return COLOURS[self.index % len(COLOURS)]


def error_chart(series: Sequence[Series]) -> Figure | None:
    """Errors over CPU time, both logarithmic, with standard errors; None if no error is known."""
    drawn = [Series(s.index, [p for p in s.points if p[1] > 0]) for s in series]
    drawn = [s for s in drawn if s.points]
    if not drawn:
        return None
    axes = _axes(2.9)
    axes.set(xscale="log", yscale="log", xlabel="CPU seconds of an image")
    for s in drawn:
        times, values, errors = zip(*s.points, strict=True)
        bars = [error or 0 for error in errors]
        axes.errorbar(times, values, bars, c=s.colour, marker="o", ms=4, label=str(s.index + 1))
    tickers = import_extra("matplotlib.ticker", "plots", "the page of a race")
    for axis in axes.xaxis, axes.yaxis:
        axis.set_major_locator(tickers.LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter("{x:g}")
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend(frameon=False, labelcolor="linecolor", handlelength=1)
    return axes.figure


def level_chart(series: Sequence[Series], title: str) -> Figure:
    """Levels of single images, one row for each algorithm; the bar is the mean and its error.

    Points are (seed, level, None), but the last one: (0, mean, standard error).
    """
    axes = _axes(0.7 + 0.25 * len(series))
    for row, s in enumerate(series):
        *single, (_, mean, error) = s.points
        axes.barh(row, 2 * (error or 0), 0.6, mean - (error or 0), color=s.colour, alpha=0.28)
        axes.plot([level for _, level, _ in single], [row] * len(single), "o", c=s.colour, ms=4)
    reach = max([abs(level - 1) for s in series for _, level, _ in s.points] + [1e-4])
    axes.set(xlabel=title, xlim=(1 - 1.15 * reach, 1 + 1.15 * reach))
    axes.set_yticks(range(len(series)), [str(s.index + 1) for s in series])
    axes.ticklabel_format(axis="x", useOffset=False)
    axes.invert_yaxis()
    axes.axvline(1, color=INK, lw=1)
    axes.grid(axis="x", alpha=0.3)
    return axes.figure


def embedded(figure: Figure, title: str) -> str:
    """As a part of a page that needs no other file."""
    matplotlib = import_extra("matplotlib", "plots", "the page of a race")
    picture = BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": "race"}):  # so that equal charts are equal files
        figure.savefig(picture, format="svg", transparent=True, metadata={"Date": None})
    return (
        f'<figure class="chart"><figcaption>{escape(title)}</figcaption><img alt="" '
        f'src="data:image/svg+xml;base64,{b64encode(picture.getvalue()).decode()}"></figure>'
    )


def _axes(height: float) -> Axes:
    """The axes of a new figure with this height in inches."""
    figures = import_extra("matplotlib.figure", "plots", "the page of a race")
    axes = figures.Figure(figsize=(4.2, height), layout="constrained").add_subplot()
    axes.tick_params(which="both", colors=INK, labelsize=8)
    axes.xaxis.label.set(color=INK, size=8)
    for side, spine in axes.spines.items():
        spine.set(color=INK, visible=side in ("left", "bottom"))
    return axes
