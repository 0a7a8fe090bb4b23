"""The workers' side: what a process of the cluster keeps, and the tasks that it runs."""

from __future__ import annotations

import functools
import hashlib
import pickle
import threading
from contextlib import contextmanager

from ... import _core


class WorkerState:
    """What a worker process keeps between tasks; it is an attribute of dask's worker."""

    def __init__(self):
        self.lock = threading.Lock()
        self.scenes: dict[str, _core.Scene] = {}
        self.users: dict[str, set[str]] = {}  #: of a scene: jobs
        self.helpers: dict[str, set[_core.Helper]] = {}  #: those that are running, by job
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
    def running(self, job: str, helper: _core.Helper):
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


def state_of(worker) -> WorkerState:
    with _first:
        if not hasattr(worker, "pymlt_state"):
            worker.pymlt_state = WorkerState()
        return worker.pymlt_state


_first = threading.Lock()


def hold(packed: bytes) -> bytes:
    """The scene, as a task of its own for dask: passed on by who has it, made again if lost."""
    return packed


def run_task(packed, job, scene, integrator, build, task) -> bytes | str:
    """The result of a task, on all threads of the worker: they share one film.

    If the worker has not got the scene and it does not come with the task: its address. Tasks have
    it on request only, since dask drops copies and would bring a new one with each of them.
    """
    from distributed import get_worker

    if build != build_name():
        raise _core.UsageError(
            "this worker has another build of pymlt than the one that started the render; "
            "install the same one everywhere"
        )
    worker = get_worker()
    state = state_of(worker)
    unpacked = state.scene(job, scene, packed)
    if unpacked is None:
        return worker.address
    helper = _core.Helper(unpacked, integrator)
    with state.running(job, helper):
        return helper.run(task, worker.state.nthreads)


def cancel(job: str, dask_worker) -> None:
    state_of(dask_worker).cancel(job)


def forget(job: str, scene: str, dask_worker) -> None:
    state_of(dask_worker).forget(job, scene)


@functools.cache
def build_name() -> str:
    """Of the compiled extension: the same bits are promised for one build."""
    with open(_core.__file__, "rb") as file:
        return hashlib.file_digest(file, "blake2b").hexdigest()[:32]
