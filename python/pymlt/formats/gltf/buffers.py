"""The numbers and images of a glTF file (glTF 2.0, sec. 3.6 and 3.8)."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

from ... import _core

if TYPE_CHECKING:
    import numpy as np

TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}


class Buffers:
    """Access to what the buffers of a file hold."""

    def __init__(self, gltf: Any, path: Path):
        self.gltf = gltf
        self._path = path
        self._buffers: dict[int, bytes] = {}

    def array(self, index: int) -> np.ndarray:
        """What an accessor means: (count, components), floats if it is normalised."""
        import numpy as np

        accessor = self.gltf.accessors[index]
        width = WIDTHS[accessor.type]
        values = np.zeros((accessor.count, width), TYPES[accessor.componentType])
        if accessor.bufferView is not None:
            values = self._numbers(accessor, accessor.count, width, accessor.componentType)
        if accessor.sparse:
            sparse = accessor.sparse
            kind = sparse.indices.componentType
            rows = self._numbers(sparse.indices, sparse.count, 1, kind)[:, 0]
            values = values.copy()
            kind = accessor.componentType
            values[rows] = self._numbers(sparse.values, sparse.count, width, kind)
        if accessor.normalized:
            return np.maximum(values / np.iinfo(values.dtype).max, -1)
        return values

    def _numbers(self, place: Any, count: int, width: int, kind: int) -> np.ndarray:
        import numpy as np

        view = self.gltf.bufferViews[place.bufferView]
        item = np.dtype(TYPES[kind])
        data = self.view(place.bufferView)
        start, stride = place.byteOffset or 0, view.byteStride or item.itemsize * width
        if count and start + (count - 1) * stride + item.itemsize * width > len(data):
            raise _core.SceneError(f"{self._path}: an accessor reaches beyond its buffer")
        return np.ndarray((count, width), item, data, start, (stride, item.itemsize))

    def view(self, index: int) -> bytes:
        """The bytes of a buffer view."""
        view = self.gltf.bufferViews[index]
        if view.buffer not in self._buffers:
            uri = self.gltf.buffers[view.buffer].uri
            blob = self.gltf.binary_blob()
            self._buffers[view.buffer] = self.content(uri) if uri else blob or b""
        start = view.byteOffset or 0
        return self._buffers[view.buffer][start : start + view.byteLength]

    def content(self, uri: str) -> bytes:
        """The bytes that a URI means: base64 data, or a file beside the scene."""
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        path = self._path.parent / unquote(uri)
        try:
            return path.read_bytes()
        except OSError as error:
            raise _core.FileError(f"{path}: cannot be read: {error.strerror}") from None

    def image(self, index: int) -> bytes:
        """The file of an image: PNG or JPEG."""
        image = self.gltf.images[index]
        return self.content(image.uri) if image.uri else self.view(image.bufferView)
