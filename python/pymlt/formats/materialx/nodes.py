"""The nodes of MaterialX that are arithmetic, on arrays (height, width, channels).

Nodes that the standard library makes of these need nothing here: place2d, tiledimage, checkerboard.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .hsv import hsv_to_rgb, rgb_to_hsv
from .noise import cells, fractal, perlin

Inputs = Callable[[str], Any]  #: the value of an input by its name
Node = Callable[[Inputs], Any]
OCTAVES = 32  #: of fractal noise; finer ones are lost in texels


def of(function: Callable[..., Any], *names: str) -> Node:
    """A function of the values of these inputs."""
    return lambda given: function(*map(given, names))


def mixed(background: Any, foreground: Any, amount: Any) -> Any:
    return (1 - amount) * background + amount * foreground


def blended(function: Callable[[Any, Any], Any]) -> Node:
    """A foreground over a background, as much of it as `mix` says."""
    return lambda given: mixed(given("bg"), function(given("bg"), given("fg")), given("mix"))


def compared(relation: Callable[[Any, Any], Any]) -> Node:
    """One input or another, as two values compare; where these are constants, it alone is used."""

    def chosen(given: Inputs) -> Any:
        condition = relation(given("value1"), given("value2"))
        if condition.size == 1:
            return given("in1" if condition.item() else "in2")
        return np.where(condition, given("in1"), given("in2"))

    return chosen


def ramp(axis: int, start: str, end: str) -> Node:
    """From the value at coordinate 0 to that at coordinate 1."""
    return lambda given: mixed(given(start), given(end), along(given, axis).clip(0, 1))


def split(axis: int, start: str, end: str) -> Node:
    """One value below the centre, another one above."""
    return lambda given: np.where(along(given, axis) >= given("center"), given(end), given(start))


def along(given: Inputs, axis: int) -> Any:
    return given("texcoord")[..., axis : axis + 1]


def remapped(x: Any, low: Any, high: Any, new_low: Any, new_high: Any) -> Any:
    return new_low + (x - low) * (new_high - new_low) / (high - low)


def smooth(x: Any, low: Any, high: Any) -> Any:
    with np.errstate(all="ignore"):
        t = np.where(x >= high, 1.0, np.where(x <= low, 0.0, (x - low) / (high - low)))
    return t * t * (3 - 2 * t)


def dot_product(a: Any, b: Any) -> Any:
    return (a * b).sum(axis=-1, keepdims=True)


def magnitude(x: Any) -> Any:
    return np.sqrt(dot_product(x, x))


def rotated(x: Any, degrees: Any) -> Any:
    """Clockwise where v points up, as in the library."""
    angle = np.radians(degrees)
    s, c = np.sin(angle)[..., 0], np.cos(angle)[..., 0]
    u, v = x[..., 0], x[..., 1]
    return np.stack([c * u + s * v, c * v - s * u], axis=-1)


def transformed(x: Any, matrix: Any) -> Any:
    """A row vector times a matrix (9 numbers)."""
    return np.einsum("...i,...ij->...j", x, matrix.reshape(*matrix.shape[:-1], 3, 3))


def extracted(x: Any, index: Any) -> Any:
    i = int(index.flat[0])
    if not 0 <= i < x.shape[-1]:
        raise ValueError(f"channel {i} is not among the {x.shape[-1]} of a value")
    return x[..., i : i + 1]


def joined(count: int) -> Node:
    names = [f"in{i + 1}" for i in range(count)]

    def combine(given: Inputs) -> np.ndarray:
        parts = [given(name) for name in names]
        shape = np.broadcast_shapes(*(part.shape[:-1] for part in parts))
        full = [np.broadcast_to(part, (*shape, part.shape[-1])) for part in parts]
        return np.concatenate(full, axis=-1)

    return combine


def noisy(given: Inputs) -> Any:
    amplitude = given("amplitude")
    return amplitude * perlin(given("texcoord"), amplitude.shape[-1]) + given("pivot")


def fractally_noisy(given: Inputs) -> Any:
    amplitude, octaves = given("amplitude"), int(given("octaves").item())
    if octaves > OCTAVES:
        raise ValueError(f"fractal noise has {octaves} octaves, but at most {OCTAVES} are possible")
    each = [given(name).item() for name in ("lacunarity", "diminish")]
    return amplitude * fractal(given("texcoord"), amplitude.shape[-1], octaves, *each)


def premultiplied(x: Any) -> Any:
    return np.concatenate([x[..., :3] * x[..., 3:], x[..., 3:]], axis=-1)


UNARY: dict[str, Callable[[Any], Any]] = {
    "absval": np.abs,
    "acos": np.arccos,
    "asin": np.arcsin,
    "ceil": np.ceil,
    "cos": np.cos,
    "dot": lambda x: x,
    "exp": np.exp,
    "floor": np.floor,
    "fract": lambda x: x - np.floor(x),
    "hsvtorgb": hsv_to_rgb,
    "ln": np.log,
    "magnitude": magnitude,
    "normalize": lambda x: x / magnitude(x),
    "not": lambda x: 1.0 - x,
    "premult": premultiplied,
    "rgbtohsv": rgb_to_hsv,
    "round": lambda x: np.floor(x + 0.5),
    "sign": np.sign,
    "sin": np.sin,
    "sqrt": np.sqrt,
    "tan": np.tan,
}
BINARY: dict[str, Callable[[Any, Any], Any]] = {
    "add": np.add,
    "and": np.minimum,
    "crossproduct": np.cross,
    "divide": np.divide,
    "dotproduct": dot_product,
    "max": np.maximum,
    "min": np.minimum,
    "modulo": lambda a, b: a - b * np.floor(a / b),
    "multiply": np.multiply,
    "or": np.maximum,
    "power": np.power,
    "subtract": np.subtract,
}
NODES: dict[str, Node] = {
    **{name: of(function, "in") for name, function in UNARY.items()},
    **{name: of(function, "in1", "in2") for name, function in BINARY.items()},
    **{f"combine{count}": joined(count) for count in (2, 3, 4)},
    "atan2": of(np.arctan2, "iny", "inx"),
    "cellnoise2d": of(cells, "texcoord"),
    "clamp": of(lambda x, low, high: np.minimum(np.maximum(x, low), high), "in", "low", "high"),
    "constant": of(lambda x: x, "value"),
    "difference": blended(lambda b, f: np.abs(b - f)),
    "extract": of(extracted, "in", "index"),
    "fractal2d": fractally_noisy,
    "ifequal": compared(np.equal),
    "ifgreater": compared(np.greater),
    "ifgreatereq": compared(np.greater_equal),
    "inside": of(np.multiply, "in", "mask"),
    "invert": of(np.subtract, "amount", "in"),
    "luminance": of(lambda x, weights: dot_product(x[..., :3], weights), "in", "lumacoeffs"),
    "minus": blended(np.subtract),
    "mix": of(mixed, "bg", "fg", "mix"),
    "noise2d": noisy,
    "outside": of(lambda x, mask: x * (1 - mask), "in", "mask"),
    "plus": blended(np.add),
    "ramplr": ramp(0, "valuel", "valuer"),
    "ramptb": ramp(1, "valueb", "valuet"),
    "remap": of(remapped, "in", "inlow", "inhigh", "outlow", "outhigh"),
    "rotate2d": of(rotated, "in", "amount"),
    "screen": blended(lambda b, f: 1 - (1 - f) * (1 - b)),
    "smoothstep": of(smooth, "in", "low", "high"),
    "splitlr": split(0, "valuel", "valuer"),
    "splittb": split(1, "valueb", "valuet"),
    "transformmatrix": of(transformed, "in", "mat"),
}
