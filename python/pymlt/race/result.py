"""What a race leaves: its settings, the runs of each algorithm, and their scores."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .cpu_time import processor
from .insets import Inset
from .run import Run
from .score import Score


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
    def image(self) -> NDArray[np.float32]:
        """Of the run with the median error: float32, (height, width, 3), linear."""
        return self.runs[self.shown].image

    @property
    def spp(self) -> float | None:
        """Samples (or mutations) per pixel, the mean over the runs; None if they are not known."""
        known = [run.spp for run in self.runs if run.spp is not None]
        return float(np.mean(known)) if known else None


@dataclass
class Outcome:
    """A race on one scene."""

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
