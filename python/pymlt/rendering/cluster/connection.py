"""Connecting to a dask cluster, or starting one on this machine."""

from __future__ import annotations

import asyncio
import logging
from contextlib import ExitStack

from ... import _core
from ..._extras import import_extra
from .local import local_cluster

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
        Client = import_extra("distributed", "cluster", "a cluster").Client
        if isinstance(cluster, Client):
            if cluster.asynchronous:
                raise _core.UsageError("the cluster's client is asynchronous; make another one")
            return cluster
        is_local = isinstance(cluster, str) and cluster.startswith("local:")
        if is_local:
            cluster = self._own.enter_context(local_cluster(cluster))
        elif not isinstance(cluster, str) and not hasattr(cluster, "scheduler_address"):
            raise _core.UsageError(
                f"cluster is {cluster!r}, but should be a dask client, a cluster, an address "
                "such as 'tcp://host:8786', or 'local:4' for four processes of this machine"
            )
        logging.getLogger("distributed.client").addFilter(_is_news)
        try:
            # Results of `local:N` are encrypted once only.
            client = Client(cluster, timeout=CONNECT_SECONDS, direct_to_workers=is_local)
            return self._own.enter_context(client)
        except TypeError:  # what dask says of TLS without a certificate
            raise _core.UsageError(
                f"{cluster} asks for a certificate, but dask's settings name none "
                "(distributed.comm.tls)"
            ) from None
        except (OSError, ValueError, TimeoutError) as error:
            raise _core.UsageError(f"no cluster at {cluster}: {error}") from None

    def close(self) -> None:
        self._own.close()


def _is_news(record: logging.LogRecord) -> bool:
    """Not the traceback of an attempt to connect anew that was broken off."""
    return not (record.exc_info and isinstance(record.exc_info[1], asyncio.CancelledError))
