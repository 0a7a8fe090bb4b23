# Made by `python -m pymlt._stubs`. Do not edit.
import os
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from ..algorithms.integrator import IntegratorLike
from ..formats.loading import SceneLike, SensorLike
from .bands import Bands
from .job import Job
from .result import Replay, Result

def render(
    scene: SceneLike,
    integrator: IntegratorLike | None = ...,
    *,
    spp: float | None = ...,
    time: float | None = ...,
    error: float | str | None = ...,
    seed: int = ...,
    threads: int = ...,
    checkpoint: str | os.PathLike | None = ...,
    every: float = ...,
    overwrite: bool = ...,
    aovs: str | Sequence[str] | None = ...,
    alpha: bool = ...,
    fireflies: str = ...,
    cluster: Any = ...,
    sensor: SensorLike | None = ...,
    spectral: bool = ...,
    progress: bool | Callable[[float], object] | None = ...,
    callback: Callable[[Result], object] | None = ...,
    interval: float = ...,
) -> np.ndarray: ...
def render_bands(
    scene: SceneLike,
    integrator: IntegratorLike | None = ...,
    *,
    spp: float | None = ...,
    time: float | None = ...,
    error: float | str | None = ...,
    seed: int = ...,
    threads: int = ...,
    aovs: str | Sequence[str] | None = ...,
    alpha: bool = ...,
    fireflies: str = ...,
    cluster: Any = ...,
    bands: Bands,
    sensor: SensorLike | None = ...,
    spectral: bool = ...,
    progress: bool | Callable[[float], object] | None = ...,
) -> Result: ...
def render_progressive(
    scene: SceneLike,
    integrator: IntegratorLike | None = ...,
    *,
    interval: float = ...,
    **settings: Any,
) -> Iterator[Result]: ...
def replay(
    scene: SceneLike,
    integrator: IntegratorLike | None = ...,
    *,
    pixel: tuple[int, int],
    sample: int = ...,
    seed: int = ...,
    sensor: SensorLike | None = ...,
    spectral: bool = ...,
) -> Replay: ...
def resume(
    path: str | os.PathLike,
    *,
    spp: float | None = ...,
    time: float | None = ...,
    error: float | str | None = ...,
    threads: int = ...,
    checkpoint: str | os.PathLike | None = ...,
    every: float = ...,
    overwrite: bool = ...,
    aovs: str | Sequence[str] | None = ...,
    alpha: bool = ...,
    fireflies: str = ...,
    cluster: Any = ...,
    scene: SceneLike | None = ...,
) -> Job: ...
def start(
    scene: SceneLike,
    integrator: IntegratorLike | None = ...,
    *,
    spp: float | None = ...,
    time: float | None = ...,
    error: float | str | None = ...,
    seed: int = ...,
    threads: int = ...,
    checkpoint: str | os.PathLike | None = ...,
    every: float = ...,
    overwrite: bool = ...,
    aovs: str | Sequence[str] | None = ...,
    alpha: bool = ...,
    fireflies: str = ...,
    cluster: Any = ...,
    sensor: SensorLike | None = ...,
    spectral: bool = ...,
) -> Job: ...
