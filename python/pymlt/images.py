"""Image files: linear numpy arrays in memory, whatever the format."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any

from . import _core
from .pictures.output import OutputFile
from .pictures.tonemapping import Exposure, decode_srgb, split_alpha

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


def read_image(path: str | os.PathLike[str], layer: str = "") -> NDArray[np.float32]:
    """Read an image as float32 of shape (height, width, channels), in linear light.

    EXR, PNG, JPEG, HDR, TGA and BMP are read natively, whatever the file is called, anything else
    by OpenImageIO. `layer` names one of an EXR file's layers. Raises FileError for a file that
    cannot be read.
    """
    path = os.fspath(path)
    if layer or _core.is_known_image(path):
        return _core.read_image(path, layer)
    return _read_with_openimageio(path)


def _read_with_openimageio(path: str) -> np.ndarray:
    import numpy as np
    import OpenImageIO

    file = OpenImageIO.ImageInput.open(path)
    if file is None:
        raise _core.FileError(f"{path}: {OpenImageIO.geterror().strip() or 'cannot be read'}")
    try:
        is_integer = file.spec().format.basetype not in (
            OpenImageIO.HALF,
            OpenImageIO.FLOAT,
            OpenImageIO.DOUBLE,
        )
        pixels = file.read_image("float")
        if pixels is None:
            raise _core.FileError(f"{path}: {file.geterror().strip()}")
    finally:
        file.close()
    pixels = pixels[..., None] if pixels.ndim == 2 else pixels
    if is_integer:
        colours, alpha = split_alpha(pixels)
        pixels = np.concatenate([decode_srgb(colours), alpha], axis=2, dtype=np.float32)
    return pixels


def layer_names(path: str | os.PathLike[str]) -> list[str]:
    """The names of the layers of an EXR file, but for the unnamed one; of other files none.

    Raises FileError for a file that cannot be read.
    """
    import OpenImageIO

    file = OpenImageIO.ImageInput.open(os.fspath(path))
    if file is None:
        raise _core.FileError(f"{path}: {OpenImageIO.geterror().strip() or 'cannot be read'}")
    channels = file.spec().channelnames if file.format_name() == "openexr" else ()
    file.close()
    return sorted({name.rpartition(".")[0] for name in channels if "." in name})


def read_with_layers(path: str | os.PathLike[str]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """An image and its layers, by name.

    "alpha" is that of an EXR file, by which its colours are multiplied. Raises FileError for a file
    that cannot be read.
    """
    layers = {name: read_image(path, name) for name in layer_names(path)}
    image = read_image(path)
    if image.shape[2] in (2, 4) and read_header(path)["format"] == "openexr":
        image, layers["alpha"] = split_alpha(image)
    return image, layers


def read_header(path: str | os.PathLike[str]) -> dict[str, Any]:
    """What an image file is, without its pixels.

    Returns a dict of size ((width, height), pixels), format ("openexr", "png", ...), samples
    ("half", "float", "uint8", ...), channels (their names, with those of layers) and metadata
    (texts of an EXR file). Raises FileError for a file that cannot be read.
    """
    import OpenImageIO

    path = os.fspath(path)
    file = OpenImageIO.ImageInput.open(path)
    if file is None:
        raise _core.FileError(f"{path}: {OpenImageIO.geterror().strip() or 'cannot be read'}")
    spec, kind = file.spec(), file.format_name()
    file.close()
    return {
        "size": (spec.width, spec.height),
        "format": kind,
        "samples": str(spec.format),
        "channels": list(spec.channelnames),
        "metadata": read_metadata(path) if kind == "openexr" else {},
    }


def read_metadata(path: str | os.PathLike[str]) -> dict[str, str]:
    """The text attributes of an EXR file: how a render was made. Raises FileError."""
    return _core.read_metadata(os.fspath(path))


def write_image(
    path: str | os.PathLike[str],
    image: ArrayLike,
    *,
    exposure: Exposure = 0,
    tonemap: str = "srgb",
    bits: int | None = None,
    half: bool = False,
    metadata: dict[str, str] | None = None,
) -> None:
    """Write linear pixels to .exr, .hdr, or a picture to look at: .png, .jpg, .tif.

    image
        floats of shape (height, width) or (height, width, channels), with at most 4 channels; 1 is
        white. A second or fourth channel is alpha: in .exr colours are multiplied by it, in .png
        and .tif they are not, and pixels are written as they are given. What is not a number
        becomes 0, with a warning, in all files but .exr.
    exposure, tonemap
        for pictures, which are sRGB-encoded: stops by which they are brightened ("auto": as suits
        the image), and the curve, as `pymlt.tonemap` has them.
    bits
        for pictures, of each sample: 8 (usual) or 16 in .png, 8 in .jpg, 16 (usual), 8 or 32 in
        .tif, where 32 are floats of linear light, without exposure and curve.
    half, metadata
        for .exr: 16-bit samples, and texts for the header.

    Raises UsageError for another shape, type, curve, extension or number of bits, FileError if the
    file cannot be written.
    """
    import numpy as np

    given = np.asarray(image)
    if given.dtype.kind != "f":
        raise _core.UsageError(
            f"an image of {given.dtype} was given, but linear floats are written, in which 1 is "
            "white; divide integers by their largest value, and decode sRGB"
        )
    pixels = given.astype(np.float32)
    name = os.fspath(path)
    if not name.lower().endswith(".exr") and (bad := int(np.isnan(pixels).sum())):
        warnings.warn(f"{path}: {bad} samples are not numbers and become 0", stacklevel=2)
    OutputFile(name, pixels, {}, metadata or {}, half, exposure, tonemap, bits).write()
