"""Arrays in scene dicts: meshes, images and grids that are in memory already.

A mesh is `{"type": "mesh", "vertices": (n, 3), "faces": (m, 3), "normals": (n, 3), "uv": (n, 2),
"vertex_color": (n, 3)}`, of which only the first two are needed, or an object with `vertices` and
`faces`, such as a `trimesh.Trimesh`, in the place of a shape. An image is `{"type": "bitmap",
"data": (height, width[, channels])}`; `envmap` and `goniometric` take `data` too. All also take
the bytes of an image file. A volume is `{"type": "gridvolume", "data": (depth, height, width[,
channels])}`. In the place of `data`, images have `bitmap` and volumes `grid`, under which Mitsuba
takes an `mi.Bitmap` and an `mi.VolumeGrid`. The core gets arrays as bytes: so they are part of the
scene where it is hashed, pickled, saved in a checkpoint or sent to a cluster.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .. import _core

if TYPE_CHECKING:
    import numpy as np

# Deeper dicts, and those that contain themselves, are left to the core, which refuses them.
MOST_LEVELS = 64

MESH_BUFFERS = {"vertices": 3, "faces": 3, "normals": 3, "uv": 2, "vertex_color": 3}
IMAGES = ("bitmap", "envmap", "goniometric")
# What Mitsuba calls `data`.
HELD = dict.fromkeys(IMAGES, "bitmap") | {"gridvolume": "grid"}


def with_bytes(scene: dict, path: str = "scene") -> dict:
    """The same dict with bytes in the place of its arrays. Raises SceneError, which names them."""
    changed: dict[str, Any] = {}
    other_name = HELD.get(scene.get("type"))
    if other_name in scene:
        scene = with_data(scene, other_name, path)
    if path.count("[") > MOST_LEVELS:
        return scene
    for key, value in scene.items():
        inner = f"{path}[{key!r}]"
        if is_mesh_object(value):
            changed[key] = from_mesh_object(value, inner)
        elif isinstance(value, dict):
            nested = with_bytes(value, inner)
            if nested is not value:
                changed[key] = nested
    if scene.get("type") == "mesh":
        changed |= {k: mesh_buffer(scene[k], k, path) for k in MESH_BUFFERS if k in scene}
    elif scene.get("type") in IMAGES and "data" in scene:
        changed |= image_buffer(scene, path)
    elif scene.get("type") == "gridvolume" and "data" in scene:
        changed |= grid_buffer(scene["data"], path)
    return scene | changed if changed else scene


def with_data(holder: dict, name: str, path: str) -> dict:
    """The same plug-in, whose array is called `data` instead of `name`."""
    if "data" in holder:
        raise _core.SceneError(f"{path}: 'data' and '{name}' are the same; give one")
    return {"data" if key == name else key: value for key, value in holder.items()}


def with_arrays(values: dict) -> dict:
    """The parameters of a plug-in with arrays in the place of their bytes."""
    import numpy as np

    arrays: dict[str, Any] = {}
    for key, value in values.items():
        if not isinstance(value, bytes):
            continue
        if key in MESH_BUFFERS:
            dtype = np.uint32 if key == "faces" else np.float32
            arrays[key] = np.frombuffer(value, dtype).reshape(-1, MESH_BUFFERS[key])
        elif key == "data" and "data_shape" not in values:
            continue  # the bytes of a file
        elif key == "data" and "data_type" not in values:
            shape = [int(length) for length in values["data_shape"]]
            grid = np.frombuffer(value, np.float32).reshape(*shape, -1)
            arrays[key] = grid[..., 0] if grid.shape[-1] == 1 else grid
        elif key == "data" and values["data_type"] in ("uint8", "float32"):
            shape = [int(length) for length in values["data_shape"]]
            arrays[key] = np.frombuffer(value, values["data_type"]).reshape(shape)
    return values | arrays


def is_mesh_object(value: Any) -> bool:
    return not isinstance(value, dict) and hasattr(value, "vertices") and hasattr(value, "faces")


def from_mesh_object(mesh: Any, path: str) -> dict:
    """A trimesh object as a shape of bytes."""
    return with_bytes(mesh_dict(mesh), path)


def mesh_dict(mesh: Any) -> dict:
    """A trimesh object as a shape. It has the face normals that trimesh would draw: none given."""
    shape = {"type": "mesh", "vertices": mesh.vertices, "faces": mesh.faces}
    uv = getattr(getattr(mesh, "visual", None), "uv", None)
    if uv is not None:
        shape["uv"] = uv
    return shape


def as_array(value: Any, key: str, path: str) -> np.ndarray:
    import numpy as np

    try:
        array = np.asarray(value)
    except ValueError as error:
        raise _core.SceneError(f"{path}: '{key}' is not an array: {error}") from None
    if array.dtype.kind not in "fiu":
        raise _core.SceneError(f"{path}: '{key}' has the dtype {array.dtype}, but needs numbers")
    return array


def float_bytes(array: np.ndarray, key: str, path: str) -> bytes:
    import numpy as np

    with np.errstate(over="ignore"):  # what becomes infinite is named
        floats = np.ascontiguousarray(array, np.float32)
    if not np.isfinite(floats).all():
        index = tuple(int(i) for i in np.argwhere(~np.isfinite(floats))[0])
        raise _core.SceneError(f"{path}: '{key}' is not finite at {list(index)}: {array[index]}")
    return floats.tobytes()


def mesh_buffer(value: Any, key: str, path: str) -> bytes:
    import numpy as np

    if isinstance(value, bytes):
        return value
    array, columns = as_array(value, key, path), MESH_BUFFERS[key]
    if array.ndim != 2 or array.shape[1] != columns:
        raise _core.SceneError(
            f"{path}: '{key}' has the shape {array.shape}, but should have (n, {columns})"
        )
    if key != "faces":
        return float_bytes(array, key, path)
    if array.dtype.kind == "f":
        raise _core.SceneError(f"{path}: 'faces' has the dtype {array.dtype}, but needs integers")
    if array.size and not 0 <= array.min() <= array.max() < 2**32:
        raise _core.SceneError(f"{path}: 'faces' holds {array.min()}, which is no vertex")
    return np.ascontiguousarray(array, np.uint32).tobytes()


def image_buffer(image: dict, path: str) -> dict:
    if isinstance(image["data"], bytes):
        return {} if "data_type" in image else {"data_type": "file"}
    array = as_array(image["data"], "data", path)
    if array.ndim not in (2, 3) or (array.ndim == 3 and not 1 <= array.shape[2] <= 4):
        raise _core.SceneError(
            f"{path}: 'data' has the shape {array.shape}, but should have (height, width), or with "
            "1 to 4 channels"
        )
    if array.dtype.kind != "f" and array.dtype.name != "uint8":
        raise _core.SceneError(
            f"{path}: 'data' has the dtype {array.dtype}, but should have uint8 (sRGB) or floats "
            "(linear)"
        )
    uint8 = array.dtype.name == "uint8"
    return {
        "data": array.tobytes() if uint8 else float_bytes(array, "data", path),
        "data_type": "uint8" if uint8 else "float32",
        "data_shape": [*array.shape, 1][:3],
    }


def grid_buffer(data: Any, path: str) -> dict:
    if isinstance(data, bytes):
        return {}
    array = as_array(data, "data", path)
    if array.ndim == 4 and array.shape[3] == 1:
        array = array[..., 0]
    if array.ndim not in (3, 4) or (array.ndim == 4 and array.shape[3] != 3):
        raise _core.SceneError(
            f"{path}: 'data' has the shape {array.shape}, but should have (depth, height, width), "
            "or with 3 channels"
        )
    return {"data": float_bytes(array, "data", path), "data_shape": list(array.shape[:3])}
