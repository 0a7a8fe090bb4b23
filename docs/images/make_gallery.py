"""Makes the pictures of docs/gallery.md by the commands that stand there:

    python docs/images/make_gallery.py [NAME ...] [-- FLAG ...]

All of them take more than an hour of CPU time. Flags are added to each command, such as
-- --size 320x180.
"""

import shlex
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
PAGE = HERE.parent / "gallery.md"


def commands() -> list[list[str]]:
    lines = PAGE.read_text().splitlines()
    return [shlex.split(line)[1:] for line in lines if line.startswith("    pymlt render ")]


def main(names: list[str], flags: list[str]) -> None:
    for command in commands():
        if not names or command[1] in names:
            program = [sys.executable, "-m", "pymlt", *command, *flags]
            print(*program[2:], flush=True)
            subprocess.run(program, cwd=HERE, check=True)


if __name__ == "__main__":
    arguments = [*sys.argv[1:], "--"]
    end = arguments.index("--")
    main(arguments[:end], arguments[end + 1 : -1])
