"""A render in progress."""

from __future__ import annotations

import atexit
import contextlib
import json
import math
import os
import weakref
from collections.abc import Callable
from time import monotonic
from typing import TYPE_CHECKING

from .. import _core
from ..pictures.tonemapping import Exposure
from .denoised import GUIDES, Denoising
from .notebook import show
from .options import RenderOptions, integer, light_classes, number, relative_error, seconds
from .progress import progress_bar
from .result import Groups, Replay, Result
from .stats import Stats
from .summary import percent

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_running: weakref.WeakSet[Job] = weakref.WeakSet()


class Job:
    """A render in progress; made by `start`."""

    def __init__(self, scene: _core.Scene, integrator: _core.Integrator, options: RenderOptions):
        self._scene = scene
        self._integrator = _core.with_light_layers(
            integrator, options.light_groups, light_classes(options.light_layers)
        )
        self._options = options
        self._cluster = options.cluster
        self._filters = options.fireflies == "groups"
        self._job = _core.Job(
            scene,
            self._integrator,
            options.spp,
            options.time,
            options.error,
            options.seed,
            options.threads,
            _core.CheckpointFile(options.checkpoint or "", options.every, options.overwrite),
            GUIDES if options.denoise and options.aovs is None else options.aovs,
            options.alpha,
        )
        self._denoising = Denoising(self._job) if options.denoise else None
        if self._denoising is not None:
            self._denoising.goal = options.error or 0.0
            self._denoising.judge()

    def _start(self) -> Job:
        if self._cluster is not None:
            from .cluster.executor import ClusterExecutor

            self._job.attach(ClusterExecutor(self._scene, self._integrator, self._cluster))
        self._job.start()
        _running.add(self)
        # No thread of the job may hold the last reference to it.
        weakref.finalize(self, _end, self._job).atexit = False
        return self

    @property
    def image(self) -> NDArray[np.float32]:
        """The image so far: float32, (height, width, 3), linear, row 0 on top."""
        return self._job.image_without_fireflies() if self._filters else self._job.image()

    @property
    def stats(self) -> Stats:
        """What the render tells about itself so far, as `--stats` writes it; times in seconds."""
        return json.loads(self._job.stats())

    @property
    def filter(self) -> str:
        """The reconstruction filter of the scene's film, such as "box"."""
        return self._scene.info()["filter"]

    @property
    def groups(self) -> Groups:
        """What the independent groups have seen so far."""
        return Groups(*self._job.groups())

    @property
    def light_groups(self) -> list[str]:
        """The names of the layers of lamps, with `light_groups=True`."""
        return self._job.light_groups

    def light(self) -> dict[str, NDArray[np.float32]]:
        """The light of each lamp so far, by the names of these layers; it adds up to the image."""
        return self._job.light()

    @property
    def error(self) -> float | None:
        """The relative error so far, as `stats["error"]` has it after the end; None if unknown.

        It costs about as much as making the image of each group.
        """
        return self._job.relative_error()

    def flicker(self, before: Job) -> float | None:
        """The relative error of the change from the image of another render to this one's.

        Both have ended, are of the same size and by the same integrator. None if it is not known.
        """
        return self._job.flicker(before._job)

    def denoised(self) -> NDArray[np.float32]:
        """The image so far without most of its noise, like that of a result with `denoise=True`.

        Raises UsageError without the extra `denoise`.
        """
        self._denoising = self._denoising or Denoising(self._job)
        return self._denoising.image(self._job.image(), self._job.layers())[0]

    @property
    def _figures(self) -> dict[str, str]:
        """What a progress bar tells of it while it runs."""
        known = {"spp": f"{self.samples:.4g}"}
        if self.denoised_error is not None:
            known["error"] = percent(self.denoised_error)
        return known

    @property
    def _seen(self) -> NDArray[np.float32]:
        """What is to be shown of it while it runs."""
        return self.denoised() if self._options.denoise else self.image

    @property
    def denoised_error(self) -> float | None:
        """The relative error of the denoised image when it was last made; None if unknown."""
        return None if self._denoising is None else self._denoising.error

    @property
    def error_map(self) -> NDArray[np.float32] | None:
        """The standard error of each pixel so far; see `Result.error_map`."""
        return self._job.layers().get("error")

    def checkpoint(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Save the state of the render, now, to a file that `resume` goes on from.

        The units in flight are finished, and the render goes on. Raises FileError if the file
        cannot be written, exists and is no checkpoint, or is that of another render, unless
        `overwrite` is given.
        """
        self._job.checkpoint(os.fspath(path), overwrite)

    def extend(
        self,
        *,
        spp: float | None = None,
        time: float | None = None,
        error: float | None = None,
    ) -> None:
        """After the end: go on to a larger budget, counted from the very beginning.

        The image is the same as if the render had had this budget from the start. Raises UsageError
        if the render has not ended, or the budget is not larger.
        """
        goal = relative_error(error)
        if self._denoising is not None:
            self._denoising.goal = goal or 0.0
        self._job.extend(number("spp", spp), number("time", time), goal)

    def replay(self, pixel: tuple[int, int], sample: int = 0) -> Replay:
        """Repeat one sample of a pixel (x, y), whether it has been taken or not.

        `sample` counts from 0. What is asked for again shows the same paths, those that the render
        has added up (by `path` in single precision, here in double). For integrators that sample
        pixel by pixel; raises UsageError for others, and for a pixel outside of the image.
        """
        x, y = (integer("a coordinate of pixel", value, 2**31) for value in pixel)
        return Replay(*self._job.replay((x, y), integer("sample", sample, 2**36)))

    @property
    def has_alpha(self) -> bool:
        """Whether the result has alpha, by the argument or the film."""
        return self._job.has_alpha

    @property
    def samples(self) -> float:
        """Samples (or mutations) per pixel so far."""
        return self._job.spp_done

    @property
    def progress(self) -> float:
        """The share of the budget that is used up, 0 to 1."""
        return self._job.progress

    @property
    def ended(self) -> bool:
        """Whether nothing runs any more: the budget is used up, or the render was ended."""
        return self._job.ended

    @property
    def cancelled(self) -> bool:
        """Whether `cancel` was called."""
        return self._job.cancelled

    def cancel(self) -> None:
        """End the render soon; what has been rendered stays."""
        self._job.cancel()

    def wait(
        self,
        timeout: float | None = None,
        progress: bool | Callable[[float], object] | None = False,
        *,
        callback: Callable[[Result], object] | None = None,
        interval: float = 1,
    ) -> bool:
        """Wait for the end, at most `timeout` seconds; True if the render has ended.

        `callback` is called with a `snapshot` each `interval` seconds while the render runs; if it
        returns True the render ends. Ctrl-C ends the waiting, not the render. Raises what went
        wrong in the render; what had been rendered by then is the error's `result`.
        """
        interval = seconds("interval", interval)
        patience = math.inf if timeout is None else seconds("timeout", timeout)
        with progress_bar(progress) as show:
            end = monotonic() + patience
            next_call = monotonic() + interval
            while not self._ended(min(0.1, max(0.0, end - monotonic()))):
                if monotonic() >= end:
                    return False
                if progress is not False:
                    show(self.progress, self._figures)
                if callback is not None and monotonic() >= next_call:
                    if callback(self.snapshot()) is True:
                        self.cancel()
                    next_call = monotonic() + interval
        return True

    def _ended(self, seconds: float) -> bool:
        try:
            return self._job.wait(seconds)
        except _core.RenderError as error:
            if self._job.ended and self._job.spp_done > 0:  # not in a fork, whose locks may be held
                error.result = self.snapshot()
            raise

    def result(self) -> Result:
        """Wait for the end and return the image with everything known about it.

        Raises what `wait` raises.
        """
        self.wait()
        return self.snapshot()

    def snapshot(self) -> Result:
        """The image so far, with everything known about it."""
        settings = json.loads(self._integrator.settings)
        image, stats, layers = self.image, self.stats, self._job.layers()
        metadata = self._job.metadata()
        if self._filters:
            layers["unfiltered"] = self._job.image()
            seen = float(layers["unfiltered"].mean(dtype=float))
            removed = 1 - float(image.mean(dtype=float)) / seen if seen > 0 else 0.0
            stats["fireflies_removed"] = removed
            metadata["fireflies"] = f"groups: {100 * removed:.2g} % of the light is removed"
        result = Result(image, stats, settings, layers, metadata, self._scene.half)
        if self._denoising is None or not self._options.denoise:
            return result
        return self._denoising.denoised(result)

    def show(self, *, interval: float = 1, exposure: Exposure = 0) -> None:
        """Show the image in a notebook, and renew it each `interval` seconds until the render ends.

        `exposure` brightens it, in stops, or "auto". Interrupting the cell ends the showing, not
        the render. Needs IPython.
        """
        show(self, seconds("interval", interval), exposure)

    def __repr__(self) -> str:
        state = "cancelled" if self.cancelled else "ended" if self.ended else "running"
        return f"Job({state}, {100 * self.progress:.0f} %)"


os.register_at_fork(after_in_child=_running.clear)


@atexit.register
def _cancel_all() -> None:
    """No thread may outlive the interpreter."""
    for job in list(_running):
        _end(job._job)


def _end(job: _core.Job) -> None:
    job.cancel()
    while not job.ended:
        with contextlib.suppress(_core.Error):
            job.wait(1.0)
