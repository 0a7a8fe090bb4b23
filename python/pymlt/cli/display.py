"""How pictures are shown: the flags of the commands that write them."""

from __future__ import annotations

from ..pictures.tonemapping import ANY_VIEW, CURVES, Exposure, check_tonemap
from .common import FLAGS, Parser, add_flag, reader

EXPOSURE_HELP = (
    "brighten pictures (PNG, JPEG, TIFF) by this number of stops; auto: as suits the image"
)
TONEMAP_HELP = (
    f"tone curve of pictures (PNG, JPEG, TIFF): {', '.join(CURVES)} (srgb: clip at 1), or "
    f"{ANY_VIEW}, a view of OpenColorIO"
)


def add_tonemap(command: Parser) -> None:
    command.add_argument(
        "--tonemap",
        metavar="CURVE",
        default="srgb",
        type=reader(check_tonemap),
        help=TONEMAP_HELP,
    )


def add_bits(command: Parser) -> None:
    command.add_argument(
        "--bits",
        metavar="N",
        type=int,
        choices=(8, 16, 32),
        help="bits of each sample of pictures: PNG 8 or 16, JPEG 8, TIFF 16, 8 or 32 (linear "
        "floats, without exposure and curve); by default the first",
    )


def add_display_flags(command: Parser) -> None:
    add_flag(command, FLAGS["exposure"], EXPOSURE_HELP)
    add_tonemap(command)


def exposure(args, default: Exposure = 0) -> Exposure:
    return default if args.exposure is None else args.exposure
