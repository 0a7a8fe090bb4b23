"""The command lines, `pymlt render` and `mlt-render`, as tests call them."""

import os
import subprocess
import sys
from pathlib import Path

PYMLT = [sys.executable, "-m", "pymlt"]


def mlt_render() -> list[str] | None:
    """The binary of the same build: beside the interpreter, or named by the environment."""
    beside = Path(sys.executable).parent / "mlt-render"
    found = os.environ.get("MLT_RENDER") or (beside if beside.exists() else None)
    return [str(found)] if found else None


def run(command, *arguments, **kwargs):
    return subprocess.run(
        [*command, *map(str, arguments)], capture_output=True, text=True, timeout=60, **kwargs
    )


def the_error(outcome, code: int = 2) -> str:
    """The single line on stderr of a command that ended with this code."""
    assert outcome.returncode == code, outcome.stderr
    assert outcome.stdout == ""
    lines = outcome.stderr.splitlines()
    assert len(lines) == 1, outcome.stderr
    assert lines[0].startswith(("pymlt: ", "mlt-render: "))
    return lines[0]
