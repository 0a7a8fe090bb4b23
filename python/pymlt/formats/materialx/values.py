"""Values by the types of MaterialX: numbers are arrays (height, width, channels)."""

from __future__ import annotations

from typing import Any

import numpy as np

from ... import _core
from .scope import File

#: Channels of the types that are numbers.
COUNTS = {"color3": 3, "color4": 4, "vector2": 2, "vector3": 3, "vector4": 4, "matrix33": 9}
COUNTS |= {"float": 1, "integer": 1, "boolean": 1, "matrix44": 16}


def path_of(element: Any) -> str:
    return element.getNamePath()


def checked(value: Any, kind: str, port: Any) -> Any:
    """A value of a type. Raises SceneError for a text in place of a number, or another count."""
    if kind == "filename":
        fits = isinstance(value, File)
    elif kind in COUNTS:
        fits = isinstance(value, np.ndarray) and value.shape[-1] in (1, COUNTS[kind])
    else:
        fits = isinstance(value, str)
    if not fits:
        raise _core.SceneError(f"{path_of(port)}: its value is not of the type {kind!r}")
    return value


def full(values: np.ndarray, kind: str) -> np.ndarray:
    """One number for all channels of a type, or fewer channels of what has more."""
    count = COUNTS[kind]
    if values.shape[-1] > count:
        return values[..., :count]
    return np.broadcast_to(values, (*values.shape[:-1], count))


def numbers(text: str, count: int, port: Any) -> list[float]:
    """The numbers of a constant; none are zeros, as in MaterialX."""
    words = {"true": "1", "false": "0", "": "0"}
    try:
        values = [float(words.get(word.strip(), word)) for word in text.split(",")]
    except ValueError:
        values = []
    if len(values) not in (1, count) or not np.isfinite(values).all():
        expected = "a number" if count == 1 else f"{count} numbers"
        raise _core.SceneError(f"{path_of(port)}: is {text!r:.80}, but should be {expected}")
    return values * (count // len(values))
