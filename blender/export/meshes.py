"""Evaluated meshes as triangles; each material becomes a shape of its own.

Curves, texts, surfaces and metaballs are among them: Blender has a mesh for each as an instance.
"""

import numpy as np

from .bakes import LAYER


def read(items, attribute: str, width: int, dtype=np.float32) -> np.ndarray:
    """An attribute of all items of a collection, (n, width)."""
    values = np.empty(len(items) * width, dtype)
    items.foreach_get(attribute, values)
    return values.reshape(-1, width)


def parts(thing, baked: set[int] = frozenset()) -> list[tuple[int, dict]]:
    """Slot of material and mesh, for each material that the faces of an evaluated object have.

    Slots in `baked` have the UV map of baked images.
    """
    mesh = thing.to_mesh()
    if mesh is None:
        return []
    try:
        return list(split(mesh, baked))
    finally:
        thing.to_mesh_clear()


def split(mesh, baked: set[int]):
    mesh.calc_loop_triangles()
    triangles = mesh.loop_triangles
    if not len(triangles):
        return
    loops = read(triangles, "loops", 3, np.int32)
    slots = read(triangles, "material_index", 1, np.int32)[:, 0]
    places = read(mesh.vertices, "co", 3)[read(mesh.loops, "vertex_index", 1, np.int32)[:, 0]]
    of_corners = {"vertices": places, "normals": read(mesh.corner_normals, "vector", 3)}
    if layer := next((layer for layer in mesh.uv_layers if layer.active_render), None):
        of_corners["uv"] = read(layer.uv, "vector", 2)
    unwrapped = mesh.uv_layers.get(LAYER)
    if baked and unwrapped:
        unwrapped = read(unwrapped.uv, "vector", 2)
    for slot in np.unique(slots):
        corners = loops[slots == slot]
        used = np.zeros(len(places), bool)
        used[corners] = True
        arrays = {name: values[used] for name, values in of_corners.items()}
        if slot in baked and unwrapped is not None:
            arrays["uv"] = unwrapped[used]
        yield int(slot), {"type": "mesh", "faces": (np.cumsum(used) - 1)[corners], **arrays}
