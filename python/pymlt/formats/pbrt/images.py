"""Images of which the pixels are changed."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...images import read_image
from ...pictures.tonemapping import encode_srgb, split_alpha
from ..limits import check_pixels
from ..missing import is_missing

if TYPE_CHECKING:
    import numpy as np

#: Formats of bytes, which are encoded as sRGB unless something else is said.
BYTES = (".png", ".tga", ".bmp", ".jpg", ".jpeg")


def read_rgb(path: Path) -> np.ndarray:
    """In linear light, without alpha: (height, width, 3), also of an image of greys."""
    import numpy as np

    colours, _ = split_alpha(read_image(path))
    check_pixels(colours, str(path))
    return np.broadcast_to(colours, (*colours.shape[:2], 3))


def changed(
    bitmap: dict[str, Any], factor: np.ndarray, offset: np.ndarray, grey: bool
) -> dict[str, Any] | None:
    """A bitmap of which each pixel, or its mean, is multiplied, and an offset added; what is below
    0 becomes 0. None for one that has a black border, or decodes what is not of bytes."""
    import numpy as np

    if (bitmap["wrap_mode"] == "black" and offset.any()) or bitmap.get("gamma") == -1:
        return None
    if "filename" in bitmap and is_missing(bitmap["filename"]):
        return bitmap
    found = pixels(bitmap)
    if grey:
        found = found.mean(axis=2, keepdims=True)
    data = (found * factor + offset).clip(min=0).astype(np.float32)
    kept = {key: bitmap[key] for key in bitmap if key not in ("filename", "gamma")}
    return kept | {"data": data, "raw": True}


def pixels(bitmap: dict[str, Any]) -> np.ndarray:
    """In linear light, without alpha."""
    import numpy as np

    if "data" in bitmap:
        return np.asarray(bitmap["data"])
    path = Path(bitmap["filename"])
    linear = read_rgb(path)
    gamma = 1.0 if "raw" in bitmap else bitmap.get("gamma")
    if gamma is None or path.suffix.lower() not in BYTES:
        return linear
    return encode_srgb(linear) ** gamma
