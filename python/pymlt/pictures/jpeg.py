"""JPEG files, by OpenImageIO."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .. import _core
from .tonemapping import Exposure, encode_srgb, tonemap

if TYPE_CHECKING:
    import numpy as np

EXTENSIONS = (".jpg", ".jpeg")
QUALITY = 95  #: of 100


def is_jpeg(path: str) -> bool:
    """Whether a file of this name is to be a JPEG."""
    return path.lower().endswith(EXTENSIONS)


def encode_jpeg(image: np.ndarray, curve: str, exposure: Exposure) -> bytes:
    """A JPEG file of linear pixels: 8 bits, sRGB, full resolution of the colours.

    Raises UsageError for an image that JPEG cannot hold, such as one with alpha.
    """
    import tempfile

    import numpy as np
    import OpenImageIO

    pixels = image if image.ndim == 3 else image[..., None]
    height, width, channels = pixels.shape
    if channels not in (1, 3) or not 0 < max(width, height) <= 65500:
        raise _core.UsageError(
            f"JPEG holds 1 or 3 channels and at most 65500 x 65500 pixels, not {width} x {height} "
            f"with {channels} channels; use PNG"
        )
    samples = np.floor(255 * encode_srgb(tonemap(pixels, curve, exposure=exposure)) + 0.5)
    spec = OpenImageIO.ImageSpec(width, height, channels, OpenImageIO.UINT8)
    spec.attribute("Compression", f"jpeg:{QUALITY}")
    spec.attribute("jpeg:subsampling", "4:4:4")
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "image.jpg")
        file = OpenImageIO.ImageOutput.create(path)
        codes = samples.astype(np.uint8)
        if not (file and file.open(path, spec) and file.write_image(codes) and file.close()):
            raise _core.FileError(f"{path}: {OpenImageIO.geterror().strip()}")
        return Path(path).read_bytes()
