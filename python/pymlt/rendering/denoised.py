"""Renders whose image is denoised while they run, with the error that is left."""

from __future__ import annotations

import math
import weakref
from dataclasses import replace
from typing import TYPE_CHECKING

from .. import _core
from .._extras import import_extra
from ..pictures.denoising import denoise_halves, denoise_with_layers, guides_of, how
from ..pictures.halves import Mixture, Pair
from .result import Result

if TYPE_CHECKING:
    import numpy as np

#: The layers that guide the filter.
GUIDES = "albedo,sh_normal"
#: How much faster than with the square root of the samples the error may fall.
SOONER = 1.2


class Denoising:
    """Denoises what a job has so far."""

    def __init__(self, job: _core.Job):
        import_extra("pyoidn", "denoise", "denoising")
        self._job = job
        self.goal = 0.0  #: the error that ends the render, if any does
        self.found: Mixture | None = None  #: when it was last made
        self._samples = 0.0

    @property
    def error(self) -> float | None:
        """That of the denoised image, when it was last made."""
        return None if self.found is None else self.found.relative

    def image(self, noisy: np.ndarray, layers: dict[str, np.ndarray]) -> tuple[np.ndarray, dict]:
        """The image without most of its noise, and its error as layers.

        Without two halves of the render there is no such error. Raises RenderError if the filter
        fails.
        """
        samples, halves = self._job.spp_done, self._job.halves()
        if halves is None or "error" not in layers:
            noisy = self._job.image_without_fireflies()
            return denoise_with_layers(noisy, layers, {}).image, {}
        self.found, self._samples = denoise_halves(noisy, *pairs(halves), layers), samples
        return self.found.image, {"denoised_error": self.found.error}

    def judge(self) -> None:
        """Before the job starts: its budget bounds the error of the denoised image."""
        found = weakref.WeakMethod(self._upper_bound)  # which the job would keep alive for ever
        self._job.judge_by(lambda: bound() if (bound := found()) else math.nan)

    def _upper_bound(self) -> float:
        """That of the error, or nan; where the goal is far off, a guess."""
        if self.found is not None:
            guess = self.found.bound * math.sqrt(self._samples / self._job.spp_done)
            if guess > SOONER * self.goal:
                return guess
        self.image(self._job.image(), self._job.layers())
        return math.nan if self.found is None else self.found.bound

    def denoised(self, result: Result) -> Result:
        """A snapshot of the job, denoised; one that cannot be says so in its warnings."""
        try:
            image, error = self.image(result.layers.get("unfiltered", result.image), result.layers)
        except _core.RenderError as failure:
            return undenoised(result, failure)
        return with_denoised(result, image, error, self.error if error else None)


def pairs(halves: tuple) -> tuple[Pair, Pair]:
    """The two of a render, as they are and without fireflies."""
    raw, robust = (Pair(*images) for images in zip(*halves, strict=True))
    return raw, robust


def with_denoised(
    result: Result, image: np.ndarray, error: dict[str, np.ndarray], relative: float | None
) -> Result:
    """A result with its denoised image, and the error of that if it is known."""
    return replace(
        result,
        image=image,
        stats=result.stats | ({} if relative is None else {"denoised_error": relative}),
        layers=result.layers | {"noisy": result.image} | error,
        metadata=result.metadata | {"denoised": how(guides_of(result.layers))},
    )


def undenoised(result: Result, failure: _core.RenderError) -> Result:
    """A result that the filter has failed on, which says so in its warnings."""
    warning = f"{failure}; the image is not denoised"
    return replace(result, stats=result.stats | {"warnings": [*result.stats["warnings"], warning]})
