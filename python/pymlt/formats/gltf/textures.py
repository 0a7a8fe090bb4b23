"""Textures of glTF as bitmaps; channels that glTF packs into one image become images of their own.

Row 0 of an image is at v = 0 in glTF and in `bitmap` alike (glTF 2.0, sec. 3.8.3).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ... import _core
from ...pictures.tonemapping import encode_srgb, split_alpha
from ..imported import Imported, rgb
from ..limits import check_pixels
from .buffers import Buffers
from .checked import at, warn_of_others
from .uv_transform import UV_TRANSFORM, to_uv

if TYPE_CHECKING:
    import numpy as np

WRAP = {33071: "clamp", 33648: "mirror", 10497: "repeat"}
NEAREST = 9728
VERTEX_COLOURS = {"type": "mesh_attribute", "name": "vertex_color"}


class Textures:
    """The textures of a file."""

    def __init__(self, buffers: Buffers, made: Imported):
        self._gltf = buffers.gltf
        self._buffers = buffers
        self._made = made
        self._images: dict[int, bytes] = {}
        self._channels: dict[tuple[Any, ...], np.ndarray] = {}

    def colour(
        self, info: Any, factor: list[float], *, of_vertices: bool = False
    ) -> dict[str, Any]:
        """A colour texture (sRGB-encoded), or the colours of vertices, times a factor."""
        if info is None and not of_vertices:
            return rgb(factor[:3])
        if info is None:
            texture = VERTEX_COLOURS
        else:
            texture = self._bitmap(info, self._image(info))
            if of_vertices:
                self._made.warn(
                    "colours of vertices (COLOR_0) are left out where the base colour is a texture"
                )
        if factor[:3] == [1, 1, 1]:
            return texture
        return {"type": "scale", "scale": rgb(factor[:3]), "texture": texture}

    def raw(self, info: Any) -> dict[str, Any]:
        """A texture of numbers, such as normals."""
        return self._bitmap(info, self._image(info)) | {"raw": True}

    def channel(self, info: Any, channel: int, factor: float) -> float | dict[str, Any]:
        """One channel of a texture of numbers times a factor, or the factor alone."""
        if info is None:
            return factor
        key = (self._texture(info).source, channel, factor)
        if key not in self._channels:
            self._channels[key] = factor * self.numbers(info, channel)[..., 0]
        return self._bitmap(info, self._channels[key]) | {"raw": True}

    def numbers(self, info: Any, channel: int) -> np.ndarray:
        """One channel of a texture of numbers, (height, width, 1); a 1 alone without a texture.

        The channels of a grey image are the same.
        """
        import numpy as np

        if info is None:
            return np.ones((1, 1, 1))
        samples = self._samples(info)
        return samples[..., [channel if samples.shape[2] > 2 else 0]]

    def opacity(self, info: Any, factor: float, cutoff: float | None) -> float | dict[str, Any]:
        """Alpha times a factor; with a cutoff it is 0 or 1."""
        alpha: Any = factor
        if info is not None and (samples := self._samples(info)).shape[2] in (2, 4):
            alpha = factor * samples[..., -1]
        if cutoff is not None:
            alpha = (alpha >= cutoff) * 1.0
        if not hasattr(alpha, "shape"):
            return float(alpha)
        return self._bitmap(info, alpha) | {"raw": True}

    def linear(self, info: Any) -> np.ndarray:
        """Linear red, green and blue with alpha: (height, width, 4), a white pixel without image.

        Alpha, which is not encoded, stays as it is.
        """
        import numpy as np

        if info is None:
            return np.ones((1, 1, 4))
        image = decoded(self._image(info), self._name(info))
        colours, alpha = split_alpha(image)
        rgba = np.ones((*image.shape[:2], 4), image.dtype)
        rgba[..., :3] = colours
        rgba[..., 3:] = alpha if alpha.size else 1
        return rgba

    def made_of(self, values: np.ndarray, info: Any) -> Any:
        """Linear colours, or numbers, of the pixels of an image; one alone if all are the same."""
        first = values[0, 0].tolist()
        if (values == values[0, 0]).all():
            return rgb(first) if len(first) == 3 else first[0]
        pixels = values.astype("f4")
        if len(first) == 3:
            return self._bitmap(info, pixels)
        return self._bitmap(info, pixels[..., 0]) | {"raw": True}

    def _texture(self, info: Any) -> Any:
        return at(self._gltf.textures, info.index, "texture")

    def _image(self, info: Any) -> bytes:
        """The content of the texture's file."""
        index = self._texture(info).source
        if index not in self._images:
            self._images[index] = self._buffers.image(index)
        return self._images[index]

    def _samples(self, info: Any) -> np.ndarray:
        return stored_samples(self._image(info), self._name(info))

    def _name(self, info: Any) -> str:
        """The image in errors."""
        return f"{self._buffers.path}: image {self._texture(info).source}"

    def _bitmap(self, info: Any, data: bytes | np.ndarray) -> dict[str, Any]:
        warn_of_others(info.extensions, {UV_TRANSFORM}, self._made)
        transform = (info.extensions or {}).get(UV_TRANSFORM, {})
        if transform.get("texCoord", info.texCoord):
            self._made.warn("second texture coordinates are left out; the first are taken")
        bitmap: dict[str, Any] = {"type": "bitmap", "data": data}
        if transform:
            bitmap["to_uv"] = to_uv(transform)
        index = self._texture(info).sampler
        if index is not None:
            sampler = at(self._gltf.samplers, index, "sampler")
            for axis, wrap in (("u", sampler.wrapS), ("v", sampler.wrapT)):
                if WRAP.get(wrap, "repeat") != "repeat":
                    bitmap[f"wrap_mode_{axis}"] = WRAP[wrap]
            if sampler.magFilter == NEAREST:
                bitmap["filter_type"] = "nearest"
        return bitmap


def stored_samples(content: bytes, name: str) -> np.ndarray:
    """The samples of an integer format as they are stored, 0 to 1: (height, width, channels)."""
    import numpy as np

    colours, alpha = split_alpha(decoded(content, name))
    return np.concatenate([encode_srgb(colours), alpha], axis=2)


def decoded(content: bytes, name: str) -> np.ndarray:
    """The linear samples of an image that is to be changed. Raises FileError if it is too large."""
    image = _core.decode_image(content, name)
    check_pixels(image, name)
    return image


def mean_colour(texture: Any) -> np.ndarray:
    """The linear red, green and blue, (3,), of a number, a colour, or the mean of an image."""
    import numpy as np

    if not isinstance(texture, dict):
        return np.full(3, float(texture))
    match texture["type"]:
        case "rgb":
            return np.array(texture["value"])
        case "scale":
            return mean_colour(texture["scale"]) * mean_colour(texture["texture"])
    data = texture["data"]
    image = _core.decode_image(data, "a texture") if isinstance(data, bytes) else data
    colours, _ = split_alpha(image.reshape(*image.shape[:2], -1))
    return np.broadcast_to(colours.mean(axis=(0, 1), dtype=float), 3)
