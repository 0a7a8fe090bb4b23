"""Textures of pbrt-v4, by name. Its images have row 0 at v = 1, ours at v = 0."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..imported import rgb
from ..limits import measured
from .params import Params
from .spectra import scaled

WRAP = {"repeat": "repeat", "black": "black", "clamp": "clamp", "octahedralsphere": "clamp"}
Value = float | dict[str, Any]


class Textures:
    """What has been declared, and what parameters refer to."""

    factors = ("tex", "scale")  #: of the texture "scale"

    def __init__(self, folder: Path):
        self._folder = folder
        self._known: dict[tuple[str, bool], Value] = {}  #: by name, and whether of numbers

    def declare(self, name: str, kind: str, params: Params) -> None:
        """Texture "name" "spectrum" "imagemap" ..."""
        key = (name, kind == "float")
        make = getattr(self, f"_make_{params.type}", None)
        if make is None:
            params.warn(f"the texture {params.type!r} has no counterpart; it becomes 0.5")
            self._known[key] = 0.5
            return
        value: Value = make(params)
        params.finish(ignored=("mapping", "filter", "maxanisotropy"))
        if isinstance(value, dict):
            measured(value)
        self._known[key] = value

    def colour(self, params: Params, name: str, default: float) -> Value:
        """A colour, a spectrum or a texture, for a scene dict."""
        given = params.get(name)
        if given is not None and given.kind == "texture":
            return self._find(given.values[0], False, params)
        value: Value = params.colour(name, default)
        return value

    def number(self, params: Params, name: str, default: Value) -> Value:
        """A number or a texture."""
        given = params.get(name)
        if given is not None and given.kind == "texture":
            return self._find(given.values[0], True, params)
        return default if given is None else float(given.values[0])

    def bitmap(self, filename: str) -> dict[str, Any]:
        """An image of a file."""
        path = str((self._folder / filename).resolve())
        return {"type": "bitmap", "filename": path, "vscale": -1.0, "voffset": 1.0}

    def _find(self, name: str, of_numbers: bool, params: Params) -> Value:
        """One of the same name that is not of what is looked for serves, too."""
        for key in ((name, of_numbers), (name, not of_numbers)):
            if key in self._known:
                return self._known[key]
        raise params.where.error(f"there is no texture {name!r} above this line")

    def _make_constant(self, params: Params) -> Value:
        value: Value = params.colour("value", 1.0)
        return value

    def _make_imagemap(self, params: Params) -> Value:
        bitmap = self.bitmap(params.text("filename")) | placement(params, 1.0)
        bitmap["voffset"], bitmap["vscale"] = 1 - bitmap["voffset"], -bitmap["vscale"]
        bitmap["wrap_mode"] = WRAP.get(params.text("wrap", "repeat"), "repeat")
        if params.flag("invert"):
            params.warn("'invert' of image textures is left out")
        return multiplied(bitmap | self._encoding(params), params.number("scale", 1.0))

    def _encoding(self, params: Params) -> dict[str, Any]:
        """How the values of an image are stored; by its format if nothing is said."""
        encoding = params.text("encoding", "")
        if encoding.startswith("gamma"):
            return {"gamma": float(encoding.split()[1])}
        return {"raw": True} if encoding == "linear" else {}

    def _make_scale(self, params: Params) -> Value:
        inner, factor = (self.colour(params, name, 1.0) for name in self.factors)
        return product(inner, factor, params)

    def _make_checkerboard(self, params: Params) -> Value:
        """A period of two squares, where ours has one."""
        if params.number("dimension", 2) != 2:
            params.warn("checkerboards in space are left out; they follow u and v")
        colours = {f"color{i}": self.colour(params, f"tex{i + 1}", 1.0 - i) for i in range(2)}
        return {"type": "checkerboard"} | colours | placement(params, 0.5)


def placement(params: Params, factor: float) -> dict[str, float]:
    """uscale, vscale, udelta and vdelta of the mapping "uv"."""
    if params.text("mapping", "uv") != "uv":
        params.warn(f"the mapping {params.text('mapping')!r} is left out")
    return {
        "uscale": factor * params.number("uscale", 1),
        "vscale": factor * params.number("vscale", 1),
        "uoffset": factor * params.number("udelta", 0),
        "voffset": factor * params.number("vdelta", 0),
    }


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


def is_even(value: Value) -> bool:
    """Whether it is the same everywhere."""
    return not isinstance(value, dict) or value["type"] in ("rgb", "spectrum")


def _scale_texture(inner: Value, factor: Value) -> Value:
    return inner if factor == 1 else {"type": "scale", "scale": factor, "texture": inner}
