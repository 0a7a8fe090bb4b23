"""A cluster of processes of this machine, which nobody else can talk to."""

from __future__ import annotations

import os
import signal
import tempfile
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from typing import Any

from ... import _core
from ..._extras import import_extra

#: dask's processes watch themselves a hundred times a second, which takes 4 % of a processor each.
QUIET = {
    "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False",
    "DASK_DISTRIBUTED__ADMIN__TICK__INTERVAL": "1s",
    "DASK_DISTRIBUTED__ADMIN__SYSTEM_MONITOR__INTERVAL": "10s",
    # dask's scheduler would stop as soon as nobody reads what it says of strangers that knock.
    "DASK_LOGGING__DISTRIBUTED": "error",
}
SPAWNED = {"preload": f"{__package__}.spawned", "dashboard": False}


def local_cluster(text: str) -> AbstractContextManager:
    """Processes of this machine, one thread each. Scripts need no `if __name__` for them.

    Whoever can talk to a dask process can run code in it, so they ask each other for a certificate
    that is made for this cluster.
    """
    count = text.removeprefix("local:")
    if not count.isdecimal() or int(count) == 0:
        raise _core.UsageError(f"cluster is {text!r}, but should be local:N with N >= 1")
    import_extra("cryptography", "cluster", "a cluster of processes of this machine")
    return _processes(int(count))


@contextmanager
def _processes(count: int) -> Iterator[Any]:
    from distributed import Security
    from distributed.deploy.subprocess import SubprocessCluster

    security = Security.temporary()
    with tempfile.TemporaryDirectory(prefix="pymlt-", ignore_cleanup_errors=True) as scratch:
        private = {
            "PYTHONSAFEPATH": "1",  # `python -m dask` would import what lies in the current folder
            "DASK_TEMPORARY_DIRECTORY": scratch,  # else one that all users of the machine share
            "TMPDIR": scratch,
            "PYMLT_CLUSTER_OWNER": str(os.getpid()),
        }
        with _environment({**QUIET, **os.environ, **private, **_certificate(security)}):
            cluster = SubprocessCluster(
                n_workers=count,
                threads_per_worker=1,
                worker_class="distributed.Worker",
                worker_kwargs={"memory_limit": 0, **SPAWNED},
                scheduler_kwargs={
                    "protocol": "tls",
                    "scheduler_file": f"{scratch}/scheduler.json",
                    **SPAWNED,
                },
                security=security,
                shutdown_scheduler=False,
            )
        with cluster:
            try:
                yield cluster
            finally:
                cluster.sync(_end, cluster)


async def _end(cluster: Any) -> None:
    """Kills the processes. dask would ask a scheduler that is gone, and wait half a minute."""
    for started in cluster.scheduler, *cluster.workers.values():
        process = started.process
        if process and process.returncode is None:
            # By process.kill(), asyncio could miss that it has just ended, and would say so.
            with suppress(ProcessLookupError):
                os.kill(process.pid, signal.SIGKILL)
            await process.wait()
        await started.close()


def _certificate(security) -> dict[str, str]:
    """For the environment, which other users cannot read, unlike the arguments of a process."""
    tls = {"CA_FILE": security.tls_ca_file}
    for role in "SCHEDULER", "WORKER":
        tls |= {f"{role}__CERT": security.tls_worker_cert, f"{role}__KEY": security.tls_worker_key}
    variables = {f"DASK_DISTRIBUTED__COMM__TLS__{name}": text for name, text in tls.items()}
    return {**variables, "DASK_DISTRIBUTED__COMM__REQUIRE_ENCRYPTION": "True"}


@contextmanager
def _environment(variables: dict[str, str]):
    """That of the processes which are started meanwhile."""
    before = dict(os.environ)
    os.environ.update(variables)
    try:
        yield
    finally:
        for name in variables.keys() - before.keys():
            del os.environ[name]
        os.environ.update(before)
