"""What the commands share."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
from collections.abc import Callable

from .. import _core, scenes
from ..formats.files import is_foreign, load_foreign
from ..scenes.loading import load_built_in, load_file

FLAGS = {flag.name: flag for flag in _core.render_flags()}


class Parser(argparse.ArgumentParser):
    """Its errors are one line."""

    def _print_message(self, message, file=None):
        emit(message.rstrip("\n"))

    def error(self, message):
        raise _core.UsageError(f"{message}; see {self.prog} --help")


def open_standard_streams() -> None:
    """Opens those that are closed, so that no file of ours takes the number of one."""
    for stream in range(3):
        try:
            os.fstat(stream)
        except OSError:
            os.open(os.devnull, os.O_RDWR)


def say(message) -> None:
    """One line on stderr, if that can be written to; what is rendered does not depend on it."""
    if sys.stderr is not None:
        with contextlib.suppress(OSError):
            print("pymlt:", " ".join(str(message).split("\n")), file=sys.stderr, flush=True)


def emit(text: str) -> None:
    """What a command is asked for, on stdout. Raises FileError if that cannot be written to."""
    if sys.stdout is None:
        raise _core.FileError("stdout: cannot write it: it is closed")
    try:
        print(text, flush=True)
    except BrokenPipeError:  # the reader of our output (`| head`) has seen enough
        drop_stdout()
    except OSError as error:
        drop_stdout()
        raise _core.FileError(f"stdout: cannot write it: {error.strerror}") from None


def drop_stdout() -> None:
    """What is left in its buffer goes nowhere when Python ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def warn(warnings: list[str]) -> None:
    for warning in warnings:
        say(f"warning: {warning}")


def add_flag(command: Parser, flag: _core.Flag, help: str = "") -> None:
    """A flag of the table that mlt-render shares; None (or []) if it is not given."""
    help = help or flag.help
    if not flag.has_value:
        command.add_argument(flag.spelling, action="store_true", help=help)
        return
    settings = {"metavar": flag.metavar, "help": help, "type": reader(flag.read)}
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


def built_in_name(text: str) -> str | None:
    """The name of the built-in scene that somebody means, who may have written door-ajar."""
    name = text.replace("-", "_")
    return name if name in scenes.names() else None


def load_scene(args) -> _core.Scene:
    """The file or the built-in scene that the arguments `scene`, `defines` and so on mean."""
    defines, size = dict(args.defines), getattr(args, "size", None)
    sensor, filter = getattr(args, "sensor", None), getattr(args, "filter", None)
    if os.path.exists(args.scene) and is_foreign(args.scene):
        if args.lenient or args.strict or defines:
            raise _core.UsageError(f"{args.scene}: -D, --lenient and --strict are for Mitsuba XML")
        scene, found = load_foreign(args.scene, size, sensor, filter or "")
        warn(found)
        return scene
    if os.path.exists(args.scene):
        if args.lenient and args.strict:
            raise _core.UsageError("--lenient and --strict exclude each other")
        lenient = args.lenient or (False if args.strict else None)
        return load_file(
            args.scene, size=size, lenient=lenient, sensor=sensor, filter=filter, **defines
        )
    if name := built_in_name(args.scene):
        return load_built_in(name, defines, size, sensor, filter)
    if "." in args.scene or os.sep in args.scene:
        raise _core.FileError(f"{args.scene}: there is no such file")
    raise _core.UsageError(
        f"{args.scene!r} is neither a file nor a built-in scene"
        + _core.suggestion(args.scene.replace("-", "_"), scenes.names()),
    )
