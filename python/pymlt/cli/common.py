"""What the commands share."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable

from .. import _core, scenes
from ..scenes.loading import load_built_in, load_file

FLAGS = {flag.name: flag for flag in _core.render_flags()}


class Parser(argparse.ArgumentParser):
    """Its errors are one line."""

    def error(self, message):
        raise _core.UsageError(f"{message}; see {self.prog} --help")


def say(message) -> None:
    print("pymlt:", " ".join(str(message).split("\n")), file=sys.stderr, flush=True)


def warn(warnings: list[str]) -> None:
    for warning in warnings:
        say(f"warning: {warning}")


def add_flag(command: Parser, flag: _core.Flag) -> None:
    """A flag of the table that mlt-render shares; None (or []) if it is not given."""
    if not flag.has_value:
        command.add_argument(flag.spelling, action="store_true", help=flag.help)
        return
    settings = {"metavar": flag.metavar, "help": flag.help, "type": reader(flag.read)}
    if flag.repeatable:
        settings |= {"action": "append", "default": []}
    if flag.spelling.startswith("-"):
        settings |= {"dest": flag.name, "required": flag.required}
    else:
        settings |= {"nargs": "?"}
    command.add_argument(*flag.spelling.split(","), **settings)


def reader(read: Callable[[str], object]) -> Callable[[str], object]:
    """A function for argparse's `type` that keeps the message of a UsageError."""

    def call(text: str):
        try:
            return read(text)
        except _core.UsageError as error:
            raise argparse.ArgumentTypeError(str(error)) from None

    return call


def load_scene(args) -> _core.Scene:
    """The file or the built-in scene that the arguments `scene`, `defines` and `size` mean."""
    defines, size = dict(args.defines), getattr(args, "size", None)
    name = args.scene.replace("-", "_")
    if os.path.exists(args.scene):
        return load_file(args.scene, size=size, **defines)
    if name in scenes.names():
        return load_built_in(name, defines, size)
    if "." in name or os.sep in name:
        raise _core.FileError(f"{args.scene}: no such file")
    raise _core.UsageError(
        f"{args.scene!r} is neither a file nor a built-in scene"
        + _core.suggestion(name, scenes.names()),
    )
