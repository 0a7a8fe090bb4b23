"""`pymlt merge`: several renders as one image."""

from __future__ import annotations

from ..pictures.output import EXTENSIONS, check_writable
from ..rendering.merging import merge
from .common import say
from .display import add_bits, add_display_flags, exposure

HELP = "Merge renders of one scene with different seeds."


def add_arguments(command) -> None:
    command.add_argument(
        "renders", metavar="FILE", nargs="+", help=".exr files that pymlt has written"
    )
    command.add_argument(
        "-o", "--output", metavar="FILE", required=True, help=", ".join(EXTENSIONS)
    )
    command.add_argument(
        "--force", action="store_true", help="whether or not they have the same scene and settings"
    )
    add_display_flags(command)
    add_bits(command)


def run(args) -> int:
    check_writable(args.output, args.bits)
    merged = merge(args.renders, force=args.force)
    path, problem = merged._save(args.output, exposure(args), args.tonemap, args.bits)
    if problem:
        say(problem)
    width, height = merged.stats["size"]
    count, spp = merged.stats["renders"], merged.stats["spp_done"]
    say(f"{count} renders of {width} x {height}, {spp:.4g} spp together: {path or 'not saved'}")
    return 3 if problem else 0
