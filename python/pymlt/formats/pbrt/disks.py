"""Textures on disks, where pbrt's u goes around and v inwards, ours outwards and around.

Our (u, v) is (v, 1 - u) in pbrt.
"""

from __future__ import annotations

from typing import Any

from .params import Params

PLACED = ("bitmap", "checkerboard")  #: the textures that have coordinates


def on_a_disk(plugin: dict[str, Any], params: Params) -> dict[str, Any]:
    """A BSDF or emitter with its textures where pbrt has them; the same object if it has none."""
    import numpy as np

    if plugin["type"] == "ref":
        named = params.made.scene[plugin["id"]]
        made = on_a_disk(named, params)
        return plugin if made is named else made
    if plugin["type"] in PLACED:
        inwards = np.array([[0.0, 1, 0, 0], [-1, 0, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]])
        return plugin | {"to_uv": inwards}
    if plugin["type"] == "normalmap":
        params.warn("the normals of a normal map on a disk are turned by a quarter")
    parts = {key: part for key, part in plugin.items() if isinstance(part, dict)}
    placed = {key: on_a_disk(part, params) for key, part in parts.items()}
    changed = {key: part for key, part in placed.items() if part is not parts[key]}
    return plugin | changed if changed else plugin
