"""Start a render and look at it, or just wait for the image."""

from __future__ import annotations

import functools
import os
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from .. import _core
from ..algorithms.integrator import IntegratorLike, as_integrator
from ..formats.loading import SceneLike, SensorLike, as_scene
from .bands import Bands, add_bands, check_spectral, finish, parse_bands, share_of_time
from .job import Job
from .options import RenderOptions, seconds, takes_options
from .progress import progress_bar
from .result import Replay, Result
from .saved import saved_job

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@takes_options
def start(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    sensor: SensorLike | None = None,
    spectral: bool = False,
    options: RenderOptions,
) -> Job:
    """Start a render and return at once.

    scene
        a Scene, a dict, or what `load` knows: the path of a file, or a built-in scene's name.
    integrator
        an object such as `Path(max_depth=8)`, a dict, or a name. None is the scene's own, else
        `mlt`. A name keeps what the scene says about what is to be rendered (max_depth,
        hide_emitters, strict_normals); an object or a dict means exactly what it says.
    sensor
        which of the scene's sensors sees it: counted from 0, or one of `Scene.sensors()`; or a dict
        for a sensor that is not in the scene, with its film. None is the first one, or that with
        which `scene` was loaded.
    spectral
        whether light has wavelengths instead of R, G and B; so it is too if the film says so.
    <options>

    Raises UsageError for options that make no sense, SceneError for such a scene or integrator, and
    FileError for files that cannot be read or a checkpoint that cannot be written. What goes wrong
    later is raised by `Job.wait` and `Job.result`.
    """
    scene = as_scene(scene, sensor, spectral)
    return Job(scene, as_integrator(scene, integrator), options)._start()


@functools.partial(takes_options, fixed=("seed", "light_groups", "light_layers"))
def resume(
    path: str | os.PathLike,
    *,
    scene: SceneLike | None = None,
    options: RenderOptions,
) -> Job:
    """Go on with a render that was saved in a checkpoint; the image ends with the same pixels.

    path
        the file. Raises FileError if it is foreign, truncated, damaged or of another build.
    scene
        None loads the scene from where it was. A Scene, a dict or another path for its XML file is
        needed if it has moved or was made from a dict. SceneError if it differs.
    spp, time, error
        budgets in place of those in the file, each counted from the very beginning: a finished
        render goes on if they are larger.
    threads
        as for `start`.
    checkpoint, every, overwrite
        where the state is kept from now on; None means `path`.
    cluster
        where to render, as for `start`; it need not be where the render began.
    """
    path = os.fspath(path)
    return saved_job(_core.Checkpoint(path), path, scene, options)._start()


@takes_options
def render(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    sensor: SensorLike | None = None,
    spectral: bool = False,
    options: RenderOptions,
    progress: bool | Callable[[float], object] | None = None,
    callback: Callable[[Result], object] | None = None,
    interval: float = 1,
) -> NDArray[np.float32]:
    """Render and return the image: float32, (height, width, 3), linear Rec. 709, row 0 on top.

    With `alpha` it has a fourth channel, by which the colours are multiplied, as in an .exr and not
    in a .png. The arguments are those of `start`. `progress` is True, False, None (a bar on a
    terminal and in a notebook) or a function of the fraction that is done. `callback` is a function
    of the Result so far, called each `interval` seconds; it ends the render by returning True.
    After Ctrl-C the KeyboardInterrupt carries what there is so far, a Result, as `error.result`; so
    does a RenderError, for a render that fails. Other errors are those of `start`.
    """
    import numpy as np

    scene = as_scene(scene, sensor, spectral)
    job = Job(scene, as_integrator(scene, integrator), options)._start()
    try:
        job.wait(progress=progress, callback=callback, interval=interval)
    except KeyboardInterrupt as interrupt:
        job.cancel()
        interrupt.result = job.result()
        raise
    except BaseException:
        job.cancel()
        raise
    if not (options.alpha or options.denoise):
        return job.image
    result = job.result()
    if not options.alpha:
        return result.image
    return np.concatenate([result.image, result.layers["alpha"]], axis=2)


@functools.partial(takes_options, fixed=("checkpoint", "every", "overwrite"))
def render_bands(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    bands: Bands,
    sensor: SensorLike | None = None,
    spectral: bool = False,
    options: RenderOptions,
    progress: bool | Callable[[float], object] | None = None,
) -> Result:
    """Render a spectral scene: the image, and a layer for each band of wavelengths.

    bands
        n: the visible wavelengths, 360 to 830 nm, in n equal bands; (400, 700, 10): ten bands
        between these ends. Both may be text, "12" and "400:700:10".

    `result.layers["spectrum.400-430nm"]` is the mean radiance per nm in that band: float32,
    (height, width, 1). The image and each band are renders of their own, with the same seed, of
    `spp` samples each or with an equal share of `time`. The other arguments are those of `start`,
    `progress` is that of `render`.

    Raises UsageError for bands that make no sense and for scenes that are not spectral, and what
    `render` raises. The image and the bands that there are so far are the error's `result`.
    """
    scene = as_scene(scene, sensor, spectral)
    check_spectral(scene, "spectral=True")
    intervals = parse_bands(bands)
    options = replace(options, time=share_of_time(options.time, intervals))
    job = Job(scene, as_integrator(scene, integrator), options)._start()
    result = None
    with progress_bar(progress) as show:
        renders, ended = 1 + len(intervals), 0

        def wait(part: Job) -> None:
            nonlocal ended
            part.wait(progress=lambda share: show((ended + share) / renders, {}))
            ended += 1

        try:
            finish(job, wait)
            result = job.result()
            add_bands(result, job, intervals, wait)
        except (KeyboardInterrupt, _core.RenderError) as error:
            if result is not None:
                error.result = result
            elif isinstance(error, KeyboardInterrupt):
                error.result = job.result()
            raise
    return result


def render_progressive(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    interval: float = 1,
    **settings: Any,
) -> Iterator[Result]:
    """Render and look at it: `for snapshot in render_progressive(scene, spp=256): ...`.

    Yields a Result each `interval` seconds, and at the end the finished one. The other arguments
    are those of `start`. The render begins with the first step of the loop, and leaving the loop
    ends it.
    """
    interval = seconds("interval", interval)
    job = start(scene, integrator, **settings)
    try:
        while not job.wait(interval):
            yield job.snapshot()
        yield job.snapshot()
    finally:
        job.cancel()


def replay(
    scene: SceneLike,
    integrator: IntegratorLike | None = None,
    *,
    pixel: tuple[int, int],
    sample: int = 0,
    seed: int = 0,
    sensor: SensorLike | None = None,
    spectral: bool = False,
) -> Replay:
    """Repeat one sample of the pixel (x, y) of the render that these arguments mean.

    See `Job.replay`.
    """
    scene = as_scene(scene, sensor, spectral)
    options = RenderOptions(spp=1, seed=seed, threads=1)
    return Job(scene, as_integrator(scene, integrator), options).replay(pixel, sample)
