"""How many bits the samples of a picture have, and the files that OpenImageIO writes: PNG, TIFF."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .. import _core
from .tonemapping import encode_srgb, split_alpha, with_channels

if TYPE_CHECKING:
    import numpy as np

#: By extension the bits that a sample may have, first those it has unless others are asked for.
BITS = {".png": (8, 16), ".jpg": (8,), ".jpeg": (8,), ".tif": (16, 8, 32), ".tiff": (16, 8, 32)}


def bits_of(path: str, bits: int | None) -> int | None:
    """The bits of each sample of a picture, None for a file of linear light.

    Raises UsageError if the format has no samples of so many bits.
    """
    extension = Path(path).suffix.lower()
    if extension not in BITS:
        return None
    known = BITS[extension]
    if bits is not None and bits not in known:
        others = [name for name, sizes in BITS.items() if bits in sizes and name != ".tiff"]
        use = f"use {' or '.join(map(str, sorted(known)))}"
        other = f", or {' or '.join(others)}" if others else ""
        raise _core.UsageError(f"{path}: {extension} has no samples of {bits} bits; {use}{other}")
    return bits or known[0]


def encode(shown: np.ndarray, name: str, bits: int | None) -> bytes:
    """A PNG or TIFF file, as the name says: sRGB codes of linear light, in 32 bits that itself.

    A second or fourth channel is alpha, by which the colours are not multiplied. What is not a
    number becomes 0. Raises UsageError for other shapes.
    """
    import tempfile

    import numpy as np
    import OpenImageIO

    samples = np.nan_to_num(with_channels(shown))
    height, width, channels = samples.shape
    if channels > 4:
        raise _core.UsageError(
            f"{name}: an image with {channels} channels can only be written as EXR, by their names"
        )
    colours, alpha = split_alpha(samples)
    if bits in (8, 16):
        codes = np.concatenate([encode_srgb(colours), alpha.clip(0, 1)], axis=2)
        samples = np.floor((2**bits - 1) * codes + 0.5).astype(f"uint{bits}")
    spec = OpenImageIO.ImageSpec(
        width, height, channels, samples.dtype.name.replace("float32", "float")
    )
    spec.attribute("compression", "zip")
    if alpha.shape[2]:
        spec.alpha_channel = channels - 1
        spec.attribute("oiio:UnassociatedAlpha", 1)
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / f"image{Path(name).suffix}")
        file = OpenImageIO.ImageOutput.create(path)
        if not (file and file.open(path, spec) and file.write_image(samples) and file.close()):
            raise _core.FileError(f"{path}: {OpenImageIO.geterror().strip()}")
        return Path(path).read_bytes()
