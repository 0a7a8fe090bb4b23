"""Shots: frames that are rendered one after the other, and how much they flicker."""

from __future__ import annotations

import json
import math
import os
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from .. import _core
from ..algorithms.integrator import IntegratorLike, as_integrator
from ..formats.loading import SceneLike, SensorLike, as_scene
from .bands import finish
from .frames import (
    Frames,
    Timing,
    check_pattern,
    file_of,
    parse_frames,
    scene_at,
    stands_still,
    windows,
)
from .frames import timing as checked_timing
from .job import Job
from .options import RenderOptions, integer
from .progress import progress_bar
from .result import Result
from .stats import Stats

IntegratorOf = Callable[[_core.Scene], _core.Integrator]


@dataclass
class Frame:
    """A frame of a shot that has been rendered."""

    number: int
    files: list[str]  #: where its image is
    stats: Stats  #: what its render tells about itself
    #: the relative error of the change from the frame before; None for the first frame, and if it
    #: is not known
    flicker: float | None


@dataclass
class Shot:
    """What the renders of the frames of a shot left behind."""

    frames: list[Frame] = field(default_factory=list)
    skipped: list[int] = field(default_factory=list)  #: frames whose files existed

    @property
    def error(self) -> float | None:
        """The root of the mean square of the frames' `stats["error"]`."""
        return _root_mean_square(frame.stats.get("error") for frame in self.frames)

    @property
    def flicker(self) -> float | None:
        """The root of the mean square of the flicker of frames."""
        return _root_mean_square(frame.flicker for frame in self.frames)

    @property
    def stats(self) -> dict[str, Any]:
        """What `--stats` writes of a shot."""
        frames = [
            {"frame": f.number, "files": f.files, "flicker": f.flicker, "stats": f.stats}
            for f in self.frames
        ]
        whole = {"error": self.error, "flicker": self.flicker, "skipped": self.skipped}
        return {**whole, "frames": frames}


def _root_mean_square(values) -> float | None:
    known = [value for value in values if value is not None]
    return math.sqrt(sum(v * v for v in known) / len(known)) if known else None


def frames_to_render(
    frames: list[int], patterns: list[str], skip_existing: bool
) -> tuple[list[int], list[int]]:
    """The frames to be rendered, and those of which all files exist, if these are skipped."""

    def exists(frame: int) -> bool:
        return skip_existing and all(os.path.exists(file_of(p, frame)) for p in patterns)

    return [f for f in frames if not exists(f)], [f for f in frames if exists(f)]


#: Bytes that a render of several frames may take, and the most frames.
MOST_BYTES, MOST_TOGETHER = 4 * 2**30, 16
#: Bytes of a pixel on the films of a layer: of chains and of samples 24 each, in 16 groups.
BYTES_PER_PIXEL = 2 * 24 * 16

#: Options that renders of several frames do not have, and what they are if they are not given.
ALONE = {
    "error": None,
    "aovs": None,
    "light_groups": False,
    "light_layers": None,
    "alpha": False,
    "fireflies": "keep",
    "denoise": False,
}


def frames_together(
    scene: _core.Scene, integrator: _core.Integrator, options: RenderOptions, together: int | None
) -> int:
    """How many frames one render has. Raises UsageError."""
    alone = [name for name, usual in ALONE.items() if getattr(options, name) != usual]
    if together is not None:
        together = max(1, integer("together", together, 64))
        if together > 1 and alone:
            raise _core.UsageError(f"frames that are rendered together have no {alone[0]}")
        return together
    if alone or json.loads(integrator.settings)["type"] != "mlt":
        return 1
    width, height = scene.info()["size"]
    bytes_per_film = BYTES_PER_PIXEL * width * height
    return min(MOST_TOGETHER, max(1, MOST_BYTES // bytes_per_film - 1))


class Window:
    """The render of some frames that follow each other."""

    def __init__(
        self, scene: _core.Scene, integrator_of: IntegratorOf, timing: Timing, frames: list[int]
    ):
        self.frames = frames
        self.scene = scene_at(scene, timing, frames)
        self.integrator = integrator_of(self.scene)
        if len(frames) > 1:
            self.integrator = _core.with_light_layers(self.integrator, False, [], exposures=True)

    def start(self, options: RenderOptions) -> Job:
        count = len(self.frames)
        if count > 1:
            spp, time = options.spp, options.time
            if spp is None and time is None:
                spp = self.scene.info()["sample_count"]
            options = replace(options, spp=spp and spp * count, time=time and time * count)
        self.job = Job(self.scene, self.integrator, options)._start()
        return self.job

    @cached_property
    def whole(self) -> Result:
        """The result of the render, which has all its layers."""
        return self.job.result()

    def result(self, place: int) -> Result:
        """That of the frame at this place."""
        whole, count = self.whole, len(self.frames)
        if count == 1:
            return whole
        name = f"exposure.{place + 1}"
        error = whole.layers.get("error." + name)
        stats = {k: v for k, v in whole.stats.items() if k not in OF_WHOLE_IMAGES}
        stats |= {"exposures": count, "error": self.job._job.relative_error(place)}
        return replace(
            whole,
            image=whole.layers[name] * count,
            layers={} if error is None else {"error": error * count},
            stats=stats,
        )

    def flicker(self, place: int, before: Window | None) -> float | None:
        """That of the frame at this place, if it follows another one, or the window before."""
        if place > 0:
            return self.job._job.flicker(self.job._job, place, place - 1)
        count = len(self.frames)
        if before is None or before.frames[-1] != self.frames[0] - 1:
            return None
        if len(before.frames) != count:
            return None  # their images have other scales
        if count == 1:
            return self.job.flicker(before.job)
        return self.job._job.flicker(before.job._job, 0, count - 1)


#: Statistics of the image of all frames of a window together.
OF_WHOLE_IMAGES = {"block_error", "pixels_carrying_error", "disagreements"}


def render_frames(
    scene: _core.Scene,
    integrator_of: IntegratorOf,
    timing: Timing,
    frames: list[int],
    options: RenderOptions,
    wait: Callable[[Job], object],
    together: int | None,
) -> Iterator[tuple[int, Result, float | None]]:
    """Each frame's number, the result of its render, and its flicker. None after a render that was
    cancelled, whose frames are not among them."""
    if not frames:
        return
    most = frames_together(scene, integrator_of(scene), options, together)
    before: Window | None = None
    for run in windows(frames, most):
        window = Window(scene, integrator_of, timing, run)
        finish(window.start(options), wait)
        if window.job.cancelled:
            return
        for place, frame in enumerate(run):
            yield frame, window.result(place), window.flicker(place, before)
        before = window


def render_shot(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    frames: Frames,
    output: str | os.PathLike[str],
    fps: float = 24,
    shutter: float = 0.5,
    skip_existing: bool = False,
    together: int | None = None,
    sensor: SensorLike | None = None,
    spectral: bool = False,
    progress: bool | Callable[[float], object] | None = None,
    **settings: Any,
) -> Shot:
    """Render the frames of a shot to files, one after the other, all with the same seed.

    frames
        "1:24" from the first to the last, "1:24,31" more of them, a number, or numbers.
    output
        the files, as in "shot.####.exr" or "shot.%04d.exr".
    fps, shutter
        frame f is seen from the time f / fps of the scene's animations on, while the shutter is
        open, for this share of a frame.
    skip_existing
        whether frames whose files exist are left out.
    together
        how many frames that follow each other one render has. None: for `mlt`, whose noise then
        changes as slowly as the picture, 16 or as many as 4 GB hold, else 1.

    The other arguments are those of `start`, and hold for each frame: `spp` and `time` are those of
    one; there is no `checkpoint`. `progress` is that of `render`. Warns of a shot in which nothing
    moves. Raises UsageError for frames, files and times that make no sense, and what `render`
    raises.
    """
    options = RenderOptions(**settings)
    if options.checkpoint is not None:
        raise _core.UsageError("a shot has no checkpoint; skip_existing=True goes on with one")
    numbers, pattern = parse_frames(frames), check_pattern(output)
    when = checked_timing(fps, shutter)
    scene = as_scene(scene, sensor, spectral)
    if warning := stands_still(scene, when, numbers):
        warnings.warn(warning, stacklevel=2)
    to_come, skipped = frames_to_render(numbers, [pattern], skip_existing)
    shot = Shot(skipped=skipped)
    with progress_bar(progress) as show:

        def wait(job: Job) -> None:
            ended, own = len(shot.frames), max(1, len(job.light_groups))
            job.wait(progress=lambda share: show((ended + own * share) / len(to_come), {}))

        for frame, result, flicker in render_frames(
            scene,
            lambda seen: as_integrator(seen, integrator),
            when,
            to_come,
            options,
            wait,
            together,
        ):
            result.write(file_of(pattern, frame))
            shot.frames.append(Frame(frame, [file_of(pattern, frame)], result.stats, flicker))
    return shot
