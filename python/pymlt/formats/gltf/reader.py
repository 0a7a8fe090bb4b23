"""A glTF file as a scene dict: its nodes with their meshes, cameras and lights."""

from __future__ import annotations

import json
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ... import _core
from ..._extras import import_extra
from ..imported import Imported
from ..limits import TEXT, read_file
from ..views import complete
from .buffers import Buffers
from .checked import at, check_types, warn_of_others
from .compression import COMPRESSIONS, check_uncompressed, refuse_required
from .deformation import joint_matrices, morphed, skinned
from .glow import too_dim
from .lights import light, sensor
from .materials import KNOWN as MATERIALS
from .materials import bsdf, emission, interior, is_unlit
from .meshes import triangle_mesh
from .placement import INSTANCING, instances, local_matrix
from .textures import Textures
from .uv_transform import UV_TRANSFORM

if TYPE_CHECKING:
    import numpy as np

    from ..ply import Mesh

LIGHTS = "KHR_lights_punctual"
NODES = {LIGHTS, INSTANCING}
EXTENSIONS = MATERIALS | NODES | {"KHR_mesh_quantization", UV_TRANSFORM}


def read_gltf(path: Path, made: Imported) -> None:
    """Adds what a .gltf or .glb file holds to a scene.

    Raises FileError for files that cannot be read, SceneError for what is wrong in them or needs an
    extension of glTF that is not known here, UsageError without the extra `gltf`.
    """
    pygltflib = import_extra("pygltflib", "gltf", "reading glTF")
    binary = path.suffix.lower() == ".glb"
    content = read_file(path) if binary else read_file(path, TEXT)
    try:
        gltf = parse(pygltflib, content, binary)
    except json.JSONDecodeError as error:
        raise _core.SceneError(
            f"{path}:{error.lineno}: this is no glTF 2.0 file: {error.msg}"
        ) from None
    except Exception as error:  # pygltflib has no errors of its own
        raise _core.SceneError(f"{path}: this is no glTF 2.0 file: {error!s:.200}") from None
    if gltf is None or not str(getattr(gltf.asset, "version", "")).startswith("2"):
        raise _core.SceneError(f"{path}: this is no glTF 2.0 file")
    buffers = Buffers(gltf, path)
    try:
        refuse_required(set(gltf.extensionsRequired or []) - EXTENSIONS)
        Reader(buffers, made).read()
    except (_core.SceneError, _core.FileError) as error:
        if isinstance(error, _core.FileError):
            made.missing |= dict.fromkeys(buffers.missing(), "")
        raise type(error)(f"{path}: {error}") from None


def parse(library: Any, content: bytes, binary: bool) -> Any:
    """The file as pygltflib has it, which takes texts for numbers and warns of much."""

    class Checked(library.GLTF2):  # type: ignore[misc]
        @classmethod
        def from_json(cls, text: str, **options: Any) -> Any:
            given = json.loads(text)
            check_types(given, library.GLTF2, "glTF")
            read = super().from_json(text, **options)
            for index, node in enumerate(given.get("nodes") or []):
                weights = node.get("weights")  # which pygltflib leaves out
                check_types(weights, list[float], f"glTF.nodes[{index}].weights")
                read.nodes[index].weights = weights
            return read

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        if binary:
            return Checked.load_from_bytes(content)
        return Checked.gltf_from_json(content.decode("utf-8-sig"))


class Reader:
    """One file while it is read."""

    def __init__(self, buffers: Buffers, made: Imported):
        self._gltf = buffers.gltf
        self._made = made
        self._buffers = buffers
        self._textures = Textures(self._buffers, made)
        self._materials: dict[tuple[int, bool], str] = {}
        self._lights: dict[tuple[int, bool], dict[str, Any]] = {}
        self._places: dict[int, np.ndarray] = {}  #: of nodes in the world, in their order
        self._meshes: dict[tuple[Any, ...], dict[str, Any]] = {}

    def read(self) -> None:
        gltf = self._gltf
        warn_of_others(gltf.extensionsUsed, EXTENSIONS | COMPRESSIONS, self._made)
        if gltf.animations:
            self._made.warn(
                "animations are left out: nodes, skins and morph targets have the pose that "
                "they have without them"
            )
        self._place_nodes()
        for index, to_world in self._places.items():
            node = gltf.nodes[index]
            self._node(node, node.name or f"node-{index}", to_world)
        complete(self._made, dim=too_dim(self._made.scene, self._unlit()))

    def _place_nodes(self) -> None:
        import numpy as np

        # Of those that are still to be read, the next one is the last.
        left = [(root, np.eye(4)) for root in reversed(self._roots())]
        while left:
            index, parent = left.pop()
            node = at(self._gltf.nodes, index, "node")
            if index in self._places:
                raise _core.SceneError(
                    f"node {index} has two parents or is below itself; nodes should form trees"
                )
            self._places[index] = to_world = parent @ local_matrix(node)
            left += [(child, to_world) for child in reversed(node.children or [])]

    def _roots(self) -> list[int]:
        """Those of the scene that is shown, else of all nodes."""
        gltf = self._gltf
        if gltf.scenes:
            return at(gltf.scenes, gltf.scene or 0, "scene").nodes or []
        inner = {child for node in gltf.nodes for child in node.children or []}
        return [index for index in range(len(gltf.nodes)) if index not in inner]

    def _node(self, node: Any, name: str, to_world: np.ndarray) -> None:
        warn_of_others(node.extensions, NODES, self._made)
        if node.mesh is not None:
            self._meshes_of(node, name, to_world)
        if node.camera is not None:
            camera = at(self._gltf.cameras, node.camera, "camera")
            self._made.add(camera.name or name, sensor(camera, to_world))
        punctual = (node.extensions or {}).get(LIGHTS)
        if punctual is not None:
            lights = self._gltf.extensions[LIGHTS]["lights"]
            given = at(lights, punctual["light"], "light")
            self._made.add(given.get("name") or name, light(given, to_world, self._made))

    def _meshes_of(self, node: Any, name: str, to_world: np.ndarray) -> None:
        """Adds the mesh of a node, or its copies: as instances unless they emit or are filled.

        A skin places its mesh in the world, wherever the node is.
        """
        import numpy as np

        shapes = self._shapes(node)
        if node.skin is not None:
            to_world = np.eye(4)
        copies = instances(node, self._buffers, self._made)
        if copies is not None and len(copies) > 1:
            members = [shape for shape in shapes if not {"emitter", "interior"} & shape.keys()]
            shapes = [shape for shape in shapes if {"emitter", "interior"} & shape.keys()]
            if members:
                group = {f"part-{number}": shape for number, shape in enumerate(members)}
                known = self._made.add(f"{name}-group", {"type": "shapegroup", **group})
                shapes.append({"type": "instance", "group": {"type": "ref", "id": known}})
        for placed in [to_world] if copies is None else to_world @ copies:
            for shape in shapes:
                self._made.add(name, shape | {"to_world": placed})

    def _shapes(self, node: Any) -> list[dict[str, Any]]:
        """The primitives of a node's mesh in its own frame, or in the world if it has a skin."""
        mesh = at(self._gltf.meshes, node.mesh, "mesh")
        weights = tuple(node.weights or mesh.weights or ())
        shapes = []
        for number, primitive in enumerate(mesh.primitives):
            warn_of_others(primitive.extensions, COMPRESSIONS, self._made)
            key = (node.mesh, number, node.skin, weights)
            if key not in self._meshes:
                triangles = self._triangles(primitive, node.skin, weights)
                if triangles is None:
                    continue
                wanted = mesh.name or f"mesh-{node.mesh}"
                self._meshes[key] = self._made.mesh(wanted, triangles)
            shape = self._meshes[key] | {"bsdf": self._bsdf(primitive)}
            if primitive.material is not None:
                shape |= self._light_of(primitive)
            shapes.append(shape)
        return shapes

    def _triangles(
        self, primitive: Any, skin: int | None, weights: tuple[float, ...]
    ) -> Mesh | None:
        """A primitive as its morph targets and its skin deform it; None if it has no triangles."""
        check_uncompressed(primitive, self._gltf)
        mesh = triangle_mesh(primitive, self._buffers, self._made)
        if mesh is not None and primitive.targets:
            mesh = morphed(mesh, primitive.targets, weights, self._buffers, self._made)
        if mesh is not None and skin is not None:
            given = at(self._gltf.skins, skin, "skin")
            joints = joint_matrices(given, self._places, self._buffers)
            mesh = skinned(mesh, primitive.attributes, joints, self._buffers)
        return mesh

    def _light_of(self, primitive: Any) -> dict[str, Any]:
        """What a shape emits and what is in it, the same for all shapes of one material."""
        key = material, coloured = material_key(primitive)
        if key not in self._lights:
            given = self._material(material)
            glow = emission(given, self._textures, self._made, of_vertices=coloured)
            parts = {"emitter": glow, "interior": interior(given)}
            self._lights[key] = {name: part for name, part in parts.items() if part}
        return self._lights[key]

    def _unlit(self) -> list[dict[str, Any]]:
        """The emitters of unlit materials."""
        used = self._lights.items()
        return [parts["emitter"] for (index, _), parts in used if is_unlit(self._material(index))]

    def _material(self, index: int) -> Any:
        return at(self._gltf.materials, index, "material")

    def _bsdf(self, primitive: Any) -> dict[str, Any]:
        """A reference to the material, which is added with its first use."""
        key = index, coloured = material_key(primitive)
        if index is None:
            white = self._textures.colour(None, [1, 1, 1], of_vertices=coloured)
            return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": white}}
        if key not in self._materials:
            material = self._material(index)
            surface = bsdf(material, self._textures, self._made, of_vertices=coloured)
            self._materials[key] = self._made.add(material.name or f"material-{index}", surface)
        return {"type": "ref", "id": self._materials[key]}


def material_key(primitive: Any) -> tuple[Any, bool]:
    """The index of its material, None without one, and whether its vertices have colours."""
    return primitive.material, primitive.attributes.COLOR_0 is not None
