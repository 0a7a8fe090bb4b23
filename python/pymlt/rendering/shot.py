"""Shots: frames that are rendered one after the other, and how much they flicker."""

from __future__ import annotations

import math
import os
import warnings
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from .. import _core
from ..algorithms.integrator import IntegratorLike, as_integrator
from ..formats.loading import SceneLike, SensorLike, as_scene
from .bands import finish
from .frames import Frames, Timing, check_pattern, file_of, parse_frames, runs, stands_still
from .frames import timing as checked_timing
from .job import Job
from .options import RenderOptions
from .progress import progress_bar
from .result import Result
from .stats import Stats
from .temporal import Rendered, denoised, guides_of_frames, still
from .windows import IntegratorOf, Window, WindowRender, faded, frames_together, whole, windows


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
    def denoised_flicker(self) -> float | None:
        """The root of the mean square of `stats["denoised_flicker"]`; None if none is known."""
        return _root_mean_square(frame.stats.get("denoised_flicker") for frame in self.frames)

    @property
    def stats(self) -> dict[str, Any]:
        """What `--stats` writes of a shot."""
        frames = [
            {"frame": f.number, "files": f.files, "flicker": f.flicker, "stats": f.stats}
            for f in self.frames
        ]
        whole = {"error": self.error, "flicker": self.flicker, "skipped": self.skipped}
        if self.denoised_flicker is not None:
            whole["denoised_flicker"] = self.denoised_flicker
        return {**whole, "frames": frames}


def _root_mean_square(values) -> float | None:
    known = [value for value in values if value is not None]
    return math.sqrt(sum(v * v for v in known) / len(known)) if known else None


def root_of_squares(errors: list[float | None]) -> float | None:
    """The error of a sum of what is independent; None if one is not known, or there is none."""
    known = [error for error in errors if error is not None]
    return math.hypot(*known) if known and len(known) == len(errors) else None


def frames_to_render(
    frames: list[int], patterns: list[str], skip_existing: bool
) -> tuple[list[int], list[int]]:
    """The frames to be rendered, and those of which all files exist, if these are skipped."""

    def exists(frame: int) -> bool:
        return skip_existing and all(os.path.exists(file_of(p, frame)) for p in patterns)

    return [f for f in frames if not exists(f)], [f for f in frames if exists(f)]


Wait = Callable[[Job, float], object]


def render_frames(
    scene: _core.Scene,
    integrator_of: IntegratorOf,
    timing: Timing,
    frames: list[int],
    options: RenderOptions,
    wait: Wait,
    together: int | None,
) -> Rendered:
    """Each frame's number, the result of its render, and its flicker. None after a render that was
    cancelled, whose frames are not among them. `wait` waits for a render of so many frames."""
    if not frames:
        return
    most = frames_together(scene, integrator_of(scene), options, together)
    for run in runs(scene, timing, frames):
        shown = [run[0][-1], *(moment[0] for moment in run[1:])]

        def start(window: Window) -> WindowRender:
            render = WindowRender(scene, integrator_of, timing, window)
            frames = sum(window.weights)
            finish(render.start(options), lambda job: wait(job, frames))
            return render

        rendered = alone(start, shown) if most == 1 else together_in(start, windows(shown, most))
        if options.denoise:
            rendered = denoised(rendered, guides_of_frames(scene, timing, options))
        for moment, (_, result, flicker) in zip(run, rendered, strict=False):
            yield moment[0], result, flicker
            yield from ((frame, still(result), 0.0) for frame in moment[1:])


def alone(start: Callable[[Window], WindowRender], frames: list[int]) -> Rendered:
    before: WindowRender | None = None
    for frame in frames:
        render = start(whole([frame]))
        if render.job.cancelled:
            return
        yield frame, render.result(0), None if before is None else render.job.flicker(before.job)
        before = render


def together_in(start: Callable[[Window], WindowRender], shared: list[Window]) -> Rendered:
    """The frames of windows that follow each other, each when all of its renders have ended."""
    first, last = shared[0].frames[0], shared[-1].frames[-1]
    fading: dict[int, Result] = {}
    changes: defaultdict[int, list[float | None]] = defaultdict(list)
    for window in shared:
        render = start(window)
        if render.job.cancelled:
            return
        for place in range(len(window.frames) + 1):
            frame = window.frames[0] + place
            if first < frame <= last:
                changes[frame].append(render.change(place))
        for place, frame in enumerate(window.frames):
            result, weight = render.result(place), window.weights[place]
            if frame in fading:
                result = faded(fading.pop(frame), result, weight)
            elif weight < 1:
                fading[frame] = result
                continue
            yield frame, result, root_of_squares(changes[frame])


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
    one; there is no `checkpoint`. With `denoise`, frames are mixed with their neighbours, too,
    where that lowers their error. `progress` is that of `render`. Warns of a shot in which nothing
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

        def wait(job: Job, frames: float) -> None:
            ended = len(shot.frames)
            job.wait(progress=lambda share: show((ended + frames * share) / len(to_come), {}))

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
