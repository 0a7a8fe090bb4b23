"""A race as a page of the documentation: tables in Markdown, and a picture for each scene."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pymlt as mlt
from pymlt.race.report.table import Column, columns, heading, notes, summary, summary_title

HEAD = """\
# The algorithms compared

Every algorithm had the same CPU time for each image. What the columns mean, and how to repeat this,
is said in [Races](race.md); this page was made by `benchmarks/mlt_equal_time.py`. ± is the standard
error over the seeds, the smallest error is bold.
"""


def markdown(columns: Sequence[Column]) -> str:
    """Columns as a table."""
    rows = [
        [f"**{c}**" if row == column.best else c for row, c in enumerate(column.cells)]
        for column in columns
    ]
    lines = [
        "| " + " | ".join(column.title for column in columns) + " |",
        "|---|" + "---:|" * (len(columns) - 1),
        *("| " + " | ".join(cells) + " |" for cells in zip(*rows, strict=True)),
    ]
    return "\n".join(lines)


def section(result: mlt.RaceResult, picture: str) -> str:
    """One scene."""
    labels = Column("algorithm", [entry.label for entry in result.ranked])
    remarks = "".join(f"- {note}\n" for note in notes(result))
    return (
        f"## {result.settings.name}\n\n{heading(result)}.\n\n"
        f"{markdown([labels, *columns(result)])}\n\n{remarks}\n"
        f"![{result.settings.name} by each algorithm]({picture})\n"
    )


def write_page(race: mlt.Race, path: Path) -> None:
    """Pictures go to the folder images beside the page."""
    folder = path.parent / "images"
    folder.mkdir(parents=True, exist_ok=True)
    parts = [HEAD]
    if len(race.results) > 1:
        parts.append(f"{summary_title(race.results)}.\n\n{markdown(summary(race.results))}\n")
    for result in race.results:
        name = f"race-{result.settings.name}.jpg"
        result.figure(tonemap="filmic").savefig(folder / name, dpi=80, pil_kwargs={"quality": 85})
        parts.append(section(result, f"images/{name}"))
    path.write_text("\n".join(parts))
