"""Rendering: start a job and look at it, or just wait for the image."""

from __future__ import annotations

import atexit
import json
import math
import operator
import os
import weakref
from dataclasses import dataclass, field
from time import monotonic
from typing import TYPE_CHECKING, NamedTuple

from . import _core
from .integrators import Integrator
from .loading import load_built_in, load_dict, load_file
from .progress import progress_bar

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy as np

_running: weakref.WeakSet[Job] = weakref.WeakSet()


class Technique(NamedTuple):
    """The image of one technique (s, t) of bidirectional path tracing."""

    raw: np.ndarray  #: what it finds alone, without weights
    weighted: np.ndarray  #: what it brings to the render


@dataclass
class Result:
    """What a render left behind."""

    image: np.ndarray  #: float32, (height, width, 3), linear Rec. 709, row 0 on top
    stats: dict  #: the content of stats.json
    integrator: dict  #: type and every parameter, given or default
    layers: dict[str, np.ndarray] = field(repr=False)  #: further images that were kept, by name
    metadata: dict[str, str] = field(repr=False)  #: what `write` puts into an EXR header
    half: bool = field(default=False, repr=False)  #: EXR with 16-bit samples, as the film asks

    @property
    def seed(self) -> int:
        return self.stats["seed"]

    @property
    def error_map(self) -> np.ndarray | None:
        """The standard error of each pixel, of the shape of `image`, or None if it is not known.

        It is estimated from the spread of independent groups, and there must be two of them.
        """
        return self.layers.get("error")

    @property
    def block_error(self) -> np.ndarray | None:
        """The standard errors of the means over blocks of 8 x 8 pixels, or None.

        float32, (rows, columns, 3); the blocks at the right and the lower border may be smaller.
        """
        spread = self.layers.get("error_block")
        return None if spread is None else spread[::8, ::8]

    @property
    def techniques(self) -> dict[tuple[int, int], Technique]:
        """The images of the techniques (s, t), of a render by `BDPT(techniques=True)`.

        A path of technique (s, t) has s vertices from the light and t from the camera.
        """
        found = {}
        for name, weighted in self.layers.items():
            kind, *numbers = name.split(".")
            if kind == "weighted":
                s, t = (int(number[1:]) for number in numbers)
                found[s, t] = Technique(self.layers[f"raw.s{s}.t{t}"], weighted)
        return found

    def write(self, path, exposure: float = 0) -> None:
        """Write the image to .exr (with settings, seed and version in its header), .png or .hdr.

        An .exr holds the layers too; beside NAME.png, NAME.techniques.png shows the techniques.
        """
        self._write(path, exposure, rescue=False)

    def save(self, path, exposure: float = 0) -> str:
        """The same, but if `path` fails try other places; returns where the image is."""
        return self._write(path, exposure, rescue=True)

    def _write(self, path, exposure: float, rescue: bool) -> str:
        path = os.fspath(path)
        return _core.write_image(
            path, self.image, self.layers, self.metadata, self.half, exposure, rescue
        )

    def __repr__(self) -> str:
        height, width = self.image.shape[:2]
        spp = self.stats["spp_done"]
        return f"Result({width} x {height}, {self.integrator['type']!r}, {spp:g} spp)"


class Groups(NamedTuple):
    """The independent groups of a render: the image is the mean of theirs.

    Direct light that is rendered separately (`direct_samples` of `mlt`) is not in them.
    """

    images: np.ndarray  #: float32, (groups, height, width, 3)
    weights: np.ndarray  #: of each in the mean, 0 for one that has nothing to say yet
    b: np.ndarray  #: by which each image is scaled, for Metropolis integrators; else 0


class Replay(NamedTuple):
    """What one sample of a pixel has seen."""

    raster: tuple[float, float]  #: where on the image, in pixels
    radiance: np.ndarray  #: RGB, as the film got it there
    paths: list[_core.LightPath]  #: what it found; `direct` does not tell

    def __repr__(self) -> str:
        x, y = self.raster
        rgb = ", ".join(f"{c:.4g}" for c in self.radiance)
        return f"Replay(({x:.2f}, {y:.2f}), rgb=({rgb}), {len(self.paths)} paths)"


class Job:
    """A render in progress; made by `start`."""

    def __init__(self, scene: _core.Scene, integrator: _core.Integrator, job: _core.Job):
        self._scene = scene
        self._integrator = integrator
        self._job = job

    @property
    def image(self) -> np.ndarray:
        """The image so far: float32, (height, width, 3), linear, row 0 on top."""
        return self._job.image()

    @property
    def stats(self) -> dict:
        return json.loads(self._job.stats())

    @property
    def groups(self) -> Groups:
        """What the independent groups have seen so far."""
        return Groups(*self._job.groups())

    @property
    def error_map(self) -> np.ndarray | None:
        """The standard error of each pixel so far; see `Result.error_map`."""
        return self._job.layers().get("error")

    def checkpoint(self, path) -> None:
        """Save the state of the render, now, to a file that `resume` goes on from.

        The units in flight are finished, and the render goes on. Raises FileError if the file
        cannot be written, or exists and is no checkpoint.
        """
        self._job.checkpoint(os.fspath(path))

    def extend(self, *, spp=None, time=None, error=None) -> None:
        """After the end: go on to a larger budget, counted from the very beginning.

        The image is the same as if the render had had this budget from the start.
        """
        self._job.extend(_number("spp", spp), _number("time", time), _number("error", error))

    def replay(self, pixel: tuple[int, int], sample: int = 0) -> Replay:
        """Repeat one sample of a pixel (x, y), whether it has been taken or not.

        `sample` counts from 0. What is asked for again shows the same paths, those that the render
        has added up. For integrators that sample pixel by pixel.
        """
        sample = _integer("sample", sample, 2**36)
        return Replay(*self._job.replay(pixel, sample))

    @property
    def progress(self) -> float:
        """0 to 1 of the budget."""
        return self._job.progress

    @property
    def ended(self) -> bool:
        return self._job.ended

    @property
    def cancelled(self) -> bool:
        return self._job.cancelled

    def cancel(self) -> None:
        """End the render soon; what has been rendered stays."""
        self._job.cancel()

    def wait(
        self, timeout: float | None = None, progress=False, *, callback=None, interval: float = 1
    ) -> bool:
        """Wait for the end, at most `timeout` seconds; True if the render has ended.

        `callback` is called with a `snapshot` each `interval` seconds while the render runs; if it
        returns True the render ends. Ctrl-C ends the waiting, not the render. Raises what went
        wrong in the render; what had been rendered by then is the error's `result`.
        """
        with progress_bar(progress) as show:
            end = math.inf if timeout is None else monotonic() + timeout
            next_call = monotonic() + interval
            while not self._ended(min(0.1, max(0.0, end - monotonic()))):
                if monotonic() >= end:
                    return False
                if progress is not False:
                    show(self.progress, {"spp": f"{self._job.spp_done:.4g}"})
                if callback is not None and monotonic() >= next_call:
                    if callback(self.snapshot()) is True:
                        self.cancel()
                    next_call = monotonic() + interval
        return True

    def _ended(self, seconds: float) -> bool:
        try:
            return self._job.wait(seconds)
        except _core.RenderError as error:
            if self._job.spp_done > 0:
                error.result = self.snapshot()
            raise

    def result(self) -> Result:
        """Wait for the end and return the image with everything known about it."""
        self.wait()
        return self.snapshot()

    def snapshot(self) -> Result:
        """The image so far, with everything known about it."""
        settings = json.loads(self._integrator.settings)
        return Result(
            self.image,
            self.stats,
            settings,
            self._job.layers(),
            self._job.metadata(),
            self._scene.half,
        )

    def show(self, *, interval: float = 1, exposure: float = 0) -> None:
        """Show the image in a notebook, and renew it each `interval` seconds until the render ends.

        `exposure` brightens it by so many stops. Interrupting the cell ends the showing, not the
        render. Needs IPython.
        """
        from .notebook import show

        show(self, interval, exposure)

    def __repr__(self) -> str:
        state = "cancelled" if self.cancelled else "ended" if self.ended else "running"
        return f"Job({state}, {100 * self.progress:.0f} %)"


@atexit.register
def _cancel_all() -> None:
    """No thread may outlive the interpreter."""
    for job in list(_running):
        job.cancel()
        while not job.ended:
            job._job.wait(1.0)


def start(
    scene,
    integrator=None,
    *,
    spp=None,
    time=None,
    error=None,
    seed=0,
    threads=0,
    checkpoint=None,
    every=60,
    cluster=None,
) -> Job:
    """Start a render and return at once.

    scene
        a Scene, a dict, or the path of an XML file.
    integrator
        an object such as `Path(max_depth=8)`, a dict, or a name. None is the scene's own, else
        `path`. A name keeps what the scene says about what is to be rendered (max_depth,
        hide_emitters, strict_normals); an object or a dict means exactly what it says.
    spp, time, error
        samples (for Metropolis integrators: mutations) per pixel, seconds, and the relative error
        of the image (0.02: 2 %), as `stats["error"]` estimates it. The first one to be reached
        ends the render; with none, the scene's own sample count counts, else 64.
    seed, threads
        The image depends on the seed but not on the number of threads (0: all there are).
    checkpoint, every
        a file that keeps the state of the render, renewed every so many seconds and at the end;
        `resume` goes on from there.
    cluster
        where to render: a `dask.distributed` client or cluster, the address of one
        ("tcp://host:8786"), or "local:N" for N processes of this machine. None is this process.
        The bootstrap runs here. The pixels are the same. Needs `pymlt[cluster]`.
    """
    scene = as_scene(scene)
    made = as_integrator(scene, integrator)
    budget = spp, time, error
    job = _make(scene, made, budget, _integer("seed", seed, 2**64), threads, checkpoint, every)
    return begin(job, cluster)


def resume(
    path,
    *,
    scene=None,
    spp=None,
    time=None,
    error=None,
    threads=0,
    checkpoint=None,
    every=60,
    cluster=None,
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
    checkpoint, every
        where the state is kept from now on; None means `path`.
    cluster
        where to render, as for `start`; it need not be where the render began.
    """
    budget = {"spp": spp, "time": time, "error": error}
    job = prepare_resume(
        path, scene=scene, threads=threads, checkpoint=checkpoint, every=every, **budget
    )
    return begin(job, cluster)


def prepare_resume(path, *, scene, spp, time, error, threads, checkpoint, every) -> Job:
    """The job of `resume`, not yet started."""
    path = os.fspath(path)
    saved = _core.Checkpoint(path)
    if isinstance(scene, _core.Scene | dict):
        scene = as_scene(scene)
        saved.check(scene)
    elif scene is None and saved.built_in:
        scene = load_built_in(*saved.built_in)
        saved.check(scene)
    else:
        scene = saved.load_scene("" if scene is None else os.fspath(scene))
    budget = spp, time, error
    checkpoint = path if checkpoint is None else checkpoint
    job = _make(scene, saved.integrator, budget, saved.seed, threads, checkpoint, every)
    saved.resume(job._job)
    return job


def begin(job: Job, cluster=None) -> Job:
    """Start a job that was made."""
    if cluster is not None:
        from .cluster import ClusterExecutor

        job._job.attach(ClusterExecutor(job._scene, job._integrator, cluster))
    job._job.start()
    _running.add(job)
    return job


def _make(scene, made, budget, seed: int, threads, checkpoint, every) -> Job:
    job = _core.Job(
        scene,
        made,
        *map(_number, ("spp", "time", "error"), budget),
        seed,
        _integer("threads", threads, 2**31),
        "" if checkpoint is None else os.fspath(checkpoint),
        _number("every", every),
    )
    return Job(scene, made, job)


def render(
    scene,
    integrator=None,
    *,
    spp=None,
    time=None,
    error=None,
    seed=0,
    threads=0,
    checkpoint=None,
    every=60,
    cluster=None,
    progress=None,
    callback=None,
    interval=1,
) -> np.ndarray:
    """Render and return the image: float32, (height, width, 3), linear Rec. 709, row 0 on top.

    The arguments are those of `start`. `progress` is True, False, None (a bar on a terminal and in
    a notebook) or a function of the fraction that is done. `callback` is a function of the Result
    so far, called each `interval` seconds; it ends the render by returning True. After Ctrl-C the
    KeyboardInterrupt carries the image so far, as `error.result`.
    """
    job = start(
        scene,
        integrator,
        spp=spp,
        time=time,
        error=error,
        seed=seed,
        threads=threads,
        checkpoint=checkpoint,
        every=every,
        cluster=cluster,
    )
    try:
        job.wait(progress=progress, callback=callback, interval=interval)
    except KeyboardInterrupt as interrupt:
        job.cancel()
        interrupt.result = job.result()
        raise
    except BaseException:
        job.cancel()
        raise
    return job.image


def render_progressive(scene, integrator=None, *, interval=1, **settings) -> Iterator[Result]:
    """Render and look at it: `for snapshot in render_progressive(scene, spp=256): ...`.

    Yields a Result each `interval` seconds, and at the end the finished one. The other arguments
    are those of `start`. The render begins with the first step of the loop, and leaving the loop
    ends it.
    """
    job = start(scene, integrator, **settings)
    try:
        while not job.wait(interval):
            yield job.snapshot()
        yield job.snapshot()
    finally:
        job.cancel()


def replay(scene, integrator=None, *, pixel, sample=0, seed=0) -> Replay:
    """Repeat one sample of a pixel of the render that these arguments mean; see `Job.replay`."""
    scene = as_scene(scene)
    made = as_integrator(scene, integrator)
    job = _core.Job(scene, made, 1.0, None, None, _integer("seed", seed, 2**64), 1)
    return Job(scene, made, job).replay(pixel, sample)


def as_integrator(scene: _core.Scene, integrator, assignments=()) -> _core.Integrator:
    """What `integrator` means for this scene; see `start`."""
    if isinstance(integrator, _core.Integrator):
        return integrator
    if isinstance(integrator, Integrator):
        integrator, written = integrator._parts()
        if written:
            made = _core.integrator_from_dict(integrator)
            return _core.with_mutations(made, scene, written)
    if isinstance(integrator, dict):
        return _core.integrator_from_dict(integrator)
    if integrator is None or isinstance(integrator, str):
        return _core.integrator_by_name(scene, integrator or "", list(assignments))
    if isinstance(integrator, type) and issubclass(integrator, Integrator):
        raise _core.UsageError(f"integrator is a class; write {integrator.__name__}()")
    raise _core.UsageError(f"{integrator!r} is not an integrator, a dict, or a name")


def _number(name: str, value) -> float | None:
    try:
        return None if value is None else float(value)
    except (TypeError, ValueError):
        raise _core.UsageError(f"{name} is {value!r}, but should be a number") from None


def _integer(name: str, value, end: int) -> int:
    try:
        if not isinstance(value, bool) and 0 <= operator.index(value) < end:
            return operator.index(value)
    except TypeError:
        pass
    raise _core.UsageError(f"{name} is {value!r}, but should be an integer from 0 to {end - 1}")


def as_scene(scene) -> _core.Scene:
    """What `scene` means: itself, a dict, or the path of a file."""
    if isinstance(scene, _core.Scene):
        return scene
    if isinstance(scene, dict):
        return load_dict(scene)
    if isinstance(scene, str | os.PathLike):
        return load_file(scene)
    raise _core.UsageError(f"{scene!r} is not a scene, a dict, or the path of a file")
