"""Shaders that read images: UsdUVTexture, and `image` and `tiledimage` of MaterialX."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ...pictures.tonemapping import encode_srgb, split_alpha
from ..imported import Imported
from .assets import asset, is_encoded, pixels
from .coordinates import OVER, to_uv
from .networks import Node

WRAP = {"clamp": "clamp", "mirror": "mirror", "black": "zero", "constant": "zero"}
CHANNELS = {"r": 0, "g": 1, "b": 2}
MATERIALX = ("ND_image_", "ND_tiledimage_")
PASSED = ("ND_convert_", "ND_dot_", "ND_normalmap")  #: shaders that change nothing here


class Image(NamedTuple):
    """What a shader makes of an image: scale x + bias, of some channels."""

    file: dict[str, Any]  #: the parameter `filename` or `data`
    output: str  #: rgb, or the name of a channel
    scale: np.ndarray  #: (4,)
    bias: np.ndarray  #: (4,)
    raw: bool  #: whether the values are taken as they are stored
    settings: dict[str, Any]  #: other parameters of a bitmap
    uv: str  #: the primvar of its texture coordinates

    def bitmap(self) -> dict[str, Any]:
        """The image as it is, as a texture."""
        found = {"type": "bitmap", **self.file, **self.settings}
        return found | ({"raw": True} if self.raw else {})

    def made_of(self, values: np.ndarray) -> dict[str, Any]:
        """A texture of other values, of as many pixels."""
        data = np.ascontiguousarray(values, np.float32)
        return {"type": "bitmap", "data": data, "raw": True, **self.settings}

    def rgba(self) -> np.ndarray | None:
        """The values that the shader gives, (height, width, 4); None if the file is missing."""
        image = pixels(self.file)
        if image is None:
            return None
        colours, alpha = split_alpha(image)
        # An image of greys is no colour, and is not encoded as one.
        if (self.raw or colours.shape[2] == 1) and is_encoded(self.file):
            colours = encode_srgb(colours)
        values = np.ones((*image.shape[:2], 4))
        values[..., :3] = colours
        values[..., 3:] = alpha if alpha.size else 1
        return values * self.scale + self.bias

    def colours(self) -> np.ndarray | None:
        """The values of `rgba` without the last channel."""
        values = self.rgba()
        return None if values is None else values[..., :3]

    def channel(self) -> np.ndarray | None:
        """The values of the channel that is used, (height, width); of a colour, the mean."""
        values = self.rgba()
        if values is None:
            return None
        if self.output == "a":
            return values[..., 3]
        if self.output in CHANNELS:
            return values[..., CHANNELS[self.output]]
        return values[..., :3].mean(axis=2)


def image(node: Node, made: Imported) -> Image | None:
    """The image that a node reads; None, with a warning, if it is of no such kind or has none."""
    while node.id.startswith(PASSED) and (source := node.source("in")):
        node = source
    if node.id == "UsdUVTexture":
        return uv_texture(node, made)
    if node.id.startswith(MATERIALX):
        return materialx_image(node, made)
    made.warn(f"shaders of the kind {node.id!r} are left out")
    return None


def uv_texture(node: Node, made: Imported) -> Image | None:
    attribute = node.attribute("file")
    file = attribute and asset(attribute, node.time, made)
    if not file:
        return None
    settings = wrapping(node, "wrapS", "wrapT")
    uv, transform = to_uv(node.source("st"), made)
    scale, bias = (np.array(node.numbers(n, [d] * 4)) for n, d in (("scale", 1.0), ("bias", 0.0)))
    raw = str(node.value("sourceColorSpace", "auto")) == "raw"
    return Image(file, node.output, scale, bias, raw, settings | transform, uv)


def wrapping(node: Node, *names: str) -> dict[str, str]:
    """What is outside of an image, if not its repetition."""
    modes = zip(("wrap_mode_u", "wrap_mode_v"), names, strict=True)
    found = {mode: WRAP.get(str(node.value(name, ""))) for mode, name in modes}
    return {mode: wrap for mode, wrap in found.items() if wrap}


def materialx_image(node: Node, made: Imported) -> Image | None:
    """An image, which a tiled one repeats and moves."""
    attribute = node.attribute("file")
    file = attribute and asset(attribute, node.time, made)
    if not attribute or not file:
        return None
    uv, transform = to_uv(node.source("texcoord"), made)
    tiles = np.diag([*node.numbers("uvtiling", [1, 1]), 1, 1])
    tiles[:2, 3] = -np.array(node.numbers("uvoffset", [0, 0]))
    if (tiles != np.eye(4)).any():
        transform = {"to_uv": OVER @ tiles @ OVER @ transform.get("to_uv", np.eye(4))}
    settings = wrapping(node, "uaddressmode", "vaddressmode") | transform
    raw = "srgb" not in attribute.GetColorSpace().lower()
    output = "rgb" if "_color" in node.id or "_vector" in node.id else "r"
    return Image(file, output, np.ones(4), np.zeros(4), raw, settings, uv)
