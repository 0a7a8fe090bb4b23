"""Races with their reports: made of runs that are done, and shown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .. import _core
from ..diagnostics.metrics import relative_square
from .insets import Inset, choose_insets
from .report import Report
from .result import Entry, Outcome, Settings
from .score import Judge


@dataclass
class RaceResult(Outcome, Report):
    """A race on one scene, as `equal_time` returns it.

    `print` shows its table, a notebook its page; `Report` has what else there is to see.
    """

    def _races(self) -> Sequence[Outcome]:
        return [self]


@dataclass
class Race(Report):
    """Races on several scenes, for one table and one page; see `Report`."""

    results: list[RaceResult]

    def _races(self) -> Sequence[Outcome]:
        return self.results


def judged(
    settings: Settings,
    entries: list[Entry],
    references: Sequence[np.ndarray],
    insets: int | list[Inset],
    interrupted: bool,
) -> RaceResult:
    """The result of a race whose runs are done. Raises RenderError if there is no image."""
    finished = [entry for entry in entries if entry.runs]
    if not finished:
        problems = "; ".join(f"{entry.label}: {entry.problem}" for entry in entries)
        raise _core.RenderError(f"{settings.name}: no algorithm has left an image: {problems}")
    images = [[run.image for run in entry.runs] for entry in finished]
    judge = Judge.with_reference(references) if references else Judge.between_seeds(images)
    maps = []
    for entry, own in zip(finished, images, strict=True):
        _score(entry, judge)
        errors = judge.errors(own) or [relative_square(x, judge.scale) for x in own]
        order = np.argsort([error.mean() for error in errors])
        entry.shown = int(order[(len(order) - 1) // 2])
        maps.append(np.mean(errors, axis=0))
    own_error = float(judge.own_error.mean()) if references else None
    parts = choose_insets(maps, insets) if isinstance(insets, int) else insets
    return RaceResult(settings, entries, judge.scale, own_error, parts, interrupted)


def _score(entry: Entry, judge: Judge) -> None:
    """At each time, from the runs that had an image by then."""
    count = len(entry.runs[0].snapshots)
    for i in range(count):
        taken = [s for run in entry.runs if (s := run.snapshots[i]) is not None]
        score = None
        if len(taken) == len(entry.runs):
            seconds = float(np.mean([s.seconds for s in taken]))
            score = judge.score([s.image for s in taken], seconds, flip=i == count - 1)
        entry.scores.append(score)
