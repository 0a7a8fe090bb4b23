"""Denoised frames of a shot, each with some of its neighbours where that makes it better."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from .. import _core
from ..pictures.denoising import denoise_halves
from ..pictures.halves import Mixture, Pair
from ..pictures.over_time import error_of_change, mean_over_time
from .denoised import GUIDES, undenoised, with_denoised
from .first_seen import first_seen
from .frames import Timing, scene_at
from .job import Job
from .options import RenderOptions
from .result import Result

if TYPE_CHECKING:
    import numpy as np

Rendered = Iterator[tuple[int, Result, float | None]]
GuidesOf = Callable[[int], dict[str, "np.ndarray"]]


@dataclass
class Halved(Result):
    """A frame with what its halves tell of it."""

    #: as they are and without fireflies, if there are enough groups; until it is denoised
    halves: tuple[Pair, Pair] | None = field(default=None, repr=False)
    found: Mixture | None = field(default=None, repr=False)  #: when it is denoised


def faded_halves(before: Result, after: Result, weight: float) -> dict[str, Any]:
    """Those of a frame that two renders share, of which the second one has this weight."""
    import numpy as np

    if not (isinstance(before, Halved) and isinstance(after, Halved)):
        return {}
    if before.halves is None or after.halves is None:
        return {"halves": None}
    both = zip(before.halves, after.halves, strict=True)
    return {"halves": tuple(first.mixed(second, np.float32(weight)) for first, second in both)}


def filtered_alone(job: Job) -> Result:
    """The result of a render of one frame, which is denoised if the render was asked to do so."""
    result = job.result()
    if job._denoising is None or "noisy" not in result.layers:
        return result
    return Halved(**vars(result), found=job._denoising.found)


def guides_of_frames(scene: _core.Scene, timing: Timing, options: RenderOptions) -> GuidesOf:
    """What guides the filter in a frame."""

    def guides(frame: int) -> dict[str, np.ndarray]:
        seen = scene_at(scene, timing, [frame])
        layers = first_seen(seen, aovs=GUIDES, seed=options.seed, threads=options.threads)
        return {name: layers[name] for name in GUIDES.split(",")}

    return guides


def denoised(rendered: Rendered, guides: GuidesOf) -> Rendered:
    """Frames that follow each other, each when the next one has been rendered.

    Frames of windows are denoised, with these guides; those that were rendered alone are already.
    """
    before = last = None
    now: tuple[int, Result, float | None] | None = None
    for frame, result, flicker in rendered:
        if isinstance(result, Halved) and "noisy" not in result.layers:
            result = filtered(result, guides(frame))
        if now is not None:
            last = over_time(now[1], [before, result], last)
            yield now[0], last, now[2]
            before = now[1]
        now = frame, result, flicker
    if now is not None:
        yield now[0], over_time(now[1], [before], last), now[2]


def filtered(frame: Halved, guides: dict[str, np.ndarray]) -> Result:
    """A frame, denoised; one that cannot be says so in its warnings."""
    frame = replace(frame, layers=frame.layers | guides)
    try:
        if frame.halves is None:
            return frame.denoise()
        found = denoise_halves(frame.image, *frame.halves, frame.layers)
    except _core.RenderError as failure:
        return undenoised(frame, failure)
    error = {"denoised_error": found.error}
    clean = with_denoised(frame, found.image, error, found.relative)
    return replace(clean, halves=None, found=found)


def over_time(frame: Result, neighbours: list[Result | None], last: Result | None) -> Result:
    """A denoised frame with some of its neighbours; `last` is what the one before has become."""
    mixture = found_of(frame)
    if mixture is None:
        return frame
    found = mean_over_time(mixture, [m for n in neighbours if (m := found_of(n)) is not None])
    stats = frame.stats | {"denoised_error": found.relative}
    if (before := found_of(last)) is not None:
        stats["denoised_flicker"] = error_of_change(before, found)
    layers = frame.layers | {"denoised_error": found.error}
    return replace(frame, image=found.image, stats=stats, layers=layers, found=found)


def found_of(frame: Result | None) -> Mixture | None:
    return frame.found if isinstance(frame, Halved) else None


def still(result: Result) -> Result:
    """A frame that shows the same as the one before."""
    if "denoised_flicker" not in result.stats:
        return result
    return replace(result, stats=result.stats | {"denoised_flicker": 0.0})
