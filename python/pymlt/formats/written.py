"""A scene dict with files in the place of its arrays."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from .. import _core
from ..images import write_image
from ..scenes.arrays import MESH_BUFFERS
from .ply import Mesh, write_ply

SUFFIXES = {b"\x89PNG": ".png", b"\xff\xd8": ".jpg", b"ply": ".ply", b"VOL": ".vol"}


class Written:
    """Files in a folder, with names that begin with a stem; each array is written once."""

    def __init__(self, folder: Path, stem: str):
        self._folder = folder
        self._stem = stem
        self._files: dict[tuple[int, ...], str] = {}
        self._kept: list[Any] = []

    def scene(self, plugin: dict[str, Any], name: str = "") -> dict[str, Any]:
        """The same plug-in, and those in it."""
        made = {
            key: self.scene(value, name or key) if isinstance(value, dict) else value
            for key, value in plugin.items()
        }
        if plugin["type"] == "mesh":
            buffers = {key: made.pop(key, None) for key in MESH_BUFFERS}
            file = self._file(list(buffers.values()), f"{name}-mesh", ".ply")
            return {**made, "type": "ply", "filename": file}
        if plugin["type"] == "gridvolume" and "data" in made:
            made["filename"] = self._file([made.pop("data")], f"{name}-grid", ".vol")
        if "data" in made:
            made["filename"] = self._file([made.pop("data")], f"{name}-image", ".exr")
        return made

    def _file(self, arrays: list[Any], name: str, suffix: str) -> str:
        key = tuple(map(id, arrays))
        if key not in self._files:
            self._kept += arrays  # So that no other array gets the same id.
            if isinstance(arrays[0], bytes):
                suffix = suffix_of(arrays[0])
            path = self._folder / f"{self._stem}-{name}-{len(self._files)}{suffix}"
            write(path, arrays)
            self._files[key] = str(path)
        return self._files[key]


def vol(grid: Any) -> bytes:
    """A grid, (depth, height, width[, channels]), as Mitsuba's .vol."""
    array = np.ascontiguousarray(grid, np.float32)
    channels = array.shape[3] if array.ndim == 4 else 1
    size = np.array([1, *array.shape[2::-1], channels], np.int32)
    box = np.array([0, 0, 0, 1, 1, 1], np.float32)
    return b"VOL\x03" + size.tobytes() + box.tobytes() + array.tobytes()


def suffix_of(content: bytes) -> str:
    """The extension of an image or mesh file with this content."""
    return next((s for start, s in SUFFIXES.items() if content.startswith(start)), ".img")


def write(path: Path, arrays: list[Any]) -> None:
    """Bytes as they are, a grid, an image, or a mesh."""
    if isinstance(arrays[0], bytes):
        try:
            path.write_bytes(arrays[0])
        except OSError as error:
            raise _core.FileError(f"{path}: cannot write it: {error.strerror}") from None
    elif path.suffix == ".vol":
        write(path, [vol(arrays[0])])
    elif len(arrays) == 1:
        write_image(path, np.asarray(arrays[0], np.float32))
    else:
        write_ply(path, Mesh(*arrays))
