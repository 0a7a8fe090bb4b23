"""The numbers of a race as rows and columns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp, log
from statistics import median
from typing import TYPE_CHECKING

from ..score import Mean

if TYPE_CHECKING:
    from ..result import Entry, Outcome

EMPTY = "–"
UNEQUAL = 0.1  #: of the budget: a time that is farther from it is remarked upon
APART = 0.05  #: of the level of the others: one that is farther from it is remarked upon


@dataclass(frozen=True)
class Column:
    """One number of each algorithm."""

    title: str
    cells: list[str]
    best: int | None = None  #: the row with the smallest error


def columns(result: Outcome) -> list[Column]:
    """All numbers of a race; what nobody has is left out."""
    entries = result.ranked
    scores = [entry.score for entry in entries if entry.score is not None]
    made = [
        _errors("relMSE", [score.relmse for score in scores]),
        Column("over best", list(map(_ratio, ratios(result)))),
        Column("median seed", [_number(score.median) for score in scores]),
        _errors("trimmed", [score.trimmed for score in scores]),
        _errors("median pixel", [score.pixel_median for score in scores]),
        _errors("90 % of pixels", [score.percentile_90 for score in scores]),
        _errors("shape", [score.shape for score in scores]),
        Column("level", [str(score.level) for score in scores]),
        Column("spread", [_number(score.level_spread, 2) for score in scores]),
        Column("sparks", [_number(score.sparks) for score in scores]),
        _errors("FLIP", [score.flip for score in scores]),
        Column("CPU s", [f"{score.seconds:.3g}" for score in scores]),
        Column("spp", [_number(entry.spp) for entry in entries]),
    ]
    return [column for column in made if any(cell != EMPTY for cell in column.cells)]


def ratios(result: Outcome) -> list[float | None]:
    """relMSE of each algorithm over the smallest one; None where either is not known."""
    values = [_relmse(entry) for entry in result.ranked]
    known = [value for value in values if value is not None and value > 0]
    return [value / min(known) if known and value is not None else None for value in values]


def _relmse(entry: Entry) -> float | None:
    return None if entry.score is None or entry.score.relmse is None else entry.score.relmse.value


def _errors(title: str, means: Sequence[Mean | None]) -> Column:
    values = [mean.value if mean else float("inf") for mean in means]
    best = values.index(min(values)) if len(values) > 1 and any(means) else None
    return Column(title, [str(mean) if mean else EMPTY for mean in means], best)


def _number(value: float | None, digits: int = 3) -> str:
    return EMPTY if value is None else f"{value:.{digits}g}"


def _ratio(value: float | None) -> str:
    return _number(value, 2) if value is None or value < 100 else f"{value:.0f}"


def heading(result: Outcome) -> str:
    """What was measured."""
    settings = result.settings
    width, height = settings.size
    threads = f" on each of {settings.threads} threads" if settings.threads > 1 else ""
    seeds = f"{settings.repeats} seeds" if settings.repeats > 1 else "one seed"
    return f"{width} x {height}, {settings.seconds:g} CPU seconds{threads}, {seeds}"


def notes(result: Outcome) -> list[str]:
    """What a reader must know, one sentence each."""
    made = []
    if result.interrupted:
        counts = ", ".join(f"{len(entry.runs)} of {entry.label}" for entry in result.entries)
        made.append(f"Interrupted; there are images: {counts}.")
    made += [f"{e.label} has left the race: {e.problem}" for e in result.entries if e.problem]
    for entry in result.entries:
        if invalid := sum(run.invalid for run in entry.runs):
            made.append(f"{entry.label}: {invalid} samples are not numbers and count as 0.")
    budget = result.settings.seconds * result.settings.threads
    made += [
        f"{entry.label} took {entry.score.seconds:.3g} CPU seconds instead of {budget:g}."
        for entry in result.ranked
        if entry.score and abs(entry.score.seconds / budget - 1) > UNEQUAL
    ]
    if result.reference_error is None:
        made.append(
            "Without a reference errors are the spread of the seeds, which sees neither light that "
            "nobody finds nor any other bias. Level is relative to the median of the algorithms."
        )
        made += levels_apart(result.ranked)
        if all(len(entry.runs) < 2 for entry in result.ranked):
            made.append("One image has no error: give a reference, or more seeds.")
    elif result.reference_error > 0:
        made.append(
            f"The reference's own relMSE, {result.reference_error:.2g}, is subtracted, but from "
            "neither the median pixel nor 90 % of pixels."
        )
    return made


def levels_apart(entries: Sequence[Entry]) -> list[str]:
    """Who shows another amount of light than most; a bias that errors between seeds do not show."""
    levels = {entry.label: entry.score.level for entry in entries if entry.score}
    middle = median(level.value for level in levels.values()) if levels else 1.0
    return [
        f"{label} is {100 * abs(level.value / middle - 1):.0f} % "
        f"{'brighter' if level.value > middle else 'darker'} than the median of the algorithms, "
        "which its error does not show."
        for label, level in levels.items()
        if abs(level.value - middle) > max(APART * middle, 4 * (level.error or 0))
    ]


def table(result: Outcome) -> str:
    """As text, with a line above."""
    labels = Column("algorithm", [entry.label for entry in result.ranked])
    return f"{result.settings.name}: {heading(result)}\n{aligned([labels, *columns(result)])}"


def aligned(columns: Sequence[Column]) -> str:
    """Columns as lines of text: the first one to the left, others to the right."""
    widths = [max(map(len, [column.title, *column.cells])) for column in columns]
    lines = zip(*([column.title, *column.cells] for column in columns), strict=True)
    return "\n".join(
        "  ".join(
            cell.rjust(width) if i else cell.ljust(width)
            for i, (cell, width) in enumerate(zip(line, widths, strict=True))
        ).rstrip()
        for line in lines
    )


def summary_title(results: Sequence[Outcome]) -> str:
    """What `summary` shows, and on which scenes it is no error."""
    blind = [result.settings.name for result in results if result.reference_error is None]
    spread = f"; without a reference, by the spread of the seeds: {', '.join(blind)}"
    return "relMSE over that of the best algorithm" + (spread if blind else "")


def summary(results: Sequence[Outcome]) -> list[Column]:
    """relMSE over the best, for each algorithm and scene, and their geometric mean."""
    labels = list(dict.fromkeys(entry.label for result in results for entry in result.ranked))
    made, found = [Column("algorithm", labels)], []
    for result in results:
        own = dict(zip([entry.label for entry in result.ranked], ratios(result), strict=True))
        found.append([own.get(label) for label in labels])
        made.append(_ratios(result.settings.name, found[-1]))
    rows = [[ratio for ratio in row if ratio and ratio > 0] for row in zip(*found, strict=True)]
    whole = [exp(sum(map(log, r)) / len(r)) if len(r) == len(results) else None for r in rows]
    return [*made, _ratios("geometric mean", whole)]


def _ratios(title: str, values: Sequence[float | None]) -> Column:
    known = [value for value in values if value is not None]
    best = values.index(min(known)) if known else None
    return Column(title, list(map(_ratio, values)), best)


def summary_table(results: Sequence[Outcome]) -> str:
    """The same as text."""
    return f"{summary_title(results)}\n{aligned(summary(results))}"
