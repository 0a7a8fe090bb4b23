"""Sums and products of colours and textures of pbrt, as scene dicts can have them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..imported import rgb
from .images import changed
from .params import Params
from .spectra import numbers, scaled

if TYPE_CHECKING:
    import numpy as np

Value = float | dict[str, Any]


def is_even(value: Value) -> bool:
    """Whether it is the same everywhere."""
    return not isinstance(value, dict) or value["type"] in ("rgb", "spectrum")


def product(inner: Value, factor: Value, params: Params) -> Value:
    """Of two colours or textures of which at least one is the same everywhere."""
    if not is_even(factor):
        inner, factor = factor, inner
    if not is_even(factor):
        params.warn("a product of two textures is left out; the first is taken")
        return inner
    return multiplied(inner, factor)


def multiplied(inner: Value, factor: Value) -> Value:
    """A texture or a colour times a factor that is the same everywhere."""
    if isinstance(factor, float | int):
        return scaled(inner, factor) if is_even(inner) else _scale_texture(inner, factor)
    if not is_even(inner):
        return _scale_texture(inner, factor)
    if isinstance(inner, float | int):
        return scaled(factor, inner)
    if inner["type"] == factor["type"] == "rgb":
        return rgb([a * b for a, b in zip(inner["value"], factor["value"], strict=True)])
    if inner["type"] == "rgb":
        inner, factor = factor, inner
    waves, heights = zip(*inner["value"], strict=True)
    spectrum = {"type": "irregular", "wavelengths": list(waves), "values": list(heights)}
    return _scale_texture(spectrum, factor)


def _scale_texture(inner: Value, factor: Value) -> Value:
    return inner if factor == 1 else {"type": "scale", "scale": factor, "texture": inner}


def mixed(first: Value, second: Value, amount: Value, params: Params) -> Value:
    """(1 - amount) first + amount second, where at most one of the three is no constant."""
    import numpy as np

    found = None
    if is_even(amount):
        share = np.array(numbers(amount))
        if is_even(second):
            found = affine(first, 1 - share, share * numbers(second))
        elif is_even(first):
            found = affine(second, share, (1 - share) * numbers(first))
    elif is_even(first) and is_even(second):
        start, end = np.array(numbers(first)), np.array(numbers(second))
        found = affine(amount, end - start, start, grey=True)
    if found is None:
        params.warn("a mix of textures is left out; that of the larger share is taken")
        return first if isinstance(amount, dict) or amount < 0.5 else second
    return found


def affine(
    value: Value, factor: np.ndarray, offset: np.ndarray, grey: bool = False
) -> Value | None:
    """A texture or a colour, or its mean if it is to be grey, times red, green and blue of a
    factor, plus those of an offset; None for textures of which that is none."""
    import numpy as np

    if not isinstance(value, dict) or is_even(value):
        colour = factor * numbers(value) + offset
        return float(colour[0]) if np.ptp(colour) == 0 else rgb(colour)
    match value["type"]:
        case "checkerboard":
            fields = {key: affine(value[key], factor, offset, grey) for key in ("color0", "color1")}
            return None if None in fields.values() else value | fields
        case "scale" if is_even(value["scale"]):
            return affine(value["texture"], factor * numbers(value["scale"]), offset, grey)
        case "bitmap":
            return changed(value, factor, offset, grey)
    return None
