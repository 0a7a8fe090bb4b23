"""What the renders of the frames of a shot leave behind."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from .stats import Stats


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
