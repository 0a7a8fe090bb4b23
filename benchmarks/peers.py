"""Renderers in processes of their own, which may run in a Python without pymlt."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


class MissingError(Exception):
    """What a benchmark needs is not there."""


class Worker:
    """A renderer in a process of its own; answers each line of JSON with one."""

    def __init__(self, python, script: str, *arguments: str, environment=None):
        command = [str(python), str(HERE / script), *arguments]
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, **(environment or {})},
        )
        self.ready = self._answer()

    def ask(self, **request):
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()
        return self._answer()

    def close(self):
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.close()
        self.process.wait()

    def _answer(self):
        for line in self.process.stdout:
            if line.startswith("{"):  # libraries talk, too
                answer = json.loads(line)
                if "skip" in answer:
                    raise MissingError(answer["skip"])
                return answer
        last = self.process.stderr.read().strip().splitlines()[-1:]
        raise MissingError(f"{self.process.args[1]} ended: {' '.join(last) or 'no reason given'}")


def serve(ready: dict, answer) -> None:
    """The other side of Worker."""
    print(json.dumps(ready), flush=True)
    for line in sys.stdin:
        print(json.dumps(answer(**json.loads(line))), flush=True)
