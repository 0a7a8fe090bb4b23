"""The TCP sockets that this process and its children listen at."""

from __future__ import annotations

from contextlib import suppress
from typing import NamedTuple

import psutil


class Listener(NamedTuple):
    pid: int
    host: str
    port: int


def listeners() -> set[Listener]:
    me = psutil.Process()
    found = set()
    for process in [me, *me.children(recursive=True)]:
        with suppress(psutil.NoSuchProcess):  # it has ended meanwhile
            connections = process.net_connections("tcp")
            listening = [one for one in connections if one.status == psutil.CONN_LISTEN]
            found |= {Listener(process.pid, *one.laddr) for one in listening}
    return found
