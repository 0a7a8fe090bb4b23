"""`pymlt --print-completion bash`: what a shell needs to complete commands, flags and files."""

from __future__ import annotations

import argparse

from .._extras import import_extra
from .common import emit

SHELLS = ("bash", "zsh", "tcsh")
FILES = ("FILE", "SCENE", "IN", "OUT", "A", "B")  #: what arguments that name files are called


class PrintCompletion(argparse.Action):
    """Prints the script for a shell and ends the program, as --version does."""

    def __call__(self, parser, namespace, shell, option_string=None):
        shtab = import_extra("shtab", "completion", "--print-completion")
        mark_files(parser, shtab.FILE)
        emit(shtab.complete(parser, shell))
        parser.exit()


def mark_files(parser: argparse.ArgumentParser, file: dict[str, str]) -> None:
    """Says which arguments of a command, and of those below it, are the names of files."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            action.help = None  # shtab leaves out what --help does not show
            for command in action.choices.values():
                mark_files(command, file)
        elif action.metavar in FILES:
            action.complete = file  # type: ignore[attr-defined]
