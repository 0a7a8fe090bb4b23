"""Windows of a shot: frames that follow each other and that one render has."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

from .. import _core
from ..pictures.halves import Pair
from .denoised import pairs
from .frames import Timing, scene_at
from .job import Job
from .options import RenderOptions, integer
from .result import Result
from .temporal import Halved, faded_halves, filtered_alone

IntegratorOf = Callable[[_core.Scene], _core.Integrator]

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
}


def frames_together(
    scene: _core.Scene, integrator: _core.Integrator, options: RenderOptions, together: int | None
) -> int:
    """How many frames one render has at most. Raises UsageError."""
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


@dataclass(frozen=True)
class Window:
    """Frames that follow each other, and the weights of their images from one render.

    Windows that follow each other share frames, whose weights fall in the first one and rise in the
    next, so that one render fades into the other.
    """

    frames: list[int]
    weights: list[float]

    def weight(self, place: int) -> float:
        return self.weights[place] if 0 <= place < len(self.frames) else 0.0


def windows(run: list[int], most: int) -> list[Window]:
    """Windows of this many frames at most, alike in length, for frames that follow each other.

    A quarter of `most` is shared by two.
    """
    shared = most // 4
    count = max(1, math.ceil((len(run) - shared) / (most - shared)))
    starts = [i * (len(run) - shared) // count for i in range(count + 1)]
    fade = [(i + 1) / (shared + 1) for i in range(shared)]
    found = []
    for first, end in pairwise(starts):
        frames = run[first : end + shared]
        rise = fade if first > 0 else [1.0] * shared
        fall = fade[::-1] if end + shared < len(run) else [1.0] * shared
        plain = len(frames) - 2 * shared
        found.append(Window(frames, rise + [1.0] * plain + fall) if count > 1 else whole(run))
    return found


def whole(frames: list[int]) -> Window:
    return Window(frames, [1.0] * len(frames))


class WindowRender:
    """The render of a window."""

    def __init__(
        self, scene: _core.Scene, integrator_of: IntegratorOf, timing: Timing, window: Window
    ):
        self.window = window
        self.count = len(window.frames)
        self.scene = scene_at(scene, timing, window.frames)
        self.integrator = integrator_of(self.scene)
        if self.count > 1:
            self.integrator = _core.with_light_layers(self.integrator, False, [], exposures=True)

    def start(self, options: RenderOptions, *, goes_on: bool = False) -> Job:
        """Begins, or goes on from its checkpoint."""
        self.denoise = options.denoise
        if self.count > 1:
            spp, time = options.spp, options.time
            if spp is None and time is None:
                spp = self.scene.info()["sample_count"]
            own = sum(self.window.weights)
            options = replace(options, spp=spp and spp * own, time=time and time * own)
            options = replace(options, seed=options.seed + self.window.frames[0], denoise=False)
        self.job = Job(self.scene, self.integrator, options)
        if goes_on and options.checkpoint:
            _core.Checkpoint(os.fspath(options.checkpoint)).resume(self.job._job)
        return self.job._start()

    @cached_property
    def whole(self) -> Result:
        """The result of the render, which has all its layers."""
        return filtered_alone(self.job) if self.count == 1 else self.job.result()

    def error(self, place: int) -> float | None:
        """The relative error of a frame."""
        return self.job._job.relative_error(place) if self.count > 1 else self.job.error

    def result(self, place: int) -> Result:
        """That of the frame at this place."""
        if self.count == 1:
            return self.whole
        name = f"exposure.{place + 1}"
        error = self.whole.layers.get("error." + name)
        frames = sum(self.window.weights)
        spp = self.whole.stats["spp_done"] / frames
        stats = {k: v for k, v in self.whole.stats.items() if k not in OF_WHOLE_IMAGES}
        stats |= {"exposures": self.count, "error": self.error(place), "spp_done": spp}
        stats["seconds"] = {part: s / frames for part, s in self.whole.stats["seconds"].items()}
        metadata = {k: v for k, v in self.whole.metadata.items() if k != "light_groups"}
        found = replace(
            self.whole,
            image=self.whole.layers[name] * self.count,
            layers={} if error is None else {"error": error * self.count},
            stats=stats,
            metadata=metadata | {"spp": f"{spp}"},
        )
        return Halved(**vars(found), halves=self.halves(place)) if self.denoise else found

    def halves(self, place: int) -> tuple[Pair, Pair] | None:
        """Those of the frame at this place, as they are and without fireflies."""
        halves = self.job._job.halves(place)
        if halves is None:
            return None
        raw, robust = pairs(halves)
        return raw.times(self.count), robust.times(self.count)

    def change(self, place: int) -> float | None:
        """The error of what the render contributes to the change from the frame before a place to
        the one there; relative to either frame, as far as it has them."""
        before, after = self.window.weight(place - 1), self.window.weight(place)
        if after == 0:
            error = self.error(place - 1)
            return None if error is None else before * error
        if before == 0:
            error = self.error(place)
        else:
            job = self.job._job
            error = job.flicker(job, place, place - 1, before / after)
        return None if error is None else after * error


#: Statistics of the image of all frames of a window together.
OF_WHOLE_IMAGES = {"block_error", "pixels_carrying_error", "disagreements"}


def faded(before: Result, after: Result, weight: float) -> Result:
    """A frame that two renders share, of which the second one has this weight."""

    def both(a, b):
        known = a is not None and b is not None
        return (((1 - weight) * a) ** 2 + (weight * b) ** 2) ** 0.5 if known else None

    error = both(before.stats["error"], after.stats["error"])
    layer = both(before.layers.get("error"), after.layers.get("error"))
    spp = (1 - weight) * before.stats["spp_done"] + weight * after.stats["spp_done"]
    seeds = f"{before.metadata['seed']} {after.metadata['seed']}"
    return replace(
        after,
        image=(1 - weight) * before.image + weight * after.image,
        layers={} if layer is None else {"error": layer},
        stats=after.stats | {"error": error, "spp_done": spp},
        metadata=after.metadata | {"seed": seeds, "spp": f"{spp}"},
        **faded_halves(before, after, weight),
    )
