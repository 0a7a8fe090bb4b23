"""Linear images as 8-bit pictures, quickly enough to be made while a render runs."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, NamedTuple

from ..pictures.tonemapping import encode_srgb, tonemap

if TYPE_CHECKING:
    import numpy as np

IMAGE, ERROR = "image", "error map"
AOVS = ("albedo", "sh_normal", "geo_normal", "depth", "position", "uv", "shape_index", "prim_index")
AOVS += ("optical_depth",)
LAYERS = (IMAGE, ERROR, *AOVS)


class Look(NamedTuple):
    """How a render is shown."""

    layer: str = IMAGE
    exposure: float = 0.0
    curve: str = "srgb"
    denoise: bool = False
    lamps: dict[str, tuple[float, float, float]] | None = None  #: factors of their light


@functools.lru_cache(maxsize=4)
def _codes(curve: str) -> np.ndarray:
    """The 8-bit code of every half-precision number, by its bits."""
    import numpy as np

    values = np.arange(1 << 16, dtype=np.uint16).view(np.float16).astype(np.float32)
    values = np.nan_to_num(values, nan=0, posinf=65504, neginf=0)
    shown = tonemap(values[None], curve)[0]
    return np.floor(255 * encode_srgb(shown) + 0.5).astype(np.uint8)


def picture(image: np.ndarray, exposure: float, curve: str) -> np.ndarray:
    """What `tonemap` and PNG make of an image, to a code or so."""
    import numpy as np

    light = np.asarray(image, dtype=np.float32) * np.float32(2.0**exposure)
    if curve not in ("srgb", "filmic"):  # others look at all channels of a pixel; then sRGB is left
        light, curve = tonemap(light, curve), "srgb"
    with np.errstate(over="ignore", invalid="ignore"):
        bits = light.astype(np.float16).view(np.uint16)
    return _codes(curve)[bits]


def heat(values: np.ndarray) -> np.ndarray:
    """Numbers from 0 to 1 as colours from black by violet and orange to white."""
    import numpy as np

    stops = np.linspace(0, 1, 6)
    colours = [
        (0, 0, 4),
        (66, 10, 104),
        (147, 38, 103),
        (221, 81, 58),
        (252, 165, 10),
        (252, 255, 220),
    ]
    values = np.nan_to_num(values).clip(0, 1)
    channels = [np.interp(values, stops, column) for column in zip(*colours, strict=True)]
    return np.stack(channels, axis=-1).astype(np.uint8)


def error_picture(image: np.ndarray, error: np.ndarray) -> np.ndarray:
    """The standard error of each pixel in its brightness: black 0, white 100 % and more."""
    brightness = image.mean(axis=2)
    floor = max(1e-3 * float(brightness.mean()), 1e-12)
    return heat(error.mean(axis=2) / (abs(brightness) + floor))


def layer_picture(layer: str, values: np.ndarray) -> np.ndarray:
    """A layer of what the camera sees first."""
    import numpy as np

    if layer == "optical_depth":
        return picture(1 - np.exp(-values), 0, "srgb")
    values = np.nan_to_num(np.asarray(values, dtype=np.float64), posinf=0, neginf=0)
    if layer == "albedo":
        return picture(values, 0, "srgb")
    if layer.endswith("normal"):
        return (127.5 * (values + 1)).clip(0, 255).astype(np.uint8)
    if layer.endswith("index"):
        return _hashed(values[..., 0].astype(np.int64))
    if layer == "uv":
        return (255 * np.mod(values, 1)).astype(np.uint8)
    low, high = values.min(axis=(0, 1)), values.max(axis=(0, 1))
    scaled = (values - low) / np.where(high > low, high - low, 1)
    return heat(1 - scaled[..., 0]) if scaled.shape[2] == 1 else (255 * scaled).astype(np.uint8)


def _hashed(index: np.ndarray) -> np.ndarray:
    """A colour for each number; black for -1."""
    import numpy as np

    mixed = (index[..., None] + 1) * np.array([2654435761, 2246822519, 3266489917])
    colours = ((mixed >> 13) & 127) + 96
    return np.where(index[..., None] < 0, 0, colours).astype(np.uint8)


def enlarged(small: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """A picture of fewer pixels in a size (width, height)."""
    import numpy as np

    height, width = small.shape[:2]
    rows = np.arange(size[1]) * height // size[1]
    columns = np.arange(size[0]) * width // size[0]
    return small[rows[:, None], columns]


def marked(picture: np.ndarray, pixel: tuple[int, int], scale: float) -> np.ndarray:
    """A picture with a cross around one of its pixels (x, y), which itself stays free.

    scale: pixels of the picture in one of the screen, on which the cross has about 70.
    """
    (x, y), line, near = pixel, max(1, round(scale)), max(3, round(8 * scale))
    far = max(near + 3, round(34 * scale))
    seen = picture.copy()
    for edge, colour in ((line, 0), (0, 255)):  # white with a black border

        def part(at: int, low: int, high: int, edge: int = edge) -> slice:
            return slice(max(0, at + low - edge), max(0, at + high + edge))

        for low, high in ((-far, -near), (near + 1, far + 1)):
            seen[part(y, 0, line), part(x, low, high)] = colour
            seen[part(y, low, high), part(x, 0, line)] = colour
    return seen


def split(left: np.ndarray, right: np.ndarray, share: float) -> np.ndarray:
    """Two pictures side by side: the left one up to a share of the width."""
    column = round(share * left.shape[1])
    both = left.copy()
    both[:, column:] = right[:, column:]
    both[:, max(column - 1, 0) : column + 1] = 255
    return both
