"""A command of the shell, and the CPU time that it takes."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import tempfile
from collections.abc import Callable
from time import monotonic, sleep
from typing import IO

from .. import _core


def run_child(command: str, *, patience: float, watch: Callable[[float], object]) -> float:
    """Run a command; the CPU seconds of it and of all processes that it waited for.

    `watch` is called all the while with the seconds that have passed; what it raises ends the
    command. Raises RenderError if it does not end with 0, or not within `patience` seconds.
    """
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(
            command,
            shell=True,
            stdin=subprocess.DEVNULL,
            stdout=said,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        begun, ended = monotonic(), 0
        try:
            while not ended:
                ended, status, usage = os.wait4(process.pid, os.WNOHANG)
                if not ended:
                    passed = monotonic() - begun
                    if passed > patience:
                        raise _core.RenderError(f"it has not ended after {patience:.0f} seconds")
                    watch(passed)
                    sleep(0.01)
        except BaseException:
            _end(process)
            raise
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise _core.RenderError(_failure(process.returncode, said))
        return usage.ru_utime + usage.ru_stime


def _end(process: subprocess.Popen[bytes]) -> None:
    """All processes of its group."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def _failure(code: int, said: IO[bytes]) -> str:
    """How it ended, and the last line that it wrote."""
    said.seek(max(0, said.seek(0, os.SEEK_END) - 4096))
    lines = said.read().decode(errors="replace").split("\n")
    last = next((line.strip() for line in reversed(lines) if line.strip()), "no reason given")
    how = f"with code {code}" if code > 0 else f"by {signal.Signals(-code).name}"
    return f"it ended {how}: {last}"
