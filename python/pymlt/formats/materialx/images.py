"""Images that nodes look up, as arrays."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ... import _core
from ...images import read_image
from ...pictures.tonemapping import encode_srgb, split_alpha
from ..limits import check_pixels
from ..missing import ABSENT, is_missing
from .colour_spaces import canonical
from .scope import File

FLOATS = (".exr", ".hdr")  #: formats of linear light; what others hold is encoded
WRAPS = {"periodic": "repeat", "clamp": "clamp", "mirror": "mirror", "constant": "zero"}
#: Converts colours of a space, which a place names.
Linear = Callable[[np.ndarray, str, str], np.ndarray]


@dataclass(frozen=True)
class Lookup:
    """A file as an image node reads it."""

    file: File
    kind: str  #: the type of its values
    wrap_u: str  #: the name of MaterialX for what is outside of the image
    wrap_v: str
    filtering: str

    @property
    def is_encoded(self) -> bool:
        """Whether the file holds colours that are encoded as sRGB."""
        return self.file.path.suffix.lower() not in FLOATS

    @property
    def decoding(self) -> str | None:
        """How a `bitmap` reads the file's colours: "" or "raw"; None if it cannot."""
        space = canonical(self.file.space)
        if not self.is_encoded:
            return None if space else ""
        return {"": "raw", "srgb_texture": ""}.get(space)

    def sampled(self, pixels: np.ndarray, uv: np.ndarray, default: np.ndarray) -> np.ndarray:
        """At coordinates (height, width, 2), where v points up and 1 is the top of the image."""
        height, width = pixels.shape[:2]
        x, y = uv[..., 0] * width, (1 - uv[..., 1]) * height
        if self.filtering == "closest":
            found = self._texels(pixels, np.floor(x), np.floor(y))
        else:
            left, top = np.floor(x - 0.5), np.floor(y - 0.5)
            a, b = (x - 0.5 - left)[..., None], (y - 0.5 - top)[..., None]
            row, below = (
                (1 - a) * self._texels(pixels, left, line)
                + a * self._texels(pixels, left + 1, line)
                for line in (top, top + 1)
            )
            found = (1 - b) * row + b * below
        outside = np.zeros(uv.shape[:-1], bool)
        for mode, where in ((self.wrap_u, uv[..., 0]), (self.wrap_v, uv[..., 1])):
            if mode == "constant":
                outside |= (where < 0) | (where > 1)
        return np.where(outside[..., None], default, found) if outside.any() else found

    def _texels(self, pixels: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        height, width = pixels.shape[:2]
        return pixels[wrapped(y, height, self.wrap_v), wrapped(x, width, self.wrap_u)]


def wrapped(index: np.ndarray, count: int, mode: str) -> np.ndarray:
    """Indices of texels, inside of an image of so many."""
    i = index.astype(np.int64)
    if mode == "periodic":
        return i % count
    if mode == "mirror":
        i = i % (2 * count)
        return np.minimum(i, 2 * count - 1 - i)
    return i.clip(0, count - 1)


@dataclass
class Images:
    """The images of a document, each read once for a material, and those that are missing."""

    contents: Mapping[str, bytes] = field(default_factory=dict)  #: files in memory, by their paths
    missing: dict[str, str] = field(default_factory=dict)  #: and where they are named
    _read: dict[tuple[str, str, str], np.ndarray] = field(default_factory=dict)

    def pixels(self, lookup: Lookup, linear: Linear) -> np.ndarray | None:
        """As many channels as the type has, colours in linear Rec. 709; None for what is missing.

        Raises FileError for what is no image.
        """
        file = lookup.file
        content = self.contents.get(str(file.path))
        if content is None and is_missing(file.path):
            self.missing.setdefault(f"{file.path}: {ABSENT}", file.place)
            return None
        key = key_of(lookup)
        if key not in self._read:
            self._read[key] = channels_of(lookup, linear, content).astype(np.float32)
        return self._read[key]

    def source(self, file: File) -> dict[str, Any]:
        """The parameter of a `bitmap` that shows a file."""
        content = self.contents.get(str(file.path))
        return {"filename": str(file.path)} if content is None else {"data": content}

    def forget(self) -> None:
        """Frees the pixels; images are read again where they are needed again."""
        self._read.clear()

    def size(self, lookup: Lookup) -> tuple[int, int]:
        """The width and height of an image that has been looked up; 1 of a missing one."""
        found = self._read.get(key_of(lookup))
        return (1, 1) if found is None else (found.shape[1], found.shape[0])


def key_of(lookup: Lookup) -> tuple[str, str, str]:
    """What the pixels depend on."""
    return str(lookup.file.path), lookup.kind, lookup.file.space


def channels_of(lookup: Lookup, linear: Linear, content: bytes | None) -> np.ndarray:
    """The channels of a file that an image node has: one, two, three, or four with alpha."""
    path = lookup.file.path
    image = read_image(path) if content is None else _core.decode_image(content, str(path))
    colours, alpha = split_alpha(image)
    check_pixels(colours, str(lookup.file.path))
    space = canonical(lookup.file.space) if lookup.kind.startswith("color") else ""
    if lookup.kind.startswith("color") and colours.shape[2] == 1:
        colours = np.repeat(colours, 3, axis=2)
    if lookup.is_encoded and space != "srgb_texture":
        colours = encode_srgb(colours)
    if space and not (lookup.is_encoded and space == "srgb_texture"):
        colours = linear(colours, space, lookup.file.place)
    if not alpha.size:
        alpha = np.ones((*colours.shape[:2], 1))
    match lookup.kind:
        case "float":
            return colours[..., :1]
        case "vector2":
            return np.concatenate([colours, alpha], axis=2)[..., :2]
        case "color4" | "vector4":
            colours = np.broadcast_to(colours, (*colours.shape[:2], 3))
            return np.concatenate([colours, alpha[..., :1]], axis=2)
    return np.broadcast_to(colours, (*colours.shape[:2], 3))
