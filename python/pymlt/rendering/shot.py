"""Shots: frames that are rendered one after the other, and how much they flicker."""

from __future__ import annotations

import math
import os
import warnings
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
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
from .shot_checkpoint import ShotCheckpoint, kept_shot, shot_record
from .shot_result import Frame, Shot
from .temporal import Rendered, denoised, guides_of_frames, still
from .windows import IntegratorOf, Window, WindowRender, faded, frames_together, whole, windows


def root_of_squares(errors: list[float | None]) -> float | None:
    """The error of a sum of what is independent; None if one is not known, or there is none."""
    known = [error for error in errors if error is not None]
    return math.hypot(*known) if known and len(known) == len(errors) else None


def frames_to_render(frames: list[int], patterns: list[str], skip_existing: bool) -> list[int]:
    """The frames, without those of which all files exist, if these are skipped."""

    def exists(frame: int) -> bool:
        return skip_existing and all(os.path.exists(file_of(p, frame)) for p in patterns)

    return [f for f in frames if not exists(f)]


Wait = Callable[[Job, float], object]


def render_frames(
    scene: _core.Scene,
    integrator_of: IntegratorOf,
    timing: Timing,
    kept: ShotCheckpoint,
    options: RenderOptions,
    wait: Wait,
    together: int | None,
) -> Rendered:
    """The number, the result and the flicker of each frame to come that `kept` has not done. None
    after a render that was cancelled, whose frames are not among them. `wait` waits for a render of
    so many frames. What asks for the next frame has written the one before."""
    if kept.complete or not kept.to_come:
        return
    most = frames_together(scene, integrator_of(scene), options, together)
    for run in runs(scene, timing, kept.to_come):
        shown = {run[0][-1]: run[0], **{moment[0]: moment for moment in run[1:]}}

        def start(window: Window) -> WindowRender:
            render = WindowRender(scene, integrator_of, timing, window)
            frames = sum(window.weights)
            job = render.start(kept.options_of(window, options), goes_on=kept.has_render(window))
            finish(job, lambda job: wait(job, frames))
            kept.interrupted = job.cancelled
            return render

        numbers = list(shown)
        if most == 1:
            rendered = alone(start, numbers, kept)
        else:
            rendered = together_in(start, windows(numbers, most), kept)
        if options.denoise:
            rendered = denoised(rendered, guides_of_frames(scene, timing, options))
        for frame, result, flicker in rendered:
            for number in shown[frame]:
                moves = number == shown[frame][0]
                own = result if moves else still(result)
                metadata = own.metadata | {"frame": f"{number}"}
                yield number, replace(own, metadata=metadata), flicker if moves else 0.0
        if kept.interrupted:
            return
    kept.end()


def alone(
    start: Callable[[Window], WindowRender], frames: list[int], kept: ShotCheckpoint
) -> Rendered:
    before: WindowRender | None = None
    for last, frame in pairwise((None, *frames)):
        window = whole([frame])
        if kept.has_done(window):
            continue
        if before is None and last is not None:  # the shot goes on with this frame
            before = start(whole([last]))
        kept.begin(window, last)
        render = start(window)
        if kept.interrupted:
            return
        yield frame, render.result(0), None if before is None else render.job.flicker(before.job)
        before = render


def together_in(
    start: Callable[[Window], WindowRender], shared: list[Window], kept: ShotCheckpoint
) -> Rendered:
    """The frames of windows that follow each other, each when all of its renders have ended."""
    first, last = shared[0].frames[0], shared[-1].frames[-1]
    for window in shared:
        if kept.has_done(window):
            continue
        kept.begin(window)
        render = start(window)
        if kept.interrupted:
            return
        for place in range(len(window.frames) + 1):
            frame = window.frames[0] + place
            if first < frame <= last:
                kept.changes.setdefault(frame, []).append(render.change(place))
        for place, frame in enumerate(window.frames):
            result, weight = render.result(place), window.weights[place]
            if frame in kept.fading:
                result = faded(kept.fading.pop(frame), result, weight)
            elif weight < 1:
                kept.fading[frame] = result
                continue
            yield frame, result, root_of_squares(kept.changes.pop(frame, []))


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
    resume: str | os.PathLike[str] | None = None,
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

    resume
        the checkpoint of this shot, given with the same arguments again: frames that are done are
        not rendered again, and the others end with the same pixels as if nothing had happened.

    The other arguments are those of `start`, and hold for each frame: `spp` and `time` are those of
    one. `checkpoint` tells which frames are done; the render in progress keeps its own beside it,
    with the number of its first frame added to the name. With `denoise`, frames are mixed with
    their neighbours, too, where that lowers their error, and there is no checkpoint. `progress` is
    that of `render`. Warns of a shot in which nothing moves. Raises UsageError for frames, files
    and times that make no sense and for the checkpoint of another shot, and what `render` raises.
    """
    options = RenderOptions(**settings)
    numbers, pattern = parse_frames(frames), check_pattern(output)
    when = checked_timing(fps, shutter)
    scene = as_scene(scene, sensor, spectral)

    def integrator_of(seen: _core.Scene) -> _core.Integrator:
        return as_integrator(seen, integrator)

    if warning := stands_still(scene, when, numbers):
        warnings.warn(warning, stacklevel=2)
    record = shot_record(scene, integrator_of(scene), options, when, numbers, [pattern], together)
    to_come = frames_to_render(numbers, [pattern], skip_existing)
    kept = kept_shot(options, resume, record, to_come)
    shot = kept.shot(numbers)
    with progress_bar(progress) as show:

        def wait(job: Job, frames: float) -> None:
            ended, all_frames = len(shot.frames), len(kept.to_come)
            job.wait(progress=lambda share: show((ended + frames * share) / all_frames, {}))

        for frame, result, flicker in render_frames(
            scene, integrator_of, when, kept, options, wait, together
        ):
            result.write(file_of(pattern, frame))
            shot.frames.append(Frame(frame, [file_of(pattern, frame)], result.stats, flicker))
    return shot
