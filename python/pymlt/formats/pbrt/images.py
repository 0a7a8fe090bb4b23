"""Images of which the pixels are read."""

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


def grey(bitmap: dict[str, Any]) -> dict[str, Any]:
    """A bitmap of the means of an image's colours.

    A missing image, and one that decodes what is not of bytes, stays as it is.
    """
    import numpy as np

    if bitmap.get("gamma") == -1 or is_missing(bitmap["filename"]):
        return bitmap
    data = pixels(bitmap).mean(axis=2, keepdims=True).astype(np.float32)
    kept = {key: bitmap[key] for key in bitmap if key not in ("filename", "gamma")}
    return kept | {"data": data, "raw": True}


def pixels(bitmap: dict[str, Any]) -> np.ndarray:
    """Those of an image file in linear light, without alpha."""
    path = Path(bitmap["filename"])
    linear = read_rgb(path)
    gamma = 1.0 if "raw" in bitmap else bitmap.get("gamma")
    if gamma is None or path.suffix.lower() not in BYTES:
        return linear
    encoded: np.ndarray = encode_srgb(linear) ** gamma
    return encoded
