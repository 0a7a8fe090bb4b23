"""`pymlt merge`: several renders as one image."""

from __future__ import annotations

from .. import _core
from ..rendering.merging import merge
from .common import say

HELP = "Merge renders of one scene with different seeds."


def add_arguments(command) -> None:
    command.add_argument(
        "renders", metavar="FILE", nargs="+", help=".exr files that pymlt has written"
    )
    command.add_argument("-o", "--output", metavar="FILE", required=True, help=".exr, .png or .hdr")
    command.add_argument(
        "--force", action="store_true", help="whether or not they have the same scene and settings"
    )


def run(args) -> int:
    _core.check_image_writable(args.output)
    merged = merge(args.renders, force=args.force)
    path, problem = merged._save(args.output)
    if problem:
        say(problem)
    width, height = merged.stats["size"]
    count, spp = merged.stats["renders"], merged.stats["spp_done"]
    say(f"{count} renders of {width} x {height}, {spp:.4g} spp together: {path or 'not saved'}")
    return 3 if problem else 0
