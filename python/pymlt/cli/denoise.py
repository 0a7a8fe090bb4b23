"""`pymlt denoise`: an image file without most of its noise."""

from __future__ import annotations

from .._core import FileError
from ..images import read_image, read_metadata, read_with_layers
from ..pictures.denoising import GUIDES, denoise_with_layers
from ..pictures.output import EXTENSIONS, OutputFile, check_writable
from .common import say
from .display import add_bits, add_display_flags, exposure

HELP = "Remove noise from an image by Open Image Denoise."


def add_arguments(command) -> None:
    command.add_argument("image", metavar="IN", help="an image, best an .exr of linear light")
    command.add_argument(
        "-o", "--output", metavar="FILE", required=True, help=", ".join(EXTENSIONS)
    )
    for guide, names in GUIDES.items():
        command.add_argument(
            f"--{guide}",
            metavar="FILE",
            help=f"an image that guides the filter, in place of a layer {' or '.join(names)} of IN",
        )
    add_display_flags(command)
    add_bits(command)


def run(args) -> int:
    check_writable(args.output, args.bits)
    image, layers = read_with_layers(args.image)
    given = {guide: read_image(path) for guide in GUIDES if (path := getattr(args, guide))}
    denoised = denoise_with_layers(image, layers, metadata_of(args.image), **given)
    shown = exposure(args), args.tonemap, args.bits
    path, problem = OutputFile(args.output, *denoised, False, *shown).save()
    if problem:
        say(problem)
    say(f"{denoised.metadata['denoised']}: {path or 'not saved'}")
    return 3 if problem else 0


def metadata_of(path: str) -> dict[str, str]:
    """Of a file that can be read; only EXR has any."""
    try:
        return read_metadata(path)
    except FileError:
        return {}
