"""The spectrum of a render: a layer for each band of wavelengths."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

from .. import _core
from .job import Job
from .result import Result

Bands = int | str | Sequence[float]

VISIBLE = (360.0, 830.0)
MOST = 1000
THINNEST = 0.01  # in nm; names have three decimals


class Band(NamedTuple):
    """An interval of wavelengths, in nm."""

    first: float
    last: float

    @property
    def layer(self) -> str:
        """The name of its layer, with decimal commas: points part the names of EXR files."""
        ends = f"{self.first:.6g}-{self.last:.6g}".replace(".", ",")
        return f"spectrum.{ends}nm"


def parse_bands(bands: Bands) -> list[Band]:
    """Equal bands: n, "n", (first, last, n) or "first:last:n". Raises UsageError."""
    first, last, n = _numbers(bands)
    if not VISIBLE[0] <= first < last <= VISIBLE[1]:
        raise _core.UsageError(
            f"bands is {bands!r}, but the ends should lie between {VISIBLE[0]:g} and "
            f"{VISIBLE[1]:g} nm, the lower one first"
        )
    if (last - first) / n < THINNEST:
        raise _core.UsageError(
            f"bands is {bands!r}, but bands should not be thinner than {THINNEST} nm"
        )
    ends = [first + (last - first) * i / n for i in range(n)] + [last]
    return list(map(Band, ends, ends[1:]))


def _numbers(bands: Bands) -> tuple[float, float, int]:
    parts = bands.split(":") if isinstance(bands, str) else bands
    parts = list(parts) if isinstance(parts, Sequence) else [parts]
    if len(parts) == 1:
        parts = [*VISIBLE, *parts]
    try:
        first, last, n = map(float, parts)
        if n.is_integer() and 1 <= n <= MOST and not isinstance(bands, bool):
            return first, last, int(n)
    except (TypeError, ValueError):
        pass
    raise _core.UsageError(
        f"bands is {bands!r}, but should be the number of bands, from 1 to {MOST}, or the ends in "
        "nm and the number, as in 400:700:10"
    )


def check_spectral(scene: _core.Scene, how: str) -> None:
    if not scene.info()["spectral"]:
        raise _core.UsageError(f"bands of wavelengths need a spectral scene; add {how}")


def share_of_time(seconds: float | None, bands: list[Band]) -> float | None:
    """The share of the image, and of each band."""
    return None if seconds is None else seconds / (1 + len(bands))


def add_bands(result: Result, job: Job, bands: list[Band], wait: Callable[[Job], object]) -> None:
    """Renders a layer for each band as `job` was rendered; none after one that was cancelled."""
    options = replace(job._options, aovs="", denoise=False)
    if job.denoised_error is not None and options.error is not None:
        options = replace(options, error=None, spp=job.samples)
    known = list(result.stats["warnings"])
    for band in bands:
        part = Job(job._scene.with_wavelengths(band), job._integrator, options)
        finish(part._start(), wait)
        if part.samples > 0:
            result.layers[band.layer] = part.image[..., :1].copy()
        new = [warning for warning in part.stats["warnings"] if warning not in known]
        result.stats["warnings"] += [f"{band.layer}: {warning}" for warning in new]
        if part.cancelled:
            return


def finish(job: Job, wait: Callable[[Job], object]) -> None:
    """Waits for its end, which comes soon if the waiting fails."""
    try:
        wait(job)
    except BaseException:
        job.cancel()
        raise
