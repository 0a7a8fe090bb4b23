"""TIFF files, by OpenImageIO."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .. import _core
from .tonemapping import encode_srgb, split_alpha

if TYPE_CHECKING:
    import numpy as np

EXTENSIONS = (".tif", ".tiff")


def encode_tiff(shown: np.ndarray) -> bytes:
    """A TIFF file of what `tonemap` returns: 16 bits, sRGB, deflated.

    A second or fourth channel is alpha, by which the colours are not multiplied.
    """
    import tempfile

    import numpy as np
    import OpenImageIO

    colours, alpha = split_alpha(shown if shown.ndim == 3 else shown[..., None])
    encoded = np.concatenate([encode_srgb(colours), alpha.clip(0, 1)], axis=2)
    height, width, channels = encoded.shape
    spec = OpenImageIO.ImageSpec(width, height, channels, OpenImageIO.UINT16)
    spec.attribute("compression", "zip")
    if alpha.shape[2]:
        spec.alpha_channel = channels - 1
        spec.attribute("oiio:UnassociatedAlpha", 1)
    codes = np.floor(65535 * encoded + 0.5).astype(np.uint16)
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "image.tif")
        file = OpenImageIO.ImageOutput.create(path)
        if not (file and file.open(path, spec) and file.write_image(codes) and file.close()):
            raise _core.FileError(f"{path}: {OpenImageIO.geterror().strip()}")
        return Path(path).read_bytes()
