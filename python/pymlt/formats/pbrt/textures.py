"""Textures of pbrt-v4, by name. Its images have row 0 at v = 1, ours at v = 0."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..limits import measured
from .arithmetic import Value, mixed, mixture, multiplied, product
from .images import BYTES
from .params import Params

WRAP = {"repeat": "repeat", "black": "black", "clamp": "clamp", "octahedralsphere": "clamp"}


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
        image = multiplied(bitmap | self._encoding(params), params.number("scale", 1.0))
        return mixture(1.0, 0.0, image) if params.flag("invert") else image

    def _encoding(self, params: Params) -> dict[str, Any]:
        """How bytes of an image are stored; other numbers are linear."""
        encoding = params.text("encoding", "")
        if not params.text("filename").lower().endswith(BYTES):
            return {}
        if encoding.startswith("gamma"):
            return {"gamma": float(encoding.split()[1])}
        return {"raw": True} if encoding == "linear" else {}

    def _make_scale(self, params: Params) -> Value:
        inner, factor = (self.colour(params, name, 1.0) for name in self.factors)
        return product(inner, factor)

    def _make_mix(self, params: Params) -> Value:
        ends = (self.colour(params, f"tex{i + 1}", float(i)) for i in range(2))
        return mixed(*ends, self.number(params, "amount", 0.5))

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
