"""What nodes compute, as numbers, colours and textures of a scene dict.

A value that is the same at all texture coordinates is a constant. An image that nothing changes is
a `bitmap` of its file. All else is computed on a grid of texture coordinates, texel by texel.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ... import _core
from . import coordinates
from .graph import Graph, Use
from .images import WRAPS, Images, Lookup
from .origin import Port, origin
from .scope import Scope

Pattern = Callable[[Graph], np.ndarray]  #: a value (height, width, channels)
Limits = tuple[float, float]

UNLIMITED = (-np.inf, np.inf)
PROBES = np.array([[[0.13, 0.29], [0.71, 0.17], [0.37, 0.83], [0.91, 0.61], [0.53, 0.47]]])
PLAIN = 1024  #: texels along a pattern that is made of no image
MOST = 4096  #: texels along any pattern that is computed
STRIP = 64  #: rows of texels that are computed at a time
NATIVE = (".png", ".jpg", ".jpeg", ".exr", ".hdr", ".tga", ".bmp")  #: files that `bitmap` reads


class Textures:
    """The textures of a document."""

    def __init__(self, document: Any, contents: Mapping[str, bytes] | None = None):
        self._document = document
        self.images = Images(contents or {})

    def constant(self, pattern: Pattern) -> list[float] | None:
        """The numbers of what is the same everywhere; None for what is not."""
        graph = self._graph(PROBES)
        values = np.asarray(pattern(graph))
        return None if graph.uses else values.reshape(-1, values.shape[-1])[0].tolist()

    def texture(
        self, port: Port, where: str, *, raw: bool = False, limits: Limits = UNLIMITED
    ) -> dict[str, Any]:
        """A bitmap of what is not the same everywhere; `raw` are three numbers, not a colour.

        Computed values are clipped to the limits. Raises SceneError, which says `where`, for those
        that are still infinite, or no numbers.
        """
        found = origin(port, self.factor)
        if found is not None and found[0].getCategory() == "image":
            bitmap = self._of_file(*found, raw)
            if bitmap is not None:
                return bitmap
        return self.computed(lambda graph: graph.value(*port), where, raw=raw, limits=limits)

    def factor(self, node: Any, name: str, scope: Scope) -> list[float] | None:
        """A constant input of a node."""
        return self.constant(lambda graph: graph.argument(node, name, scope))

    def computed(
        self, pattern: Pattern, where: str, *, raw: bool = False, limits: Limits = UNLIMITED
    ) -> dict[str, Any]:
        """A bitmap of an array, whose texels are computed; otherwise as `texture`."""
        graph = self._graph(PROBES)
        channels = np.asarray(pattern(graph)).shape[-1]
        affine = common_map(graph.uses)
        width, height = self._size(graph.uses, affine)
        data = np.empty((height, width, channels), np.float32)
        for start in range(0, height, STRIP):
            rows = np.arange(start, min(start + STRIP, height))
            u, v = np.meshgrid((np.arange(width) + 0.5) / width, 1 - (rows + 0.5) / height)
            uv = coordinates.applied(coordinates.inverse(affine), np.stack([u, v], axis=-1))
            data[rows] = pattern(self._graph(uv))
        data = checked_finite(data.clip(*limits), where)
        bitmap: dict[str, Any] = {"type": "bitmap", "data": data if channels > 1 else data[..., 0]}
        if raw or channels == 1:
            bitmap["raw"] = True
        return bitmap | placed(affine) | continued(graph.uses)

    def _graph(self, uv: np.ndarray) -> Graph:
        return Graph(self._document, self.images, uv)

    def _of_file(self, node: Any, scope: Scope, raw: bool) -> dict[str, Any] | None:
        """An image node as a bitmap of its file, None if that would not be the same."""
        graph = self._graph(PROBES)
        graph.node_value(node, scope)
        use = graph.uses[-1]
        lookup, affine = use.lookup, coordinates.fitted(PROBES, use.coordinates)
        if lookup is None or affine is None or lookup.file.path.suffix.lower() not in NATIVE:
            return None
        if lookup.kind != ("vector3" if raw else "color3"):
            return None
        decoding = "raw" if raw else lookup.decoding
        if decoding is None:
            return None
        bitmap = {"type": "bitmap", **self.images.source(lookup.file)}
        if decoding:
            bitmap["raw"] = True
        return bitmap | placed(affine) | continued([use])

    def _size(self, uses: list[Use], affine: np.ndarray) -> tuple[int, int]:
        """The width and height at which no image of a pattern loses texels."""
        sizes: list[tuple[float, float]]
        sizes = [(PLAIN, PLAIN)] if any(use.lookup is None for use in uses) else [(1, 1)]
        for use in uses:
            if use.lookup is not None:
                sizes.append(self._image_size(use, use.lookup, affine))
        width, height = np.max(sizes, axis=0)
        return int(min(width, MOST)), int(min(height, MOST))

    def _image_size(self, use: Use, lookup: Lookup, affine: np.ndarray) -> tuple[float, float]:
        size = np.array(self.images.size(lookup))
        own = coordinates.fitted(PROBES, use.coordinates)
        if own is None:
            return (PLAIN, PLAIN)
        stretch = own[:, :2] @ coordinates.inverse(affine)[:, :2]
        width, height = np.ceil(size @ np.abs(stretch) - 1e-6)
        return (max(width, 1), max(height, 1))


def checked_finite(data: np.ndarray, where: str) -> np.ndarray:
    if not np.isfinite(data).all():
        raise _core.SceneError(f"{where} has values that are infinite or no numbers")
    return data


def common_map(uses: list[Use]) -> np.ndarray:
    """The coordinates that all images of a pattern have, else those of the surface."""
    maps = [coordinates.fitted(PROBES, use.coordinates) for use in uses]
    first = maps[0] if maps else None
    if first is None or not coordinates.is_invertible(first):
        return coordinates.IDENTITY
    same = all(other is not None and np.allclose(first, other, atol=1e-6) for other in maps)
    return first if same else coordinates.IDENTITY


def placed(affine: np.ndarray) -> dict[str, Any]:
    """The `to_uv` of a bitmap that is looked up at these coordinates."""
    if np.allclose(affine, coordinates.IDENTITY, atol=1e-9):
        return {}
    return {"to_uv": coordinates.to_uv(affine)}


def continued(uses: list[Use]) -> dict[str, Any]:
    """How a bitmap goes on outside and between texels, if all images of a pattern do so."""
    lookups = [use.lookup for use in uses]
    closest = all(lookup is not None and lookup.filtering == "closest" for lookup in lookups)
    found: dict[str, Any] = {"filter_type": "nearest"} if closest else {}
    for key, name in (("wrap_mode_u", "wrap_u"), ("wrap_mode_v", "wrap_v")):
        modes = {getattr(lookup, name, "periodic") for lookup in lookups}
        mode = WRAPS.get(modes.pop(), "repeat") if len(modes) == 1 else "repeat"
        if mode != "repeat":
            found[key] = mode
    return found
