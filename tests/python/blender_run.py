"""Runs a script with `bpy` in a process of its own."""

import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
# Blender 4.2 as a module crashes when Python ends after any render engine has been registered.
START = """
import os, runpy, sys
del sys.argv[0]
sys.path.insert(0, os.path.dirname(sys.argv[0]))
runpy.run_path(sys.argv[0], run_name="__main__")
os._exit(0)
"""


def run(script: str, *arguments, user: Path) -> None:
    """Raises AssertionError with what it said if it fails; `user` is for Blender's settings."""
    done = subprocess.run(
        [sys.executable, "-c", START, HERE / script, *arguments],
        env=os.environ | {"BLENDER_USER_RESOURCES": str(user)},
        capture_output=True,
        text=True,
        timeout=250,
    )
    assert done.returncode == 0, done.stderr + done.stdout
