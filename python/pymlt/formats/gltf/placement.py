"""Where nodes are, and the copies of their meshes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ... import _core
from ..imported import Imported
from .buffers import Buffers

if TYPE_CHECKING:
    import numpy as np

INSTANCING = "EXT_mesh_gpu_instancing"
#: Attributes of copies, and their values where a file gives none.
PARTS = {"TRANSLATION": (0, 0, 0), "ROTATION": (0, 0, 0, 1), "SCALE": (1, 1, 1)}


def local_matrix(node: Any) -> np.ndarray:
    """glTF 2.0, sec. 3.5.3: a matrix by columns, (4, 4), or T R S."""
    import numpy as np

    if node.matrix:
        return np.array(node.matrix, dtype=float).reshape(4, 4).T
    given = node.translation, node.rotation, node.scale
    parts = [value or default for value, default in zip(given, PARTS.values(), strict=True)]
    return placed(*(np.array([part], dtype=float) for part in parts))[0]


def instances(node: Any, buffers: Buffers, made: Imported) -> np.ndarray | None:
    """The copies of a node's mesh, (copies, 4, 4), in its own frame; None without the extension.

    EXT_mesh_gpu_instancing. Raises SceneError where the counts of its accessors differ.
    """
    import numpy as np

    extension = (node.extensions or {}).get(INSTANCING)
    if extension is None:
        return None
    attributes = extension.get("attributes", {})
    for name in sorted(set(attributes) - set(PARTS)):
        made.warn(f"{name} of {INSTANCING} is left out")
    given = {name: buffers.array(attributes[name]) for name in PARTS if name in attributes}
    counts = {name: len(values) for name, values in given.items()}
    if len(set(counts.values())) > 1:
        raise _core.SceneError(f"the attributes of {INSTANCING} have different counts: {counts}")
    count = max(counts.values(), default=1)
    defaults = {name: np.tile(default, (count, 1)) for name, default in PARTS.items()}
    for name, values in given.items():
        if values.shape[1] != len(PARTS[name]):
            raise _core.SceneError(
                f"{name} of {INSTANCING} has {values.shape[1]} components, "
                f"but should have {len(PARTS[name])}"
            )
    translations, rotations, scales = (defaults | given).values()
    lengths = np.linalg.norm(rotations, axis=1, keepdims=True)
    return placed(translations, rotations / lengths, scales)


def placed(translations: np.ndarray, rotations: np.ndarray, scales: np.ndarray) -> np.ndarray:
    """T R S of each row, (rows, 4, 4); a rotation is a unit quaternion (x, y, z, w)."""
    import numpy as np

    x, y, z, w = np.asarray(rotations, dtype=float).T
    matrices = np.zeros((len(rotations), 4, 4))
    turned = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrices[:, :3, :3] = np.transpose(turned, (2, 0, 1)) * np.asarray(scales)[:, None, :]
    matrices[:, :3, 3] = translations
    matrices[:, 3, 3] = 1
    return matrices
