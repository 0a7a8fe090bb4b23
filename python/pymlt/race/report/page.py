"""A race as one page of HTML that needs no other file."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ... import _core
from ...pictures.tonemapping import Exposure, check_tonemap, stops_of
from ..insets import Inset
from .chart import COLOURS, Series, embedded, error_chart, level_chart
from .pictures import drawing, error_map, exact, photograph, shows_flip
from .table import Column, columns, heading, notes, summary, summary_title

if TYPE_CHECKING:
    from ..result import Entry, Outcome

STYLE = Path(__file__).with_name("page.css")
EXPLAINED = {
    "relMSE": "mean of (a − r)² / (r² + 0.01) over all pixels",
    "over best": "relMSE over the smallest relMSE",
    "median seed": "median of relMSE over the seeds",
    "trimmed": "relMSE without the 0.1 % of the pixels that are worst",
    "median pixel": "(a − r)² / (r² + 0.01) that half of the pixels of an image do not exceed",
    "90 % of pixels": "the same that nine of ten pixels do not exceed",
    "shape": "relMSE once each image is scaled to the mean of the reference",
    "level": "mean of the image over the mean of the reference",
    "spread": "standard deviation of the level from seed to seed",
    "FLIP": "visible difference when flipping between image and reference, 0 to 1 "
    "(HDR-FLIP, Andersson et al. 2021)",
    "CPU s": "CPU seconds of an image, all threads together",
    "spp": "samples or mutations per pixel",
}


def page(results: Sequence[Outcome], exposure: Exposure, tonemap: str) -> str:
    """The whole document. Raises UsageError for an unknown curve."""
    check_tonemap(tonemap)
    title = "Race: " + ", ".join(result.settings.name for result in results)
    parts = [f"<h1>{escape(title)}</h1>"]
    if len(results) > 1:
        parts.append(_summary(results))
    for result in results:
        name = f"<h2>{escape(result.settings.name)}</h2>" if len(results) > 1 else ""
        parts.append(f"<section>{name}{_race(result, exposure, tonemap)}</section>")
    parts.append(_footer(results))
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{escape(title)}</title><style>{STYLE.read_text()}</style></head>\n"
        f"<body><main>{''.join(parts)}</main></body></html>\n"
    )


def _summary(results: Sequence[Outcome]) -> str:
    labels, *scenes = summary(results)
    return (
        f"<section><h2>All scenes</h2><p>{escape(summary_title(results))}.</p>"
        f"{_table(list(enumerate(labels.cells)), scenes, 'summary')}</section>"
    )


def _race(result: Outcome, exposure: Exposure, curve: str) -> str:
    stops = stops_of(exposure, result.scale)
    rows = [(result.entries.index(entry), entry.label) for entry in result.ranked]
    remarks = "".join(f"<li>{escape(note)}</li>" for note in notes(result))
    return (
        f"<p>{escape(heading(result))}.</p>"
        f"{_table(rows, columns(result))}"
        f"{f'<ul>{remarks}</ul>' if remarks else ''}"
        f'<div class="charts">{_charts(result)}</div>'
        f"{_pictures(result, curve, stops)}"
    )


# ---- tables ------------------------------------------------------------------------------------


def _table(rows: list[tuple[int, str]], columns: Sequence[Column], kind: str = "") -> str:
    head = "".join(
        f'<th title="{escape(EXPLAINED.get(column.title, ""))}">{escape(column.title)}</th>'
        for column in columns
    )
    body = "".join(
        f"<tr><th>{_badge(index)}{escape(label)}</th>"
        + "".join(_cell(column, row) for column in columns)
        + "</tr>"
        for row, (index, label) in enumerate(rows)
    )
    return (
        f'<div class="scroll"><table class="{kind}"><thead><tr><th>algorithm</th>{head}</tr>'
        f"</thead><tbody>{body}</tbody></table></div>"
    )


def _cell(column: Column, row: int) -> str:
    value, sign, error = column.cells[row].partition(" ± ")
    best = ' class="best"' if row == column.best else ""
    return f"<td{best}>{escape(value)}<small>{sign}{escape(error)}</small></td>"


def _badge(index: int) -> str:
    paint = f"var(--c{index % len(COLOURS)})"
    return f'<b class="badge" style="background:{paint}">{index + 1}</b>'


# ---- charts ------------------------------------------------------------------------------------


def _charts(result: Outcome) -> str:
    ranked = [(result.entries.index(entry), entry) for entry in result.ranked]
    mean = float(result.scale.mean())
    axis = "mean of the image / mean of the " + _standard(result)
    charts = {
        "relMSE over time": error_chart([_errors(i, e, "relmse") for i, e in ranked]),
        "trimmed relMSE over time": error_chart([_errors(i, e, "trimmed") for i, e in ranked]),
        "level of each image": level_chart([_levels(i, e, mean) for i, e in ranked], axis),
    }
    return "".join(embedded(figure, title) for title, figure in charts.items() if figure)


def _standard(result: Outcome) -> str:
    """What images are compared with."""
    return "reference" if result.reference_error is not None else "median of the algorithms"


def _errors(index: int, entry: Entry, metric: str) -> Series:
    known = [(s.seconds, getattr(s, metric)) for s in entry.scores if s is not None]
    points = [(seconds, mean.value, mean.error) for seconds, mean in known if mean is not None]
    return Series(index, points)


def _levels(index: int, entry: Entry, mean: float) -> Series:
    assert entry.score is not None
    level = entry.score.level
    single: list[tuple[float, float, float | None]] = [
        (run.seed, float(np.mean(run.image, dtype=np.float64)) / mean, None) for run in entry.runs
    ]
    return Series(index, [*single, (0.0, level.value, level.error)])


# ---- pictures ----------------------------------------------------------------------------------


def _pictures(result: Outcome, curve: str, stops: float) -> str:
    kind = "FLIP" if shows_flip(result) else "relative error, 0 to 1"
    other = _Views.of(result, result.scale, curve, stops)
    addresses = {"whole": other.whole} | {f"part{i}": part for i, part in enumerate(other.parts)}
    style = ";".join(f"--{name}:url({address})" for name, address in addresses.items())
    cards = [_card(result, other, _standard(result), "")]
    for entry in result.ranked:
        caption = _badge(result.entries.index(entry)) + escape(entry.label)
        views = _Views.of(result, entry.image, curve, stops)
        cards.append(_card(result, views, caption, drawing(error_map(result, entry))))
    brightened = f"{stops:+.1f}".replace("-", "−")
    parts = "enlarged parts and " if result.insets else ""
    return (
        f"<p>The image with the median error of each; below it {parts}the map of its error "
        f"({kind}). Point at an image to see the {_standard(result)} in its place. Shown with "
        f"{brightened} stops, curve {escape(curve)}.</p>"
        f'<div class="cards" style="{style}">{"".join(cards)}</div>'
    )


class _Views(NamedTuple):
    """The addresses of an image and of its enlarged parts."""

    whole: str
    parts: list[str]

    @classmethod
    def of(cls, result: Outcome, image: np.ndarray, curve: str, stops: float) -> _Views:
        parts = [exact(inset.crop(image), curve, stops) for inset in result.insets]
        return cls(photograph(image, curve, stops), parts)


def _card(result: Outcome, views: _Views, caption: str, errors: str) -> str:
    """One image; what images are compared with has no map of errors, and nothing lies below it."""
    below = "over" if errors else ""
    frames = "".join(
        _frame(i, inset, result.settings.size) for i, inset in enumerate(result.insets)
    )
    crops = "".join(
        f'<span class="crop f{i % 3} {below}" style="--other:var(--part{i})">'
        f'<img alt="" src="{part}"></span>'
        for i, part in enumerate(views.parts)
    )
    bottom = f'<img alt="map of the error" src="{errors}">' if errors else ""
    return (
        f"<figure><figcaption>{caption}</figcaption>"
        f'<div class="whole {below}" style="--other:var(--whole)">'
        f'<img alt="" src="{views.whole}">{frames}</div>'
        f'<div class="crops">{crops}</div>{bottom}</figure>'
    )


def _frame(index: int, inset: Inset, size: tuple[int, int]) -> str:
    """Where an inset lies, in percent of the image."""
    left, top = 100 * inset.x / size[0], 100 * inset.y / size[1]
    width, height = 100 * inset.width / size[0], 100 * inset.height / size[1]
    return (
        f'<i class="f{index % 3}" style="left:{left:.2f}%;top:{top:.2f}%;'
        f'width:{width:.2f}%;height:{height:.2f}%"></i>'
    )


def _footer(results: Sequence[Outcome]) -> str:
    terms = "".join(
        f"<dt>{escape(name)}</dt><dd>{escape(text)}</dd>" for name, text in EXPLAINED.items()
    )
    settings = "".join(
        f"<dt>{escape(result.settings.name)}: {escape(entry.label)}</dt>"
        f"<dd><code>{escape(_settings(entry))}</code></dd>"
        for result in results
        for entry in result.entries
    )
    processors = ", ".join(dict.fromkeys(result.processor for result in results))
    return (
        "<footer><details><summary>What the columns mean</summary><p>With a an image, r the "
        "reference; ± is the standard error of the mean over the seeds.</p>"
        f"<dl>{terms}</dl></details>"
        f"<details><summary>Settings of the algorithms</summary><dl>{settings}</dl></details>"
        f"<p>pymlt {escape(_core.__version__)}, {escape(processors)}</p></footer>"
    )


def _settings(entry: Entry) -> str:
    if "program" in entry.settings:
        return str(entry.settings["program"])
    return " ".join(f"{key}={value}" for key, value in entry.settings.items() if key != "type")
