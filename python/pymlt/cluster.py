"""Rendering on many machines: a dask.distributed cluster runs the units, this process the rest.

This process keeps the whole state of the render. It prepares it (bootstrap), and then sends tasks,
"take these shares from here to there", which any worker can run, any number of times with the same
result; so dask redoes elsewhere what a lost worker held. Each result is merged once. The pixels
have the same bits as those of one machine with the same seed and samples.
"""

from __future__ import annotations

import functools
import hashlib
import os
import pickle
import queue
import threading
import uuid
from contextlib import ExitStack, contextmanager, suppress
from time import monotonic

from . import _core

SHORTEST_STAGE = 1.0  #: seconds between two results of a task, at the least
LONGEST_STAGE = 60.0
GROWTH = 0.3  #: a stage grows with the render: this share of the time so far
OWNER_SHARE = 0.05  #: of the time, at most, the owner is to spend on gathering and merging
#: The same, of the time of each worker; a task costs all processes three times what it costs the
#: owner, so dividing the render costs 2 %.
WORKER_SHARE = 0.006
CONNECT_SECONDS = 15


# ---- the workers' side ---------------------------------------------------------------------------


class _Bench:
    """What a worker process keeps between tasks; it hangs on dask's worker and ends with it."""

    def __init__(self):
        self.lock = threading.Lock()
        self.scenes: dict[str, _core.Scene] = {}
        self.users: dict[str, set[str]] = {}  #: of a scene: jobs
        self.helpers: dict[str, set[_core.Helper]] = {}  #: those at work, by job
        self.cancelled: set[str] = set()

    def scene(self, job: str, name: str, packed: bytes | None) -> _core.Scene | None:
        """None if it is neither here nor given."""
        with self.lock:  # so that several threads do not unpack the same one
            if name not in self.scenes:
                if packed is None:
                    return None
                self.scenes[name] = pickle.loads(packed)
            self.users.setdefault(name, set()).add(job)
            return self.scenes[name]

    @contextmanager
    def at_work(self, job: str, helper: _core.Helper):
        with self.lock:
            self.helpers.setdefault(job, set()).add(helper)
            if job in self.cancelled:
                helper.cancel()
        try:
            yield
        finally:
            with self.lock:
                self.helpers[job].discard(helper)

    def cancel(self, job: str) -> None:
        with self.lock:
            self.cancelled.add(job)
            for helper in self.helpers.get(job, ()):
                helper.cancel()

    def forget(self, job: str, scene: str) -> None:
        with self.lock:
            self.cancelled.discard(job)
            self.helpers.pop(job, None)
            users = self.users.get(scene, set())
            users.discard(job)
            if not users:
                self.users.pop(scene, None)
                self.scenes.pop(scene, None)


def _bench(worker) -> _Bench:
    with _making_a_bench:
        if not hasattr(worker, "pymlt_bench"):
            worker.pymlt_bench = _Bench()
        return worker.pymlt_bench


_making_a_bench = threading.Lock()


def _hold(packed: bytes) -> bytes:
    """The scene as a task of its own: whoever has it passes it on, and it is made again if lost."""
    return packed


def _run(packed, job, scene, integrator, build, task) -> bytes | str:
    """The result of a task, on all threads of the worker: they share one film.

    If the worker has not got the scene and it does not come with the task: its address. Tasks
    have it on request only, since dask drops copies and would bring a new one with each of them.
    """
    from distributed import get_worker

    if build != build_name():
        raise _core.UsageError(
            "this worker has another build of pymlt than the one that started the render; "
            "install the same one everywhere"
        )
    worker = get_worker()
    bench = _bench(worker)
    unpacked = bench.scene(job, scene, packed)
    if unpacked is None:
        return worker.address
    helper = _core.Helper(unpacked, integrator)
    with bench.at_work(job, helper):
        return helper.run(task, worker.state.nthreads)


def _cancel(job: str, dask_worker) -> None:
    _bench(dask_worker).cancel(job)


def _forget(job: str, scene: str, dask_worker) -> None:
    _bench(dask_worker).forget(job, scene)


@functools.cache
def build_name() -> str:
    """Of the compiled extension: the same bits are promised for one build."""
    with open(_core.__file__, "rb") as file:
        return hashlib.file_digest(file, "blake2b").hexdigest()[:32]


# ---- the owner's side ----------------------------------------------------------------------------


class _Connection:
    """A client of a cluster, and what must be closed after the render."""

    def __init__(self, cluster):
        self._own = ExitStack()
        try:
            self.client = self._connect(cluster)
        except BaseException:
            self.close()
            raise

    def _connect(self, cluster):
        try:
            from distributed import Client
        except ImportError:
            raise _core.UsageError(
                "a cluster needs dask.distributed; pip install 'pymlt[cluster]'"
            ) from None
        if isinstance(cluster, Client):
            if cluster.asynchronous:
                raise _core.UsageError("the cluster's client is asynchronous; make another one")
            return cluster
        if isinstance(cluster, str) and cluster.startswith("local:"):
            cluster = self._own.enter_context(local_cluster(cluster))
        elif not isinstance(cluster, str) and not hasattr(cluster, "scheduler_address"):
            raise _core.UsageError(
                f"cluster is {cluster!r}, but should be a dask client, a cluster, an address "
                "such as 'tcp://host:8786', or 'local:4' for four processes of this machine"
            )
        try:
            return self._own.enter_context(Client(cluster, timeout=CONNECT_SECONDS))
        except (OSError, ValueError, TimeoutError) as error:
            raise _core.UsageError(f"no cluster at {cluster}: {error}") from None

    def close(self) -> None:
        self._own.close()


def local_cluster(text: str):
    """Processes of this machine, one thread each. Scripts need no `if __name__` for them."""
    count = text.removeprefix("local:")
    if not count.isdecimal() or int(count) == 0:
        raise _core.UsageError(f"cluster is {text!r}, but should be local:N with N >= 1")
    from distributed.deploy.subprocess import SubprocessCluster

    with _environment(QUIET):
        return SubprocessCluster(
            n_workers=int(count),
            threads_per_worker=1,
            worker_class="distributed.Worker",
            worker_kwargs={"memory_limit": 0, "dashboard": False},
            # For the case that this process is killed and cannot end them.
            scheduler_kwargs={"dashboard": False, "idle_timeout": "12h"},
        )


#: dask's processes watch themselves a hundred times a second, which takes 4 % of a processor each.
QUIET = {
    "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False",
    "DASK_DISTRIBUTED__ADMIN__TICK__INTERVAL": "1s",
    "DASK_DISTRIBUTED__ADMIN__SYSTEM_MONITOR__INTERVAL": "10s",
}


@contextmanager
def _environment(defaults: dict[str, str]):
    """For the processes that are started meanwhile: variables that are not set."""
    added = {name: value for name, value in defaults.items() if name not in os.environ}
    os.environ.update(added)
    try:
        yield
    finally:
        for name in added:
            del os.environ[name]


class ClusterExecutor:
    """Sends the tasks of a job to a cluster and merges their results; see `_core.Job.attach`."""

    def __init__(self, scene, integrator, cluster):
        self.cluster = cluster
        self.scene_name = scene.hash
        self.packed = pickle.dumps(scene)
        self.integrator = integrator
        self.build = build_name()
        self._begin()

    def _begin(self) -> None:
        self.connection = _Connection(self.cluster)
        self.client = self.connection.client
        self.name = f"pymlt-{uuid.uuid4().hex}"
        self.scene = None
        self.finished: queue.SimpleQueue = queue.SimpleQueue()
        self.at_work: dict = {}  #: task -> future
        self.merging = 0.0  #: seconds spent on gathering and merging
        self.merged = 0
        self.cancelling = False
        self.next_count = 0.0

    def wanted_tasks(self) -> int:
        if self.connection is None:  # the render was extended
            self._begin()
        return 2 * self._workers()

    def run(self, job, to: int) -> None:
        try:
            self._run_until(job, to)
        except Exception as error:
            raise _core.RenderError(_reason(error)) from error

    def _run_until(self, job, to: int) -> None:
        if self.scene is None:
            self.scene = self._submit(_hold, self.packed, key=f"{self.name}-scene")
            self.start, self.units_before = monotonic(), job.units_done
            self.frontier = min(job.position(task) for task in range(job.task_count))
        while True:
            if job.stopping and not self.cancelling:
                self.cancelling = True
                self.client.run(_cancel, self.name)
            elif job.interrupted and not self.cancelling:
                return
            if not self.cancelling:
                self._send_tasks(job, to)
            if not self.at_work:
                return
            self._merge_one(job)

    def close(self) -> None:
        """Whatever state the cluster is in by now: one that is gone has nothing to forget."""
        if self.connection is None:
            return
        with suppress(Exception):
            for future in self.at_work.values():
                future.cancel()
            self.client.run(_forget, self.name, self.scene_name, on_error="ignore")
        self.at_work.clear()
        self.scene = None
        with suppress(Exception):
            self.connection.close()
        self.connection = self.client = None

    def _workers(self) -> int:
        """How many there are. To ask the scheduler takes a while: every other second."""
        if monotonic() >= self.next_count:
            self.workers = max(1, len(self.client.nthreads()))
            self.next_count = monotonic() + 2
        return self.workers

    def _send_tasks(self, job, to: int) -> None:
        """Keep every worker busy, with the tasks that are behind; never far ahead of the others."""
        workers = self._workers()
        most = workers + max(1, workers // 2)
        while len(self.at_work) < most:
            waiting = [task for task in range(job.task_count) if task not in self.at_work]
            if not waiting:
                return
            task = min(waiting, key=job.position)
            if job.position(task) >= self.frontier:
                if self.frontier >= to:
                    return
                self.frontier = self._next_frontier(job, to)
            if job.skip(task, self.frontier):
                continue
            self._send(job, task)

    def _send(self, job, task: int, with_scene_to: str | None = None) -> None:
        """A task, to any worker, or with the scene to the one that has asked for it."""
        place = {}
        if with_scene_to is not None:
            place = {"workers": [with_scene_to], "allow_other_workers": True}
        future = self._submit(
            _run,
            None if with_scene_to is None else self.scene,
            self.name,
            self.scene_name,
            self.integrator,
            self.build,
            job.task(task, self.frontier),
            key=f"{self.name}-{task}-{job.position(task)}-{with_scene_to}",
            **place,
        )
        self.at_work[task] = future
        future.add_done_callback(lambda _, task=task: self.finished.put(task))

    def _next_frontier(self, job, to: int) -> int:
        """A stage ahead. Stages are long enough that the owner's work hardly counts."""
        elapsed = monotonic() - self.start
        seconds = max(SHORTEST_STAGE, min(LONGEST_STAGE, GROWTH * elapsed))
        if self.merged:
            share = min(OWNER_SHARE, WORKER_SHARE * self._workers())
            seconds = max(seconds, self.merging / self.merged * job.task_count / share)
        rate = (job.units_done - self.units_before) / max(elapsed, 1e-3)
        cycles = max(1, round(rate * seconds / job.units_per_cycle))
        return min(to, self.frontier + cycles * job.units_per_cycle)

    def _merge_one(self, job) -> None:
        try:
            task = self.finished.get(timeout=0.1)
        except queue.Empty:
            return
        start = monotonic()
        try:
            result = self.at_work[task].result(timeout=10)
        except TimeoutError:  # its worker was lost in between: dask does it again
            self.finished.put(task)
            return
        del self.at_work[task]
        if isinstance(result, str):
            if not self.cancelling:
                self._send(job, task, with_scene_to=result)
            return
        job.merge(task, result)
        if job.task_count < self._workers():  # some have come
            job.split(task)
        self.merging += monotonic() - start
        self.merged += 1

    def _submit(self, function, *arguments, key, **place):
        import dask

        # Tasks carry the state of their shares; the scheduler keeps it in case a worker is lost.
        with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1TB"}):
            return self.client.submit(function, *arguments, key=key, pure=False, **place)


def _reason(error: BaseException) -> str:
    """One line on what went wrong."""
    from distributed import CancelledError, KilledWorker
    from distributed.comm import CommClosedError

    if isinstance(error, _core.Error):
        return str(error)
    if isinstance(error, KilledWorker):
        return f"workers of the cluster died, each time with the same task: {error}"
    gone = isinstance(error, CancelledError | CommClosedError | OSError | TimeoutError)
    where = "the cluster is gone" if gone else "on the cluster"
    return f"{where}: {type(error).__name__}: {error}"
