"""The numbers and images of a glTF file (glTF 2.0, sec. 3.6 and 3.8)."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

from ... import _core
from ..limits import read_file
from ..missing import ABSENT, is_missing
from .checked import at
from .compression import check_buffer

if TYPE_CHECKING:
    import numpy as np

TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
MOST_ZEROS = 2**20  #: of an accessor without a buffer view


class Buffers:
    """Access to what the buffers of a file hold."""

    def __init__(self, gltf: Any, path: Path):
        self.gltf = gltf
        self.path = path
        self._buffers: dict[int, bytes] = {}

    def array(self, index: int) -> np.ndarray:
        """What an accessor means: (count, components), floats if it is normalised."""
        import numpy as np

        accessor = at(self.gltf.accessors, index, "accessor")
        width, kind = WIDTHS[accessor.type], accessor.componentType
        if accessor.bufferView is not None:
            values = self._numbers(accessor, accessor.count, width, kind)
        elif accessor.count > MOST_ZEROS:
            raise _core.SceneError(
                f"accessor {index} has {accessor.count} zeros and no buffer view"
            )
        else:
            values = np.zeros((accessor.count, width), TYPES[kind])
        if accessor.sparse:
            values = self._replaced(values, accessor.sparse, kind)
        if accessor.normalized:
            return np.maximum(values / np.iinfo(values.dtype).max, -1)
        return values

    def _replaced(self, values: np.ndarray, sparse: Any, kind: int) -> np.ndarray:
        """With other values in some rows."""
        rows = self._numbers(sparse.indices, sparse.count, 1, sparse.indices.componentType)[:, 0]
        if rows.dtype.kind != "u":
            raise _core.SceneError("the indices of a sparse accessor should be unsigned integers")
        values = values.copy()
        values[rows] = self._numbers(sparse.values, sparse.count, values.shape[1], kind)
        return values

    def _numbers(self, place: Any, count: int, width: int, kind: int) -> np.ndarray:
        import numpy as np

        view = at(self.gltf.bufferViews, place.bufferView, "bufferView")
        item = np.dtype(TYPES[kind])
        data = self.view(place.bufferView)
        size = item.itemsize * width
        start, stride = place.byteOffset or 0, view.byteStride or size
        if stride < size:
            raise _core.SceneError(
                "the elements of an accessor overlap: its byteStride is too small"
            )
        if start + max(count - 1, 0) * stride + size > len(data):
            raise _core.SceneError("an accessor reaches beyond its bufferView")
        return np.ndarray((count, width), item, data, start, (stride, item.itemsize))

    def view(self, index: int) -> memoryview:
        """The bytes of a buffer view."""
        view = at(self.gltf.bufferViews, index, "bufferView")
        if view.buffer not in self._buffers:
            given = at(self.gltf.buffers, view.buffer, "buffer")
            check_buffer(given)
            blob = self.gltf.binary_blob()
            self._buffers[view.buffer] = self.content(given.uri) if given.uri else blob or b""
        buffer, start = self._buffers[view.buffer], view.byteOffset or 0
        if start + view.byteLength > len(buffer):
            raise _core.SceneError(f"bufferView {index} reaches beyond its buffer")
        return memoryview(buffer)[start : start + view.byteLength]

    def content(self, uri: str) -> bytes:
        """The bytes that a URI means: base64 data, or a file beside the scene."""
        if uri.startswith("data:"):
            return base64.b64decode(uri.partition(",")[2])
        return read_file(self._file(uri))

    def _file(self, uri: str) -> Path:
        return self.path.parent / unquote(uri)

    def missing(self) -> list[str]:
        """That files are not there, of all that the scene names."""
        uris = [given.uri for given in (*self.gltf.buffers, *self.gltf.images) if given.uri]
        files = [self._file(uri) for uri in uris if not uri.startswith("data:")]
        return [f"{file}: {ABSENT}" for file in files if is_missing(file)]

    def image(self, index: int) -> bytes:
        """The file of an image: PNG or JPEG."""
        image = at(self.gltf.images, index, "image")
        return self.content(image.uri) if image.uri else bytes(self.view(image.bufferView))
