"""`pymlt convert`: a scene of another program as Mitsuba XML."""

from __future__ import annotations

from ..formats.files import convert
from .common import say, warn

HELP = "Write a glTF or pbrt-v4 scene as Mitsuba XML, with its meshes and images beside it."


def add_arguments(command) -> None:
    command.add_argument("input", metavar="IN", help=".gltf, .glb or .pbrt")
    command.add_argument("output", metavar="OUT", help=".xml")


def run(args) -> int:
    warn(convert(args.input, args.output))
    say(args.output)
    return 0
