"""Files that are no files, and what the command line says of scenes that name them."""

import os
from pathlib import Path

from pymlt import cli

HUGE = 2**40


def make_places() -> None:
    """Pipes, a folder, a link to itself and a file of a terabyte, in the current folder."""
    os.symlink("loop", "loop")
    os.mkfifo("fifo")
    os.mkfifo("fifo.ply.gz")
    Path("folder").mkdir()
    with open("sparse.bin", "wb") as file:
        file.truncate(HUGE)


def refused(name: str, message: str, capsys) -> None:
    """The command line refuses a file by one line."""
    assert cli.main(["info", name]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert message in said
    assert len(said) < 2000
