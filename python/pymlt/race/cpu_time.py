"""CPU time: renders that end when they have used so much of it.

Times are CPU seconds of the whole process (user and system, all threads), which a busy machine
stretches far less than wall time.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from time import process_time
from typing import NamedTuple

from .. import _core
from ..algorithms.integrator import IntegratorLike
from ..rendering.result import Result
from ..rendering.start import start
from .run import Snapshot

ENDLESS = 1e9  #: samples per pixel: the time ends the render


class TimedRender(NamedTuple):
    """A render that was given CPU time."""

    result: Result
    seconds: float  #: what it took
    snapshots: list[Snapshot | None]  #: by the way; None where there was no sample yet


def render_for(
    scene: _core.Scene,
    integrator: IntegratorLike,
    cpu_seconds: float,
    *,
    seed: int,
    threads: int,
    times: Sequence[float] = (),
    watch: Callable[[float], object] = lambda share: None,
) -> TimedRender:
    """Render until this process has used `cpu_seconds` of CPU time.

    Bootstrap and adaptation count, loading the scene does not. Images are taken at `times`, rising
    shares of the budget; `watch` is called all the while with the share that is used, and what it
    raises ends the render.
    """
    begun = process_time()
    job = start(scene, integrator, spp=ENDLESS, seed=seed, threads=threads)
    snapshots: list[Snapshot | None] = []
    try:
        while (used := process_time() - begun) < cpu_seconds and not job.wait(0.01):
            watch(used / cpu_seconds)
            if len(snapshots) < len(times) and used >= times[len(snapshots)] * cpu_seconds:
                has_image = job.stats["spp_done"] > 0
                snapshots.append(Snapshot(used, job.image) if has_image else None)
    finally:
        job.cancel()
    job.wait()
    used = process_time() - begun
    snapshots += [None] * (len(times) - len(snapshots))
    return TimedRender(job.result(), used, snapshots)


def processor() -> str:
    """The class of the processor, and how many of them."""
    model = "unknown processor"
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                model = line.partition(":")[2].strip()
                break
    return f"{model}, {os.cpu_count()} logical processors"
