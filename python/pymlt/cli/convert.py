"""`pymlt convert`: a scene of another program as Mitsuba XML."""

from __future__ import annotations

from ..formats.files import convert
from ..scenes.kinds import EXTENSIONS
from .common import say, warn

HELP = "Write a scene of glTF, pbrt or USD, or a mesh, as Mitsuba XML, meshes and images beside it."


def add_arguments(command) -> None:
    command.add_argument("input", metavar="IN", help=", ".join(EXTENSIONS))
    command.add_argument("output", metavar="OUT", help=".xml")


def run(args) -> int:
    warn(convert(args.input, args.output))
    say(args.output)
    return 0
