"""Sums and products of colours and textures of pbrt, as scene dicts can have them."""

from __future__ import annotations

from typing import Any

from ..imported import rgb
from .images import grey
from .spectra import numbers, scaled

Value = float | dict[str, Any]


def is_even(value: Value) -> bool:
    """Whether it is the same everywhere."""
    return not isinstance(value, dict) or value["type"] in ("rgb", "spectrum")


def product(inner: Value, factor: Value) -> Value:
    """Of two colours or textures."""
    if not is_even(factor):
        inner, factor = factor, inner
    return multiplied(inner, factor) if is_even(factor) else mixture(0.0, inner, factor)


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


def mixed(first: Value, second: Value, amount: Value) -> Value:
    """(1 - amount) first + amount second. An amount is a number, the mean of its colours."""
    import numpy as np

    if not (is_even(first) and is_even(second) and is_even(amount)):
        return mixture(first, second, greyed(amount))
    start, end, share = (np.array(numbers(value)) for value in (first, second, amount))
    colour = (1 - share) * start + share * end
    return float(colour[0]) if np.ptp(colour) == 0 else rgb(colour)


def mixture(first: Value, second: Value, amount: Value) -> Value:
    """The texture that mixes channel by channel."""
    return {"type": "mix", "first": first, "second": second, "amount": amount}


def greyed(value: Any) -> Any:
    """A texture whose images have their means in the place of colours."""
    if not isinstance(value, dict):
        return value
    if value["type"] == "bitmap":
        return grey(value)
    return {key: greyed(part) for key, part in value.items()}
