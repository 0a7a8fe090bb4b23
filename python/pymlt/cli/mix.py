"""`pymlt mix`: other intensities and colours of the lights of a render."""

from __future__ import annotations

from .. import _core
from ..pictures.output import EXTENSIONS, check_writable
from ..rendering.mixing import mix
from .common import FLAGS, reader, say
from .display import add_bits, add_display_flags, exposure

HELP = "Change the lights of a render that has light groups."


def add_arguments(command) -> None:
    command.add_argument("image", metavar="IN", help="an .exr with light groups")
    command.add_argument(
        "factors",
        metavar="NAME=FACTOR",
        nargs="+",
        type=reader(factor),
        help="by what the light of a group is multiplied: a number, or red,green,blue as in "
        "sun=1,.5,.2; that of other groups stays",
    )
    command.add_argument(
        "-o", "--output", metavar="FILE", required=True, help=", ".join(EXTENSIONS)
    )
    add_display_flags(command)
    add_bits(command)


def factor(text: str) -> tuple[str, float | list[float]]:
    name, value = FLAGS["defines"].read(text)
    try:
        numbers = [float(number) for number in value.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) not in (1, 3):
        raise _core.UsageError(f"{text!r} has no factor; use {name}=2 or {name}=1,.5,.2")
    return name, numbers[0] if len(numbers) == 1 else numbers


def run(args) -> int:
    check_writable(args.output, args.bits)
    names = [name for name, _ in args.factors]
    for name in names:
        if names.count(name) > 1:
            raise _core.UsageError(f"the light group {name!r} is given twice; use one factor")
    mixed = mix(args.image, **dict(args.factors))
    path, problem = mixed._save(args.output, exposure(args), args.tonemap, args.bits)
    if problem:
        say(problem)
    say(f"{mixed.metadata.get('mixed', 'as it was')}: {path or 'not saved'}")
    return 3 if problem else 0
