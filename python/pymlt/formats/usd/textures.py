"""The inputs of materials as numbers, colours and textures."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..imported import Imported, rgb
from .images import Image, image
from .networks import Node

VERTEX_COLOURS = {"type": "mesh_attribute", "name": "vertex_color"}


class Textures:
    """The inputs of one material."""

    def __init__(self, node: Node, made: Imported):
        self.node = node
        self._made = made
        self.uv: str | None = None  #: the primvar that its textures use
        self.of_vertices = False  #: whether it uses the colours of vertices

    def value(self, name: str, default: Any) -> Any:
        """An input that cannot be a texture, which is warned of."""
        if self.node.source(name) is not None:
            self._made.warn(f"textures of {name!r} are left out")
        return self.node.value(name, default)

    def is_textured(self, name: str) -> bool:
        return self.node.source(name) is not None

    def is_given(self, name: str) -> bool:
        """Whether a file says anything of an input."""
        given = self.node.shader.GetInput(name)
        return bool(given) and (given.Get() is not None or self.is_textured(name))

    def number(self, name: str, default: float) -> float | dict[str, Any]:
        """A number from 0 to 1, or a texture of such numbers."""
        found = self._image(name)
        if found is None:
            return float(self.cut(name, self._fallback(name, default)))
        values = found.channel()
        return found.bitmap() if values is None else found.made_of(self.cut(name, values))

    def opacity(self, name: str, threshold: float) -> float | dict[str, Any]:
        """A number from 0 to 1, or a texture; with a threshold its values are 0 or 1."""
        found = self._image(name)
        values: Any = self._fallback(name, 1.0) if found is None else found.channel()
        if values is None:
            return 1.0
        values = values >= threshold if threshold > 0 else self.cut(name, values)
        return float(values) if found is None else found.made_of(values)

    def colour(self, name: str, default: Any, most: float = 1.0) -> dict[str, Any]:
        """A colour from 0 to `most`, a texture of colours, or the colours of vertices."""
        source = self.node.source(name)
        if source is not None and reads_colours(source):
            self.of_vertices = True
            return VERTEX_COLOURS
        found = self._image(name)
        if found is None:
            return rgb(self.cut(name, self._fallback(name, default, 3)[:3], most))
        if found.output != "rgb" or found.bias[:3].any() or (found.scale[:3] < 0).any():
            values = found.colours() if found.output == "rgb" else found.channel()
            cut = None if values is None else self.cut(name, values, most)
            return found.bitmap() if cut is None else found.made_of(cut)
        if (found.scale[:3] == 1).all():
            return found.bitmap()
        return {"type": "scale", "scale": rgb(found.scale[:3]), "texture": found.bitmap()}

    def cut(self, name: str, values: Any, most: float = 1.0) -> np.ndarray:
        """Values from 0 to `most`, with a warning if they were others."""
        given = np.asarray(values, dtype=float)
        found = given.clip(0, most)
        if (found != given).any():
            bounds = f"outside of 0 to {most:g}" if np.isfinite(most) else "below 0"
            self._made.warn(f"values of {name!r} {bounds} are cut off")
        return found

    def normals(self, name: str) -> dict[str, Any] | None:
        """A texture of normals, from 0 to 1, if there is one."""
        source = self.node.source(name)
        found = None if source is None or is_plain(source) else self._read(source)
        if source is None or found is None:
            return None
        found = found._replace(raw=True)
        if source.id != "UsdUVTexture":
            return found.bitmap()
        if (found.scale[:3] == 2).all() and (found.bias[:3] == -1).all():
            return found.bitmap()
        values = found.colours()
        return found.bitmap() if values is None else found.made_of((values + 1) / 2)

    def _image(self, name: str) -> Image | None:
        source = self.node.source(name)
        return None if source is None else self._read(source)

    def _read(self, source: Node) -> Image | None:
        found = image(source, self._made)
        if found is not None:
            self.take_uv(found.uv)
        return found

    def take_uv(self, primvar: str) -> None:
        """Notes the primvar that holds the texture coordinates, of which there is one."""
        if self.uv not in (None, primvar):
            self._made.warn("second texture coordinates of a material are left out")
        self.uv = self.uv or primvar

    def _fallback(self, name: str, default: Any, count: int = 1) -> Any:
        """The value of an input without an image: its own, or that of a texture without a file."""
        source = self.node.source(name)
        if source is None:
            return self.node.value(name, default)
        if source.id != "UsdUVTexture":
            return default
        given = source.numbers("fallback", [0, 0, 0, 1])
        scale, bias = source.numbers("scale", [1] * 4), source.numbers("bias", [0] * 4)
        values = np.array(given) * scale + bias
        channel = {"r": 0, "g": 1, "b": 2, "a": 3}.get(source.output)
        if count == 3:
            return values[:3] if channel is None else np.full(3, values[channel])
        return values[:3].mean() if channel is None else values[channel]


def reads_colours(node: Node) -> bool:
    """Whether a shader gives the colours that a mesh has itself."""
    is_reader = node.id.startswith("UsdPrimvarReader_float3")
    return is_reader and node.value("varname", "") == "displayColor"


def is_plain(node: Node) -> bool:
    """Whether normals are those of the mesh itself."""
    while node.id.startswith("ND_normalize") and (source := node.source("in")):
        node = source
    return node.id.startswith("ND_normal_")
