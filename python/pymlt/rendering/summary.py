"""A render in one line: what was done, and how good it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

    from .stats import Stats


def summary(algorithm: str, image: np.ndarray, stats: Stats) -> str:
    """What was done, with the error, or why there is none; nothing of it while the render runs."""
    height, width = image.shape[:2]
    done = f"{algorithm}, {width} x {height}, {stats['spp_done']:.4g} spp"
    if seconds := stats.get("seconds"):  # not of a merged one
        done += f" in {seconds['bootstrap'] + seconds['render']:.1f} s"
    error = stats.get("error")
    if error is not None:
        done += f", error {percent(error)}"
    elif stats.get("ended_by"):
        done += ", too few samples to know the error" if image.any() else ", no light and no error"
    if "denoised_error" in stats:
        done += f", denoised {percent(stats['denoised_error'])}"
    return done


def percent(error: float) -> str:
    """A relative error as people read it."""
    return f"{100 * error:{'.0f' if error >= 0.1 else '.2g'}} %"
