"""The images of a race as pictures: brightened, cut, encoded."""

from __future__ import annotations

import base64
from importlib.util import find_spec
from typing import TYPE_CHECKING

import numpy as np

from ... import _core
from ...diagnostics.metrics import flip_map, relative_error
from ...pictures.notebook import png
from ...pictures.tonemapping import tonemap

if TYPE_CHECKING:
    from ..result import Entry, Outcome

WIDEST = 800  #: pixels of a picture in a page
# matplotlib's colours "magma", which FLIP is drawn in, at nine places from 0 to 1.
MAGMA = [
    (0.001, 0.000, 0.014), (0.113, 0.065, 0.277), (0.317, 0.072, 0.485), (0.513, 0.148, 0.508),
    (0.716, 0.215, 0.475), (0.904, 0.320, 0.388), (0.987, 0.536, 0.382), (0.997, 0.767, 0.504),
    (0.987, 0.991, 0.750),
]  # fmt: skip


def error_map(result: Outcome, entry: Entry) -> np.ndarray:
    """FLIP of the shown image, else its relative error: (height, width), 0 to 1."""
    image = np.asarray(entry.image, dtype=np.float64)
    if shows_flip(result):
        return flip_map(image, result.scale)[0].clip(0, 1)
    return relative_error(image, result.scale).clip(0, 1)


def shows_flip(result: Outcome) -> bool:
    """Whether `error_map` is FLIP: there is a reference, and flip-evaluator."""
    return result.reference_error is not None and bool(find_spec("flip_evaluator"))


def coloured(values: np.ndarray) -> np.ndarray:
    """Numbers from 0 to 1 in the colours of magma, sRGB: (height, width, 3)."""
    places = np.linspace(0, 1, len(MAGMA))
    return np.stack([np.interp(values, places, column) for column in np.transpose(MAGMA)], axis=2)


def smaller(image: np.ndarray) -> np.ndarray:
    """Means over squares of pixels, so that it is no wider than a page shows it."""
    factor = -(-image.shape[1] // WIDEST)
    height, width = (max(1, side // factor) for side in image.shape[:2])
    if factor == 1 or min(image.shape[:2]) < factor:
        return image
    cut = image[: height * factor, : width * factor]
    means: np.ndarray = cut.reshape(height, factor, width, factor, -1).mean(axis=(1, 3))
    return means


def photograph(image: np.ndarray, curve: str, exposure: float) -> str:
    """A linear image as the address of a JPEG that it contains."""
    return _address(_core.encode_jpeg(tonemap(smaller(image), curve, exposure=exposure)), "jpeg")


def exact(image: np.ndarray, curve: str, exposure: float) -> str:
    """A linear image as the address of a PNG that it contains."""
    return _address(png(tonemap(image, curve, exposure=exposure)), "png")


def drawing(values: np.ndarray) -> str:
    """A map from 0 to 1 as the address of a JPEG that it contains."""
    encoded = coloured(smaller(values[..., None])[..., 0])
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    return _address(_core.encode_jpeg(linear), "jpeg")


def _address(content: bytes, kind: str) -> str:
    return f"data:image/{kind};base64,{base64.b64encode(content).decode()}"
