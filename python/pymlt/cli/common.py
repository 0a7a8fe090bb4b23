"""What the commands share."""

from __future__ import annotations

import argparse
import contextlib
import os
import re
import sys
from collections.abc import Callable

from .. import _core
from ..formats.loading import load_with_warnings
from ..rendering.progress import above_bars

FLAGS = {flag.name: flag for flag in _core.render_flags()}


class Parser(argparse.ArgumentParser):
    """Its errors are one line, which names the flag that a misspelt one may have been."""

    def parse_known_args(self, args=None, namespace=None):
        texts = sys.argv[1:] if args is None else list(args)
        commands = next((a.choices for a in self._actions if isinstance(a.choices, dict)), {})
        for text in texts:
            flag = text.partition("=")[0]
            if text == "--" or (commands and not text.startswith("-")):
                break  # what follows is the command's own
            if re.fullmatch("--[a-z-]+", flag) and flag not in self._option_string_actions:
                self.error(f"there is no flag {flag}{self._meant(flag, commands)}")
        return super().parse_known_args(texts, namespace)

    def _meant(self, flag: str, commands: dict[str, Parser]) -> str:
        """The flag of this command, or of one of those below, that this one is like."""
        for parser in (self, *commands.values()):
            known = [text for text in parser._option_string_actions if text.startswith("--")]
            hint = _core.suggestion(flag, known)
            if hint.endswith("?"):
                return hint if parser is self else f"{hint[:-1]} of {parser.prog}?"
        return ""

    def _print_message(self, message, file=None):
        emit(message.rstrip("\n"))

    def error(self, message):
        hint = "" if message.endswith("?") else f"; see {self.prog} --help"
        raise _core.UsageError(message + hint)


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
        with contextlib.suppress(OSError), above_bars():
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
    help = (help or flag.help).replace("%", "%%")
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


#: What --lenient leaves out of a file, which no error takes for a misspelling; all that is refused.
LEFT_OUT = re.compile(
    r"unknown (parameter '[^']*' for \w+|integrator) '[^']*'; valid are"
    r"|: integrator '[^']*' is not supported"
)
REFUSED = re.compile(r"\bunknown \w+ '|' is not supported")


def names_leniency(error: _core.SceneError, args) -> _core.SceneError:
    """The same error, which also names --lenient if that would leave out all that is wrong."""
    text = str(error)
    asked = getattr(args, "lenient", True) or args.strict
    left_out = sum(1 for _ in LEFT_OUT.finditer(text))
    if asked or not left_out or left_out < len(REFUSED.findall(text)):
        return error
    return type(error)(f"{text}; --lenient leaves out what is unknown here")


def load_scene(args) -> _core.Scene:
    """The file or the built-in scene that the arguments `scene`, `defines` and so on mean."""
    if args.lenient and args.strict:
        raise _core.UsageError("--lenient and --strict exclude each other")
    settings = {name: getattr(args, name, None) for name in ("size", "sensor", "filter")}
    lenient = args.lenient or (False if args.strict else None)
    scene, found = load_with_warnings(args.scene, dict(args.defines), lenient=lenient, **settings)
    warn(found)
    return scene.with_wavelengths() if getattr(args, "spectral", False) else scene
