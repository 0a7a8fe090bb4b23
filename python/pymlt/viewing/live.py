"""A render that begins again whenever something changes, with small pictures first."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING

from .. import _core
from ..algorithms.integrator import as_integrator
from ..rendering.job import Job
from ..rendering.start import start

if TYPE_CHECKING:
    import numpy as np

DIVISORS = (8, 4, 2)  #: of the first pictures, which `path` makes with one sample a pixel
SMALLEST = 32  #: rows of a first picture


class Algorithm:
    """An integrator by name, with parameters as text: "max_depth=8, p_large=0.3"."""

    def __init__(self, name: str, parameters: str = ""):
        self.name, self.parameters = name, parameters

    def assignments(self) -> list[tuple[str, str]]:
        """Raises UsageError for what is not NAME=VALUE."""
        pairs = []
        for part in self.parameters.replace(";", ",").split(","):
            name, equals, value = part.partition("=")
            if part.strip() and not (equals and name.strip() and value.strip()):
                raise _core.UsageError(
                    f"{part.strip()!r} should be NAME=VALUE, such as max_depth=8"
                )
            if part.strip():
                pairs.append((name.strip(), value.strip()))
        return pairs

    def make(self, scene: _core.Scene) -> _core.Integrator:
        """Raises UsageError for an unknown name or parameter, or a value out of range."""
        return as_integrator(scene, self.name, self.assignments())


class LiveRender:
    """One render of a scene, or two side by side; used by one thread."""

    def __init__(self, threads: int = 0):
        self._threads = threads or os.cpu_count() or 1
        self._small: list[Callable[[], Job]] = []
        self._first: Job | None = None  # of those
        self._make: Callable[[], list[Job]] | None = None
        self._leaving: list[Job] = []  # cancelled, and soon at their ends
        self.jobs: list[Job] = []
        self._checked: list[Job] = []  # those that have ended
        self.small: np.ndarray | None = None  #: the first picture, of fewer pixels

    def start(
        self,
        scene: Callable[[int], _core.Scene],
        algorithms: list[Algorithm],
        seconds: float,
        *,
        lamps: bool = False,
    ) -> None:
        """Render `scene(1)` for so long, after `scene(divisor)` for first pictures.

        With `lamps` the light of each is kept.

        Raises UsageError or SceneError, and then what went before goes on.
        """
        full = scene(1)
        made = [algorithm.make(full) for algorithm in algorithms]
        threads = max(1, self._threads // len(made))
        self.stop()
        self.small = None
        rows = [d for d in DIVISORS if full.height // d >= SMALLEST]
        self._small = [
            lambda d=d: start(scene(d), "path", spp=1, threads=self._threads) for d in rows
        ]
        self._make = lambda: [
            start(full, integrator, time=seconds, threads=threads, light_groups=lamps)
            for integrator in made
        ]
        self._next()

    def _next(self) -> None:
        self._first = self._small.pop(0)() if self._small else None
        if self._first is None and self._make is not None:
            make, self._make = self._make, None
            self._checked = []
            self.jobs = make()

    def advance(self, seconds: float = 0) -> bool:
        """Waits at most so long for the next first picture; True if there is one."""
        self._leaving = [job for job in self._leaving if not job.ended]
        if self._first is None:
            return False
        try:
            if not self._first.wait(seconds):
                return False
            self.small = self._first.image
        except _core.RenderError:
            pass  # the render itself will say so
        self._next()
        return True

    @property
    def is_early(self) -> bool:
        """Whether first pictures are still to come."""
        return self._first is not None

    @property
    def running(self) -> bool:
        return self.is_early or any(not job.ended for job in self.jobs)

    def check(self) -> None:
        """Raises what has gone wrong in a render; once."""
        for job in [job for job in self.jobs if job.ended and job not in self._checked]:
            self._checked.append(job)
            job.wait(0)

    def image(self, index: int = 0) -> np.ndarray | None:
        """What there is of one of the renders, or None: less than one sample per pixel."""
        if index >= len(self.jobs):
            return None
        job = self.jobs[index]
        return job.image if job.samples >= 1 or (job.ended and job.samples > 0) else None

    def stop(self) -> None:
        """End it soon; images stay until the next start."""
        self._small, self._make = [], None
        for job in [*self.jobs, *([self._first] if self._first else [])]:
            if not job.ended:
                job.cancel()
                self._leaving.append(job)
        self._first = None

    def discard(self) -> None:
        """End it and forget it."""
        self.stop()
        self.jobs, self.small = [], None

    def resume(self, seconds: float) -> bool:
        """Go on with renders that were stopped, for this many seconds; False if that cannot be.

        Those that were stopped before their first sample cannot.
        """
        if not self.jobs or not all(job.wait(5) for job in self.jobs):
            return False
        if not all(job.samples > 0 for job in self.jobs):
            return False
        for job in self.jobs:
            spent = job.stats["seconds"]
            job.extend(time=spent["bootstrap"] + spent["render"] + seconds)
        return True
