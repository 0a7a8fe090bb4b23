"""The owner's side: sends tasks to the workers and merges their results."""

from __future__ import annotations

import pickle
import queue
import uuid
from contextlib import suppress
from time import monotonic

from ... import _core
from . import worker
from .connection import Connection

SHORTEST_STAGE = 1.0  #: seconds between two results of a task, at the least
LONGEST_STAGE = 60.0
GROWTH = 0.3  #: a stage grows with the render: this share of the time so far
OWNER_SHARE = 0.05  #: of the time, at most, the owner is to spend on gathering and merging
#: The same, of the time of each worker; a task costs all processes three times what it costs the
#: owner, so dividing the render costs 2 %.
WORKER_SHARE = 0.006


class ClusterExecutor:
    """Sends the tasks of a job to a cluster and merges their results; see `_core.Job.attach`."""

    def __init__(self, scene, integrator, cluster):
        self.cluster = cluster
        self.scene_name = scene.hash
        self.packed = pickle.dumps(scene)
        self.integrator = integrator
        self.build = worker.build_name()
        self._begin()

    def _begin(self) -> None:
        self.connection = Connection(self.cluster)
        self.client = self.connection.client
        self.name = f"pymlt-{uuid.uuid4().hex}"
        self.scene = None
        self.finished: queue.SimpleQueue = queue.SimpleQueue()
        self.running: dict = {}  #: task -> future
        self.merging = 0.0  #: seconds spent on gathering and merging
        self.merged = 0
        self.next_count = 0.0
        self.next_cancel = 0.0

    def wanted_tasks(self) -> int:
        if self.connection is None:  # the render was extended
            self._begin()
        return 2 * self._workers()

    def run(self, job, to: int) -> None:
        try:
            self._run_until(job, to)
        except Exception as error:
            raise _core.RenderError(self._reason(error)) from error

    def _run_until(self, job, to: int) -> None:
        if self.scene is None:
            self.scene = self._submit(worker.hold, self.packed, key=f"{self.name}-scene")
            self.start, self.units_before = monotonic(), job.units_done
            self.frontier = min(job.position(task) for task in range(job.task_count))
        while True:
            if self._is_gone():
                raise ConnectionError
            if job.stopping:
                self._cancel_tasks()
            elif job.interrupted:
                return
            else:
                self._send_tasks(job, to)
            if not self.running:
                return
            self._merge_one(job)

    def close(self) -> None:
        """Whatever state the cluster is in by now: one that is gone has nothing to forget."""
        if self.connection is None:
            return
        with suppress(Exception):
            self._drop_tasks()
            if not self._is_gone():
                self.client.run(worker.forget, self.name, self.scene_name, on_error="ignore")
        self.scene = None
        with suppress(Exception):
            self.connection.close()
        self.connection = self.client = None

    def _is_gone(self) -> bool:
        """Whether the connection to the scheduler was lost, and dask tries in vain to renew it."""
        return self.client.status != "running"

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
        while len(self.running) < most:
            waiting = [task for task in range(job.task_count) if task not in self.running]
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
            worker.run_task,
            None if with_scene_to is None else self.scene,
            self.name,
            self.scene_name,
            self.integrator,
            self.build,
            job.task(task, self.frontier),
            key=f"{self.name}-{task}-{job.position(task)}-{with_scene_to}",
            **place,
        )
        self.running[task] = future
        finished = self.finished  # of this run: a task that was dropped may still tell it
        future.add_done_callback(lambda _: finished.put(task))

    def _cancel_tasks(self) -> None:
        """Their workers return them early; those of lost workers begin again on others, or never.

        So it is said again and again, to the workers that there are, until no task is running.
        """
        if monotonic() < self.next_cancel:
            return
        self.client.run(worker.cancel, self.name, on_error="ignore")
        if not self.client.nthreads():
            self._drop_tasks()
        self.next_cancel = monotonic() + 1

    def _drop_tasks(self) -> None:
        dropped, self.running = self.running, {}
        for future in dropped.values():
            future.cancel()

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
            result = self.running[task].result(timeout=10)
        except TimeoutError:  # its worker was lost in between: dask does it again
            self.finished.put(task)
            return
        del self.running[task]
        if isinstance(result, str):
            if not job.stopping:
                self._send(job, task, with_scene_to=result)
            return
        job.merge(task, result)
        if job.task_count < self._workers():  # some have come
            job.split(task)
        self.merging += monotonic() - start
        self.merged += 1

    def _submit(self, function, *arguments, key, **place):
        import dask

        # Tasks carry the state of their strands; the scheduler keeps it in case a worker is lost.
        with dask.config.set({"distributed.admin.large-graph-warning-threshold": "1TB"}):
            return self.client.submit(function, *arguments, key=key, pure=False, **place)

    def _reason(self, error: BaseException) -> str:
        """One line on what went wrong."""
        from distributed import KilledWorker

        if isinstance(error, _core.Error):
            return str(error)
        if isinstance(error, KilledWorker):
            return f"workers of the cluster died, each time with the same task: {error}"
        if self._is_gone():
            return "the cluster is gone: its scheduler has ended, or cannot be reached any more"
        return f"on the cluster: {type(error).__name__}: {error}"
