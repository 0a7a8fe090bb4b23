"""Compressed meshes, of which only what stands beside them for other readers is read."""

from __future__ import annotations

from typing import Any

from ... import _core
from .checked import at, attributes_of

DRACO, MESHOPT = "KHR_draco_mesh_compression", "EXT_meshopt_compression"
COMPRESSIONS = {DRACO, MESHOPT}
UNPACKING = "export it without compression, or run `gltf-transform copy IN.glb OUT.glb`"


def refuse_required(names: set[str]) -> None:
    """Raises SceneError for extensions that a file needs and that are not known here, if any."""
    if names:
        advice = f": {UNPACKING}" if COMPRESSIONS & names else ""
        raise _core.SceneError(f"needs {', '.join(sorted(names))}, which is not supported{advice}")


def check_uncompressed(primitive: Any, gltf: Any) -> None:
    """Raises SceneError for a primitive that has no numbers but compressed ones."""
    if DRACO not in (primitive.extensions or {}):
        return
    used = {*attributes_of(primitive.attributes).values(), primitive.indices} - {None}
    if any(at(gltf.accessors, index, "accessor").bufferView is None for index in used):
        refuse_required({DRACO})


def check_buffer(buffer: Any) -> None:
    """Raises SceneError for a buffer that is empty but for compressed views of it."""
    if (buffer.extensions or {}).get(MESHOPT, {}).get("fallback") and not buffer.uri:
        refuse_required({MESHOPT})
