"""`equal_time`: algorithms take turns on one scene, and their images are compared."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from .. import _core
from ..formats.loading import SceneLike, as_scene
from ..rendering.options import integer, number
from ..rendering.progress import progress_bar
from .algorithm import AlgorithmLike, contestants
from .insets import check_insets
from .races import RaceResult, judged
from .result import Entry, Settings
from .run import Conditions, Contestant
from .score import reference_images

TIMES = (1 / 8, 1 / 4, 1 / 2, 1)


def equal_time(
    algorithms: Sequence[AlgorithmLike],
    scene: SceneLike,
    reference: Any = None,
    *,
    seconds: float = 10,
    repeats: int = 3,
    threads: int = 0,
    seed: int = 0,
    times: Sequence[float] = TIMES,
    insets: int | Sequence[Sequence[int]] = 2,
    name: str | None = None,
    scene_file: str | os.PathLike[str] | None = None,
    progress: bool | Callable[[float], object] | None = None,
) -> RaceResult:
    """Give algorithms the same CPU time on a scene, in turn, and compare their errors.

    algorithms
        integrators such as `MLT(max_depth=8)`, dicts, names ("mlt", "pssmlt:p_large=0.5"), or
        outside programs (`Program`); or pairs (label, any of these).
    scene
        as for `start`.
    reference
        an image without noise, as an array (height, width, 3), a Result or a file. Or a list of
        independent images with noise: their mean is the reference, and its own error, which their
        spread tells, is subtracted. None: the images of different seeds tell each other's error,
        which then is that of their noise alone; an error that all have in common stays unseen, but
        for the level.
    seconds
        of CPU time for each thread of each image. Bootstrap and adaptation count, loading the scene
        counts for programs only.
    repeats
        how many images of each algorithm, with the seeds `seed`, `seed` + 1, ... It takes three to
        tell how good a comparison between seeds is.
    threads
        of each render; 0: as many as the machine has.
    times
        shares of the budget after which the error is measured.
    insets
        parts of the image for the pictures: how many, chosen where the algorithms differ most, or
        rectangles (x, y, width, height) in pixels.
    name
        of the scene, for tables; by default that of its file.
    scene_file
        what programs are told for {scene}; by default `scene`, if that is a file.
    progress
        True, False, None (a bar on a terminal and in a notebook) or a function of the fraction that
        is done.

    An algorithm that fails leaves the race, with `Entry.problem` set. Ctrl-C ends the race with the
    runs that are complete, and `RaceResult.interrupted` set; before the first of them it is raised.
    All images stay in memory. Raises UsageError for arguments that make no sense, what `start`
    raises for scenes and integrators, and RenderError if no algorithm leaves an image.
    """
    loaded = as_scene(scene)
    size = (loaded.width, loaded.height)
    settings = Settings(
        name or scene_name(scene),
        size,
        _positive("seconds", seconds),
        _count("repeats", repeats),
        integer("threads", threads, 4097) or os.cpu_count() or 1,
        integer("seed", seed, 2**63),
        _checked_times(times),
    )
    references = [] if reference is None else reference_images(reference, size)
    given = _count("insets", insets, 0) if isinstance(insets, int) else check_insets(insets, size)
    racers = contestants(algorithms, loaded)
    file = scene_file or (scene if isinstance(scene, str | os.PathLike) else None)
    with progress_bar(progress) as show:
        entries, interrupted = _race(
            racers, loaded, None if file is None else str(os.path.abspath(file)), settings, show
        )
    return judged(settings, entries, references, given, interrupted)


def _race(
    racers: list[Contestant],
    scene: _core.Scene,
    file: str | None,
    settings: Settings,
    show: Callable[[float, dict[str, str]], object],
) -> tuple[list[Entry], bool]:
    """All runs, one of each algorithm by turns; and whether they were interrupted."""
    entries = [Entry(racer.label, racer.settings) for racer in racers]
    total, done = len(racers) * settings.repeats, 0

    def watch(label: str, share: float) -> None:
        show(min(1.0, (done + share) / total), {"now": label})

    def attempt(racer: Contestant, entry: Entry, seed: int | None) -> None:
        """A run, or with no seed what comes before the first one."""
        told = partial(watch, racer.label)
        conditions = Conditions(
            scene, file, settings.seconds, settings.threads, settings.times, told
        )
        try:
            if seed is None:
                racer.prepare(conditions)
            else:
                entry.runs.append(racer.run(conditions, seed))
        except (_core.RenderError, _core.SceneError) as error:
            entry.problem = str(error)

    try:
        for seed in (None, *range(settings.seed, settings.seed + settings.repeats)):
            for racer, entry in zip(racers, entries, strict=True):
                if not entry.problem:
                    attempt(racer, entry, seed)
                done += seed is not None
    except KeyboardInterrupt:
        if not any(entry.runs for entry in entries):
            raise
        return entries, True
    return entries, False


def scene_name(scene: SceneLike) -> str:
    """What to call a scene: by its file, or by the file's folder if that is called scene."""
    if not isinstance(scene, str | os.PathLike):
        return "scene"
    path = Path(os.path.abspath(scene))
    return path.parent.name if path.stem == "scene" and path.parent.name else path.stem


def _positive(name: str, value: float) -> float:
    checked = number(name, value)
    if checked is None or not 0 < checked < float("inf"):
        raise _core.UsageError(f"{name} is {value!r}, but should be a number above 0")
    return checked


def _count(name: str, value: int, least: int = 1) -> int:
    if integer(name, value, 2**31) < least:
        raise _core.UsageError(f"{name} is {value!r}, but should be at least {least}")
    return value


def _checked_times(times: Sequence[float]) -> tuple[float, ...]:
    """Rising, and with the whole budget at the end."""
    shares = [_positive("a time", share) for share in times]
    if any(share > 1 for share in shares):
        raise _core.UsageError(f"times are {times!r}, but should be shares of the budget, up to 1")
    return tuple(sorted({*shares, 1.0}))
