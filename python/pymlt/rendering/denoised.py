"""Renders whose image is denoised while they run, with the error that is left."""

from __future__ import annotations

import math
import weakref
from dataclasses import replace
from typing import TYPE_CHECKING

from .. import _core
from .._extras import import_extra
from ..pictures.denoising import denoise_halves, denoise_with_layers, guides_of, how
from ..pictures.halves import Pair
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
        self.error: float | None = None  #: of the denoised image, when it was last made
        self._bound = math.nan
        self._samples = 0.0

    def image(self, noisy: np.ndarray, layers: dict[str, np.ndarray]) -> tuple[np.ndarray, dict]:
        """The image without most of its noise, and its error as layers.

        Without two halves of the render there is no such error. Raises RenderError if the filter
        fails.
        """
        samples, halves = self._job.spp_done, self._job.halves()
        if halves is None or "error" not in layers:
            noisy = self._job.image_without_fireflies()
            return denoise_with_layers(noisy, layers, {}).image, {}
        raw, robust = (Pair(*images) for images in zip(*halves, strict=True))
        found = denoise_halves(noisy, raw, robust, layers)
        self.error, self._bound, self._samples = found.relative, found.bound, samples
        return found.image, {"denoised_error": found.error}

    def judge(self) -> None:
        """Before the job starts: its budget bounds the error of the denoised image."""
        found = weakref.WeakMethod(self._upper_bound)  # which the job would keep alive for ever
        self._job.judge_by(lambda: bound() if (bound := found()) else math.nan)

    def _upper_bound(self) -> float:
        """That of the error, or nan; where the goal is far off, a guess."""
        if self._samples > 0:
            guess = self._bound * math.sqrt(self._samples / self._job.spp_done)
            if guess > SOONER * self.goal:
                return guess
        self.image(self._job.image(), self._job.layers())
        return self._bound

    def denoised(self, result: Result) -> Result:
        """A snapshot of the job, denoised; one that cannot be says so in its warnings."""
        layers, stats = result.layers, dict(result.stats)
        try:
            image, error = self.image(layers.get("unfiltered", result.image), layers)
        except _core.RenderError as failure:
            stats["warnings"] = [*stats["warnings"], f"{failure}; the image is not denoised"]
            return replace(result, stats=stats)
        if error:
            stats["denoised_error"] = self.error
        return replace(
            result,
            image=image,
            stats=stats,
            layers=layers | {"noisy": result.image} | error,
            metadata=result.metadata | {"denoised": how(guides_of(layers))},
        )
