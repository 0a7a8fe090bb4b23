"""What a race leaves: scores, images, and how to show them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .. import _core
from ..diagnostics.metrics import relative_square
from .cpu_time import processor
from .report import Report
from .report.insets import Inset, choose_insets
from .run import Run
from .score import Judge, Score


@dataclass(frozen=True)
class Settings:
    """What a race was about; see `equal_time`."""

    name: str
    size: tuple[int, int]  #: of the images, (width, height)
    seconds: float  #: of CPU time for each thread of an image
    repeats: int
    threads: int
    seed: int
    times: tuple[float, ...]  #: at which errors were measured, as shares of the budget


@dataclass
class Entry:
    """One algorithm in a race."""

    label: str
    settings: dict[str, Any]  #: type and parameters, or the command of a program
    runs: list[Run] = field(default_factory=list, repr=False)  #: one for each seed
    problem: str = ""  #: why it has left the race; "" if it has not
    scores: list[Score | None] = field(default_factory=list)  #: one for each time
    shown: int = 0  #: which run pictures show: that with the median error

    @property
    def score(self) -> Score | None:
        """After the whole time; None if there is no image."""
        return self.scores[-1] if self.scores else None

    @property
    def image(self) -> np.ndarray:
        """Of the run with the median error: float32, (height, width, 3), linear."""
        return self.runs[self.shown].image

    @property
    def spp(self) -> float | None:
        """Samples (or mutations) per pixel, the mean over the runs; None if they are not known."""
        known = [run.spp for run in self.runs if run.spp is not None]
        return float(np.mean(known)) if known else None


@dataclass
class RaceResult(Report):
    """A race on one scene, as `equal_time` returns it.

    `print` shows its table, a notebook its page; `Report` has what else there is to see.
    """

    settings: Settings
    entries: list[Entry]
    scale: np.ndarray = field(repr=False)
    """What errors are relative to, float64, (height, width, 3): the reference; without one the
    median, pixel by pixel, of the algorithms' mean images."""
    reference_error: float | None
    """relMSE of the reference itself, which is subtracted; 0 if it was given as one image, None if
    there is no reference."""
    insets: list[Inset]  #: parts of the image that pictures enlarge
    interrupted: bool = False  #: by Ctrl-C: there are fewer runs than were asked for
    processor: str = field(default_factory=processor)  #: its class

    def _races(self) -> Sequence[RaceResult]:
        return [self]

    @property
    def ranked(self) -> list[Entry]:
        """Those that have an image, in the order in which they were given."""
        return [entry for entry in self.entries if entry.score is not None]

    def __getitem__(self, label: str) -> Entry:
        """The algorithm of this label. Raises KeyError."""
        for entry in self.entries:
            if entry.label == label:
                return entry
        raise KeyError(label)


@dataclass
class Race(Report):
    """Races on several scenes, for one table and one page; see `Report`."""

    results: list[RaceResult]

    def _races(self) -> Sequence[RaceResult]:
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
