"""Connecting to a dask cluster, or starting one on this machine."""

from __future__ import annotations

import os
from contextlib import ExitStack, contextmanager

from ... import _core

CONNECT_SECONDS = 15


class Connection:
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
