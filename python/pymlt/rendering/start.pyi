# Made by `python -m pymlt._stubs`. Do not edit.
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..algorithms.integrator import IntegratorLike
from ..formats.loading import SceneLike, SensorLike
from .bands import Bands
from .job import Job
from .result import Replay, Result

def render(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    spp: float | None = None,
    time: float | None = None,
    error: float | str | None = None,
    seed: int = 0,
    threads: int = 0,
    checkpoint: str | os.PathLike | None = None,
    every: float = 60,
    overwrite: bool = False,
    aovs: str | Sequence[str] | None = None,
    light_groups: bool = False,
    light_layers: Mapping[str, str] | None = None,
    alpha: bool = False,
    fireflies: str = "keep",
    denoise: bool = False,
    cluster: Any = None,
    sensor: SensorLike | None = None,
    spectral: bool = False,
    progress: bool | Callable[[float], object] | None = None,
    callback: Callable[[Result], object] | None = None,
    interval: float = 1,
) -> NDArray[np.float32]: ...
def render_bands(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    spp: float | None = None,
    time: float | None = None,
    error: float | str | None = None,
    seed: int = 0,
    threads: int = 0,
    aovs: str | Sequence[str] | None = None,
    light_groups: bool = False,
    light_layers: Mapping[str, str] | None = None,
    alpha: bool = False,
    fireflies: str = "keep",
    denoise: bool = False,
    cluster: Any = None,
    bands: Bands,
    sensor: SensorLike | None = None,
    spectral: bool = False,
    progress: bool | Callable[[float], object] | None = None,
) -> Result: ...
def render_progressive(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    interval: float = 1,
    **settings: Any,
) -> Iterator[Result]: ...
def replay(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    pixel: tuple[int, int],
    sample: int = 0,
    seed: int = 0,
    sensor: SensorLike | None = None,
    spectral: bool = False,
) -> Replay: ...
def resume(
    path: str | os.PathLike,
    *,
    spp: float | None = None,
    time: float | None = None,
    error: float | str | None = None,
    threads: int = 0,
    checkpoint: str | os.PathLike | None = None,
    every: float = 60,
    overwrite: bool = False,
    aovs: str | Sequence[str] | None = None,
    alpha: bool = False,
    fireflies: str = "keep",
    denoise: bool = False,
    cluster: Any = None,
    scene: SceneLike | None = None,
) -> Job: ...
def start(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    spp: float | None = None,
    time: float | None = None,
    error: float | str | None = None,
    seed: int = 0,
    threads: int = 0,
    checkpoint: str | os.PathLike | None = None,
    every: float = 60,
    overwrite: bool = False,
    aovs: str | Sequence[str] | None = None,
    light_groups: bool = False,
    light_layers: Mapping[str, str] | None = None,
    alpha: bool = False,
    fireflies: str = "keep",
    denoise: bool = False,
    cluster: Any = None,
    sensor: SensorLike | None = None,
    spectral: bool = False,
) -> Job: ...
