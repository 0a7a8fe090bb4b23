"""Charts of a race as SVG, drawn in the colours of the page around them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from html import escape
from itertools import pairwise
from math import ceil, floor, log10

WIDTH, HEIGHT = 400, 270
LEFT, RIGHT, TOP, BOTTOM = 48, 26, 12, 34
COLOURS = 10  #: that the page's style knows


@dataclass(frozen=True)
class Series:
    """What is known of one algorithm."""

    index: int  #: its number, which tells its colour
    label: str
    points: list[tuple[float, float, float | None]]  #: x, y, standard error of y


def colour(index: int) -> str:
    """Of the algorithm of a number, as CSS."""
    return f"var(--c{index % COLOURS})"


def error_chart(series: Sequence[Series], title: str) -> str:
    """Errors over CPU time, both logarithmic, with standard errors."""
    drawn = [Series(s.index, s.label, [p for p in s.points if p[1] > 0]) for s in series]
    drawn = [s for s in drawn if s.points]
    if not drawn:
        return ""
    x = _axis([p[0] for s in drawn for p in s.points], LEFT, WIDTH - RIGHT)
    y = _axis([p[1] for s in drawn for p in s.points], HEIGHT - BOTTOM, TOP)
    parts = [_grid(x, y)]
    parts += [_line(s, x.place, y.place) for s in drawn]
    ends = spread([y.place(s.points[-1][1]) for s in drawn], 12)
    parts += [
        _text(x.place(s.points[-1][0]) + 7, end + 4, str(s.index + 1), colour(s.index), "start")
        for s, end in zip(drawn, ends, strict=True)
    ]
    parts.append(_text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 3, "CPU seconds of an image"))
    return _figure(title, parts, HEIGHT)


def level_chart(series: Sequence[Series], title: str, axis: str) -> str:
    """Levels of single images, one row for each algorithm; the bar is the mean and its error.

    Points are (seed, level, None), but the last one: (0, mean, standard error).
    """
    values = [abs(p[1] - 1) for s in series for p in s.points]
    reach = min(max([*values, 1e-4]) * 1.15, 1.0)
    height = TOP + BOTTOM + 22 * len(series)

    def place(level: float) -> float:
        share = min(max((level - 1) / reach, -1.0), 1.0)
        return (LEFT + WIDTH - RIGHT) / 2 + share * (WIDTH - RIGHT - LEFT) / 2

    step = _round_step(reach)
    ticks = [1 + i * step for i in range(-floor(reach / step), floor(reach / step) + 1)]
    parts = [
        f'<line class="{"one" if tick == 1 else "grid"}" x1="{place(tick):.1f}" y1="{TOP}" '
        f'x2="{place(tick):.1f}" y2="{height - BOTTOM}"/>'
        + _text(place(tick), height - BOTTOM + 14, f"{tick:.6g}")
        for tick in ticks
    ]
    for row, s in enumerate(series):
        parts.append(_levels(s, TOP + 22 * row + 11, place))
    parts.append(_text((LEFT + WIDTH - RIGHT) / 2, height - 3, axis))
    return _figure(title, parts, height)


def _levels(series: Series, y: float, place: Callable[[float], float]) -> str:
    paint = colour(series.index)
    *single, (_, mean, error) = series.points
    parts = [_text(LEFT - 10, y + 4, str(series.index + 1), paint, "end")]
    if error:
        low, high = place(mean - error), place(mean + error)
        parts.append(
            f'<rect x="{low:.1f}" y="{y - 7:.1f}" width="{max(high - low, 1):.1f}" height="14" '
            f'rx="2" fill="{paint}" opacity="0.28"/>'
        )
    parts += [
        f'<circle cx="{place(level):.1f}" cy="{y:.1f}" r="3.2" fill="{paint}" opacity="0.85">'
        f"<title>{escape(series.label)}, seed {seed:.0f}: {level:.4g}</title></circle>"
        for seed, level, _ in single
    ]
    return "".join(parts)


def _line(series: Series, x: Callable[[float], float], y: Callable[[float], float]) -> str:
    paint = colour(series.index)
    places = [(x(time), y(value)) for time, value, _ in series.points]
    path = " ".join(f"{px:.1f},{py:.1f}" for px, py in places)
    parts = [f'<polyline points="{path}" fill="none" stroke="{paint}" stroke-width="2"/>']
    for (time, value, error), (px, py) in zip(series.points, places, strict=True):
        if error and error < value:
            low, high = y(value - error), y(value + error)
            parts.append(f'<path d="M{px:.1f} {low:.1f}V{high:.1f}" stroke="{paint}"/>')
        parts.append(
            f'<circle cx="{px:.1f}" cy="{py:.1f}" r="3.2" fill="{paint}">'
            f"<title>{escape(series.label)}, {time:.3g} s: {value:.3g}</title></circle>"
        )
    return "".join(parts)


@dataclass(frozen=True)
class _Axis:
    """A logarithmic axis between two places."""

    ticks: list[float]
    low: float
    high: float
    begin: float
    end: float

    def place(self, value: float) -> float:
        """Where a value lies; those that are too small or too large lie at an end."""
        inside = min(max(value, self.low), self.high)
        share = log10(inside / self.low) / log10(self.high / self.low)
        return self.begin + share * (self.end - self.begin)


def _axis(values: Sequence[float], begin: float, end: float) -> _Axis:
    """Ticks at 1, 2 and 5 times powers of ten, or at the powers alone if these are many."""
    low, high = min(values) / 1.25, max(values) * 1.25
    powers = range(floor(log10(low)), ceil(log10(high)) + 1)
    steps = (1, 2, 5) if high / low < 300 else (1,)
    ticks = [step * 10.0**power for power in powers for step in steps]
    return _Axis([tick for tick in ticks if low <= tick <= high], low, high, begin, end)


def _grid(x: _Axis, y: _Axis) -> str:
    parts = [
        f'<line class="grid" x1="{LEFT}" y1="{y.place(t):.1f}" x2="{WIDTH - RIGHT}" '
        f'y2="{y.place(t):.1f}"/>' + _text(LEFT - 6, y.place(t) + 4, _tick(t), anchor="end")
        for t in y.ticks
    ]
    parts += [
        f'<line class="grid" x1="{x.place(t):.1f}" y1="{TOP}" x2="{x.place(t):.1f}" '
        f'y2="{HEIGHT - BOTTOM}"/>' + _text(x.place(t), HEIGHT - BOTTOM + 14, _tick(t))
        for t in x.ticks
    ]
    return "".join(parts)


def _tick(value: float) -> str:
    return f"{value:g}" if 1e-4 <= value < 1e5 else f"1e{round(log10(value))}"


def _round_step(reach: float) -> float:
    """1, 2 or 5 times a power of ten, two or three times within the reach."""
    power = 10.0 ** floor(log10(reach / 2))
    return next(s * power for s in (5, 2, 1) if s * power <= reach / 1.6)


def spread(places: Sequence[float], distance: float) -> list[float]:
    """Places moved downwards where they lie closer together than a distance."""
    order = sorted(range(len(places)), key=lambda i: places[i])
    moved = list(places)
    for before, after in pairwise(order):
        moved[after] = max(moved[after], moved[before] + distance)
    return moved


def _text(x: float, y: float, text: str, fill: str = "", anchor: str = "middle") -> str:
    style = f' style="fill:{fill};font-weight:600"' if fill else ""
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{style}>{escape(text)}</text>'


def _figure(title: str, parts: Sequence[str], height: float) -> str:
    return (
        f'<figure class="chart"><figcaption>{escape(title)}</figcaption>'
        f'<svg viewBox="0 0 {WIDTH} {height}" role="img" aria-label="{escape(title)}">'
        f"{''.join(parts)}</svg></figure>"
    )
