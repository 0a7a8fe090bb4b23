"""Tone curves: from radiance, which has no upper end, to the light of a display, which has."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Literal, TypeAlias

from .. import _core
from .agx import agx
from .ocio import ACES2, PREFIX, codes, view_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

MAX_EXPOSURE = 128  #: stops, as for PNG files in C++
Exposure: TypeAlias = float | Literal["auto"]


def tonemap(
    image: ArrayLike, curve: str = "filmic", *, exposure: Exposure = 0
) -> NDArray[np.float32]:
    """The light of a display that shows an image: linear, each sample from 0 to 1.

    image
        linear radiance of shape (height, width) or (height, width, channels); a second or fourth
        channel is alpha and stays. NaN becomes 0.
    curve
        "srgb" clips at 1. "reinhard" is L / (1 + L) of the luminance L, which keeps hue and
        saturation of what is not clipped (Reinhard et al. 2002, Photographic Tone Reproduction for
        Digital Images, eq. 3). "filmic" is an S-shaped curve for each channel, which turns bright
        colours white: the fit by Narkowicz (2016, ACES Filmic Tone Mapping Curve) to the reference
        transform of the Academy Color Encoding System. It shows 0.18 as 0.27, 1 as 0.80. "agx" is
        that of Blender (Sobotka 2023, AgX), "aces2" that of ACES 2.0 for SDR, whose code
        OpenImageIO has: both desaturate what is bright, and show 0.18 as 0.18 and 0.10.
        "ocio:DISPLAY/VIEW@FILE" is any view of an OpenColorIO configuration; without DISPLAY/ that
        of the default one, without @FILE that of $OCIO or of OpenColorIO's own for ACES.
    exposure
        stops by which the image is brightened before; -128 to 128. "auto" is what suits the image:
        19 of 20 pixels are darker than 0.8 then.

    Returns float32 of the same shape; `write_image(path, tonemap(image))` encodes it. Raises
    UsageError for an unknown curve or view, another shape, or an exposure out of range.
    """
    import numpy as np

    check_tonemap(curve)
    pixels = np.asarray(image, dtype=np.float64)
    light, alpha = split_alpha(with_channels(pixels))
    largest = float(np.finfo(np.float32).max)
    light = light * 2.0 ** stops_of(exposure, pixels)
    light = np.nan_to_num(light, nan=0, posinf=largest).clip(0, largest)
    shown = np.concatenate([_curve(curve)(light).clip(0, 1), alpha], axis=2)
    return shown.reshape(pixels.shape).astype(np.float32)


def stops_of(exposure: Exposure, image: ArrayLike) -> float:
    """The number that an exposure means for this linear image. Raises UsageError for others."""
    if exposure == "auto":
        return _core.fitting_exposure(image)
    if isinstance(exposure, str | None) or not abs(exposure) <= MAX_EXPOSURE:
        raise _core.UsageError(
            f"exposure is {exposure!r}, but should lie between -128 and 128, or be 'auto'"
        )
    return exposure


def check_tonemap(curve: str) -> str:
    """The name of a curve. Raises UsageError if there is none of that name."""
    _curve(curve)
    return curve


def _curve(name: str) -> Callable[[np.ndarray], np.ndarray]:
    name = VIEWS.get(name, name)
    if name.startswith(PREFIX):
        view = view_of(name)
        return _of_colours(lambda light: decode_srgb(codes(light, view)))
    if name not in FORMULAS:
        meant = _core.suggestion(name, [*CURVES, ANY_VIEW])
        raise _core.UsageError(f"unknown tone curve {name!r}{meant}")
    return FORMULAS[name]


def with_channels(pixels: np.ndarray) -> np.ndarray:
    """An image of shape (height, width, channels). Raises UsageError for what is none."""
    if pixels.ndim not in (2, 3):
        raise _core.UsageError(
            "an image should have the shape (height, width, channels) or (height, width)"
        )
    return pixels if pixels.ndim == 3 else pixels[..., None]


def split_alpha(pixels: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The colours, and alpha (with no channels if there is none), of (height, width, channels)."""
    colours = pixels.shape[2] - (pixels.shape[2] in (2, 4))
    return pixels[..., :colours], pixels[..., colours:]


def straight(image: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """Colours that are multiplied by alpha, divided by it (black where it is 0), and alpha."""
    import numpy as np

    colours = np.divide(image, alpha, out=np.zeros_like(image), where=alpha > 0)
    return np.concatenate([colours, alpha], axis=2)


def encode_srgb(linear: np.ndarray) -> np.ndarray:
    """IEC 61966-2-1, from 0 to 1."""
    import numpy as np

    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def decode_srgb(encoded: np.ndarray) -> np.ndarray:
    """The inverse of `encode_srgb`."""
    import numpy as np

    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def _srgb(light: np.ndarray) -> np.ndarray:
    return light


def _reinhard(light: np.ndarray) -> np.ndarray:
    """Luminance: Rec. 709."""
    import numpy as np

    weights = np.array([0.2126, 0.7152, 0.0722] if light.shape[2] == 3 else [1.0])
    shown: np.ndarray = light / (1 + (light @ weights)[..., None])
    return shown


def _filmic(light: np.ndarray) -> np.ndarray:
    x = light.clip(0, 1e6)  # whose square is finite; the curve is flat long before
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)


def _of_colours(curve: Callable[[np.ndarray], np.ndarray]) -> Callable[[np.ndarray], np.ndarray]:
    """A curve of three channels, for grey images too."""

    def shown(light: np.ndarray) -> np.ndarray:
        channels = light.shape[2]
        return curve(light.repeat(3 // channels, axis=2))[..., :channels]

    return shown


FORMULAS = {"srgb": _srgb, "reinhard": _reinhard, "filmic": _filmic, "agx": _of_colours(agx)}
VIEWS = {"aces2": ACES2}
CURVES = (*FORMULAS, *VIEWS)
ANY_VIEW = f"{PREFIX}DISPLAY/VIEW@FILE"
