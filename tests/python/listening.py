"""The TCP sockets that this process and its children listen at."""

from __future__ import annotations

from typing import NamedTuple

import psutil


class Listener(NamedTuple):
    pid: int
    host: str
    port: int


def listeners() -> set[Listener]:
    me = psutil.Process()
    return {
        Listener(process.pid, *connection.laddr)
        for process in [me, *me.children(recursive=True)]
        for connection in process.net_connections("tcp")
        if connection.status == psutil.CONN_LISTEN
    }
