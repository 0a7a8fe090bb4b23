"""Files that a stage names, also those within a package (.usdz)."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Ar, Sdf, Usd

from ... import _core
from ...images import read_image
from ...pictures.tonemapping import split_alpha
from ..imported import Imported
from ..limits import MEMORY, check_pixels
from ..missing import ABSENT, is_missing
from ..pbrt.images import BYTES

SMALL = 2**16  #: bytes
LINEAR = (b"\x76\x2f\x31\x01", b"#?")  #: how EXR and HDR files begin


def asset(attribute: Usd.Attribute, time: Usd.TimeCode, made: Imported) -> dict[str, Any] | None:
    """The file of an attribute as the parameter `filename`, or `data` if it is in a package.

    None if there is none. A missing one is noted.
    """
    given = attribute.Get(time) if attribute else None
    if given is None or not given.path:
        return None
    if "<UDIM>" in given.path:
        made.warn("images in tiles (<UDIM>) are left out")
        return None
    found = given.resolvedPath or anchored(attribute, given.path)
    if Ar.IsPackageRelativePath(found):
        return {"data": packaged(found)}
    if is_missing(found):
        made.missing.setdefault(f"{found}: {ABSENT}", "")
    return {"filename": found}


def anchored(attribute: Usd.Attribute, path: str) -> str:
    """Where a file would be that is named in the layer of an attribute."""
    layers = [spec.layer for spec in attribute.GetPropertyStack()]
    found: str = Sdf.ComputeAssetPathRelativeToLayer(layers[0], path) if layers else path
    return found


def packaged(path: str) -> bytes:
    """A file within a package. Raises FileError if it is too large or cannot be read."""
    opened = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(path))
    content = opened.GetBuffer() if opened and opened.GetSize() <= MEMORY else None
    if content is None:
        raise _core.FileError(f"{path}: cannot be read")
    return bytes(content)


def pixels(file: dict[str, Any]) -> np.ndarray | None:
    """The linear pixels of a file, (height, width, channels); None if it is missing.

    Raises FileError for images that cannot be read or are too large to be changed.
    """
    if "data" in file:
        image = _core.decode_image(file["data"], "an image in a package")
    elif is_missing(file["filename"]):
        return None
    else:
        image = read_image(Path(file["filename"]))
    check_pixels(image, file.get("filename", "an image in a package"))
    return image.reshape(*image.shape[:2], -1)


def rgb_pixels(file: dict[str, Any]) -> np.ndarray | None:
    """The linear red, green and blue of a file, (height, width, 3); None if it is missing."""
    image = pixels(file)
    if image is None:
        return None
    colours, _ = split_alpha(image)
    return np.broadcast_to(colours, (*colours.shape[:2], 3))


def is_small(file: dict[str, Any]) -> bool:
    """Whether an image is quickly read, if it is there."""
    if "data" in file:
        return len(file["data"]) < SMALL
    return not is_missing(file["filename"]) and os.stat(file["filename"]).st_size < SMALL


def is_encoded(file: dict[str, Any]) -> bool:
    """Whether a file has a format of bytes, in which colours are encoded as sRGB."""
    if "data" in file:
        return not file["data"].startswith(LINEAR)
    return Path(file["filename"]).suffix.lower() in BYTES
