"""`pymlt merge`: several renders as one image."""

from __future__ import annotations

from ..pictures.output import EXTENSIONS, check_writable
from ..rendering.frames import PLACE, check_pattern, file_of, parse_frames
from ..rendering.merged_shots import frames_of_all
from ..rendering.merging import merge
from .common import reader, say, warn
from .display import add_bits, add_display_flags, exposure

HELP = "Merge renders of one scene with different seeds."


def add_arguments(command) -> None:
    command.add_argument(
        "renders",
        metavar="FILE",
        nargs="+",
        help=".exr files that pymlt has written, or those of shots, such as a.####.exr",
    )
    command.add_argument(
        "-o", "--output", metavar="FILE", required=True, help=", ".join(EXTENSIONS)
    )
    command.add_argument(
        "--frames",
        type=reader(parse_frames),
        metavar="FIRST:LAST",
        help="which frames of shots, such as 1:24 or 1:24,31 (all that every shot has)",
    )
    command.add_argument(
        "--force", action="store_true", help="whether or not they have the same scene and settings"
    )
    add_display_flags(command)
    add_bits(command)


def run(args) -> int:
    if args.frames is None and not PLACE.search(args.output):
        check_writable(args.output, args.bits)
        return 0 if merged(args, args.renders, args.output) else 3
    pattern, patterns = check_pattern(args.output), [check_pattern(name) for name in args.renders]
    numbers, missing = frames_of_all(patterns, args.frames)
    warn(missing)
    check_writable(file_of(pattern, numbers[0]), args.bits)
    complete = True
    for number in numbers:
        files = [file_of(p, number) for p in patterns]
        complete = merged(args, files, file_of(pattern, number)) and complete
    return 0 if complete else 3


def merged(args, files: list[str], output: str) -> bool:
    """Merges these files. Whether the image is where it was asked for."""
    image = merge(files, force=args.force)
    path, problem = image._save(output, exposure(args), args.tonemap, args.bits)
    if problem:
        say(problem)
    width, height = image.stats["size"]
    count, spp = image.stats["renders"], image.stats["spp_done"]
    say(f"{count} renders of {width} x {height}, {spp:.4g} spp together: {path or 'not saved'}")
    return not problem
