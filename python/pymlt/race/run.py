"""What takes part in a race, under which conditions, and what one run of it leaves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .. import _core


@dataclass(frozen=True)
class Snapshot:
    """An image, and the CPU time that it took."""

    seconds: float  #: of CPU time, all threads together
    image: NDArray[np.float32] = field(repr=False)  #: float32, (height, width, 3), linear


@dataclass(frozen=True)
class Run:
    """One render of a race."""

    seed: int
    snapshots: list[Snapshot | None]  #: one for each time; None where there was no sample yet
    spp: float | None = None  #: samples (or mutations) per pixel, where they are known
    invalid: int = 0  #: samples of the last image that were no numbers, and count as 0

    @property
    def image(self) -> NDArray[np.float32]:
        """The last image: float32, (height, width, 3), linear."""
        return self._last.image

    @property
    def seconds(self) -> float:
        """CPU time of the last image, all threads together."""
        return self._last.seconds

    @property
    def _last(self) -> Snapshot:
        last = self.snapshots[-1]
        assert last is not None
        return last


@dataclass(frozen=True)
class Conditions:
    """What is the same for all runs of a race."""

    scene: _core.Scene
    scene_file: str | None  #: where outside programs find the scene
    seconds: float  #: of CPU time for each thread
    threads: int
    times: tuple[float, ...]  #: at which images are taken, as shares of the budget; the last is 1
    watch: Callable[[float], None]  #: told the share of a run that is done; may raise

    @property
    def budget(self) -> float:
        """CPU seconds of a run, all threads together."""
        return self.seconds * self.threads


class Contestant(Protocol):
    """An algorithm or a program that takes part."""

    @property
    def label(self) -> str: ...

    @property
    def settings(self) -> dict[str, Any]:
        """What JSON is to say of it."""

    def prepare(self, conditions: Conditions) -> None:
        """Before the first run; what is measured here counts nowhere."""

    def run(self, conditions: Conditions, seed: int) -> Run:
        """Raises RenderError if there is no image."""


def finite(image: np.ndarray) -> tuple[np.ndarray, int]:
    """The image with 0 for what is no number, and how many samples that were."""
    bad = ~np.isfinite(image)
    return np.where(bad, np.float32(0), image).astype(np.float32), int(bad.sum())
