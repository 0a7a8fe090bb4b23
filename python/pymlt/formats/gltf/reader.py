"""A glTF file as a scene dict: its nodes with their meshes, cameras and lights."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ... import _core
from ..._extras import import_extra
from ..imported import Imported
from ..views import complete
from .buffers import Buffers
from .lights import light, sensor
from .materials import KNOWN as MATERIALS
from .materials import bsdf, emission
from .meshes import triangle_mesh
from .textures import Textures

if TYPE_CHECKING:
    import numpy as np

EXTENSIONS = MATERIALS | {"KHR_lights_punctual", "KHR_mesh_quantization"}


def read_gltf(path: Path, made: Imported) -> None:
    """Adds what a .gltf or .glb file holds to a scene.

    Raises FileError for files that cannot be read, SceneError for what is wrong in them or needs an
    extension of glTF that is not known here, UsageError without the extra `gltf`.
    """
    pygltflib = import_extra("pygltflib", "gltf", "reading glTF")
    try:
        path.open("rb").close()
    except OSError as error:
        raise _core.FileError(f"{path}: cannot be read: {error.strerror}") from None
    try:
        gltf = pygltflib.GLTF2().load(str(path))
    except Exception as error:  # pygltflib has no errors of its own
        raise _core.SceneError(f"{path}: this is no glTF 2.0 file: {error}") from None
    if gltf is None or not str(gltf.asset.version).startswith("2"):
        raise _core.SceneError(f"{path}: this is no glTF 2.0 file")
    if unknown := sorted(set(gltf.extensionsRequired or []) - EXTENSIONS):
        raise _core.SceneError(f"{path}: needs {', '.join(unknown)}, which is not supported")
    try:
        Reader(gltf, path, made).read()
    except _core.Error:
        raise
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise _core.SceneError(f"{path}: the file contradicts itself: {error!r}") from None


class Reader:
    """One file while it is read."""

    def __init__(self, gltf: Any, path: Path, made: Imported):
        self._gltf = gltf
        self._made = made
        self._buffers = Buffers(gltf, path)
        self._textures = Textures(self._buffers, made)
        self._materials: dict[int, str] = {}
        self._meshes: dict[tuple[int, int], dict[str, Any]] = {}

    def read(self) -> None:
        gltf = self._gltf
        for what in ("animations", "skins"):
            if getattr(gltf, what):
                self._made.warn(f"{what} are left out")
        scene = gltf.scenes[gltf.scene or 0] if gltf.scenes else None
        roots = scene.nodes if scene else range(len(gltf.nodes))
        import numpy as np

        for root in roots or []:
            self._node(root, np.eye(4), 0)
        complete(self._made)

    def _node(self, index: int, parent: np.ndarray, depth: int) -> None:
        node = self._gltf.nodes[index]
        if depth > len(self._gltf.nodes):
            raise _core.SceneError("a node is below itself")
        to_world = parent @ local_matrix(node)
        name = node.name or f"node-{index}"
        if node.mesh is not None:
            self._mesh(node.mesh, name, to_world)
        if node.camera is not None:
            camera = self._gltf.cameras[node.camera]
            self._made.add(camera.name or name, sensor(camera, to_world))
        punctual = (node.extensions or {}).get("KHR_lights_punctual")
        if punctual is not None:
            given = self._gltf.extensions["KHR_lights_punctual"]["lights"][punctual["light"]]
            self._made.add(given.get("name") or name, light(given, to_world, self._made))
        for child in node.children or []:
            self._node(child, to_world, depth + 1)

    def _mesh(self, index: int, name: str, to_world: np.ndarray) -> None:
        mesh = self._gltf.meshes[index]
        for number, primitive in enumerate(mesh.primitives):
            if primitive.targets:
                self._made.warn("morph targets are left out")
            key = (index, number)
            if key not in self._meshes:
                triangles = triangle_mesh(primitive, self._buffers, self._made)
                if triangles is None:
                    continue
                wanted = mesh.name or f"mesh-{index}"
                self._meshes[key] = self._made.mesh(wanted, triangles)
            shape = self._meshes[key] | {"to_world": to_world, "bsdf": self._bsdf(primitive)}
            if primitive.material is not None:
                glow = emission(self._gltf.materials[primitive.material], self._textures)
                if glow:
                    shape["emitter"] = glow
            self._made.add(name, shape)

    def _bsdf(self, primitive: Any) -> dict[str, Any]:
        """A reference to the material, which is added with its first use."""
        if primitive.material is None:
            return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": 1.0}}
        index = primitive.material
        if index not in self._materials:
            material = self._gltf.materials[index]
            surface = bsdf(material, self._textures, self._made)
            self._materials[index] = self._made.add(material.name or f"material-{index}", surface)
        return {"type": "ref", "id": self._materials[index]}


def local_matrix(node: Any) -> np.ndarray:
    """glTF 2.0, sec. 3.5.3: a matrix by columns, or T R S with a quaternion (x, y, z, w)."""
    import numpy as np

    if node.matrix:
        return np.array(node.matrix, dtype=float).reshape(4, 4).T
    x, y, z, w = node.rotation or (0, 0, 0, 1)
    matrix = np.eye(4)
    matrix[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    matrix[:3, :3] *= np.array(node.scale or (1, 1, 1))
    matrix[:3, 3] = node.translation or (0, 0, 0)
    return matrix
