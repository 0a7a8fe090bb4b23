"""Hue, saturation and value, each from 0 to 1, as MaterialX has them."""

from __future__ import annotations

import numpy as np


def rgb_to_hsv(rgb: np.ndarray) -> np.ndarray:
    """(..., 3) to (..., 3); what has no hue has the hue 0."""
    r, g, b = np.moveaxis(rgb, -1, 0)
    value = rgb.max(axis=-1)
    chroma = value - rgb.min(axis=-1)
    divisor = np.where(chroma > 0, chroma, 1)
    sextant = np.select(
        [chroma <= 0, r == value, g == value],
        [0.0, (g - b) / divisor, 2 + (b - r) / divisor],
        4 + (r - g) / divisor,
    )
    saturation = np.where(value > 0, chroma / np.where(value > 0, value, 1), 0)
    return np.stack([(sextant / 6) % 1.0, saturation, value], axis=-1)


def hsv_to_rgb(hsv: np.ndarray) -> np.ndarray:
    """(..., 3) to (..., 3); hues repeat with period 1."""
    hue, saturation, value = np.moveaxis(hsv, -1, 0)
    sectors = np.array([5.0, 3.0, 1.0])
    k = (sectors + 6 * hue[..., None]) % 6
    part = np.clip(np.minimum(k, 4 - k), 0, 1)
    rgb: np.ndarray = value[..., None] * (1 - saturation[..., None] * part)
    return rgb
