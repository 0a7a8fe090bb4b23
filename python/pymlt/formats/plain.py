"""A scene dict of any form that `load_dict` takes, in the form that the XML writer takes."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from ..scenes.arrays import HELD, MESH_BUFFERS, is_mesh_object, mesh_dict, with_data

COLOURS = {"rgb": "value", "srgb": "color"}


def plain(value: Any, path: str = "scene") -> Any:
    """Plug-ins are dicts, transforms (4, 4) arrays, triples lists; other arrays stay what they are.

    Raises SceneError for an image that is given twice.
    """
    if hasattr(value, "to_dict"):
        value = value.to_dict()
    if is_mesh_object(value):
        value = mesh_dict(value)
    if isinstance(value, dict):
        return _plugin(value, path)
    if isinstance(value, str | bool | int | float | bytes):
        return value
    if hasattr(value, "__fspath__"):
        return os.fspath(value)
    array = np.asarray(getattr(value, "matrix", value))
    if array.ndim == 0:
        return array.item()
    return array if array.ndim == 2 else array.tolist()


def _plugin(value: dict, path: str) -> dict:
    kind = value.get("type")
    if kind in COLOURS:
        return {"type": "rgb", "value": plain(value[COLOURS[kind]], path)}
    if kind == "spectrum":
        return value
    if HELD.get(kind) in value:
        value = with_data(value, HELD[kind], path)
    arrays = {"data", *MESH_BUFFERS} if kind in ("mesh", *HELD) else set()
    return {
        key: inner if key in arrays else plain(inner, f"{path}[{key!r}]")
        for key, inner in value.items()
    }
