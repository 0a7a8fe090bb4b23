"""Networks of MaterialX in a stage, copied into a document that is then read as a .mtlx file is.

So `standard_surface` and `gltf_pbr` become OpenPBR by the graphs for that, and nodes are computed.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from pxr import Ar

from ... import _core
from ..imported import Imported
from ..materialx.document import library, standard_nodes
from ..materialx.materials import Materials
from ..materialx.shaders import Shader
from .assets import asset
from .networks import Node
from .surface import Surface
from .textures import Textures

#: Nodes that MaterialX 1.39 knows by other names than 1.38.
RENAMED = {"ND_normalmap": "ND_normalmap_float"}
UV = "st"  #: the name of texture coordinates in a copy, whatever a stage calls them


def materialx_surface(textures: Textures, made: Imported) -> Surface | None:
    """What a shader of MaterialX says; None, with a warning, if it cannot be read."""
    kind = textures.node.id
    try:
        network = Network(textures, made)
        shader = Shader(network.copied())
        parts = Materials(network.document, made, network.contents).parts(shader)
    except _core.UsageError as error:  # without the package
        made.warn(f"materials made of {kind!r} are left out: {error}")
        return None
    except _core.SceneError as error:
        made.warn(f"a material made of {kind!r} is left out: {error}")
        return None
    bsdf, normals = parts["bsdf"], None
    if bsdf["type"] == "normalmap":
        bsdf, normals = bsdf["bsdf"], bsdf["normalmap"]
    opacity = bsdf.pop("geometry_opacity", 1.0)
    return Surface(bsdf, opacity, normals, parts.get("emitter", {}).get("radiance"))


class Network:
    """A copy of what a shader is connected to.

    Raises UsageError without the extra `materialx`.
    """

    def __init__(self, textures: Textures, made: Imported):
        self.document = library().createDocument()
        self.document.setDataLibrary(standard_nodes())
        self.contents: dict[str, bytes] = {}  #: files that are within a package, by their paths
        self._textures = textures
        self._made = made
        self._copies: dict[Any, Any] = {}
        self._left: list[Node] = []

    def copied(self) -> Any:
        """The shader in the document, with all that it needs."""
        shader = self._copy(self._textures.node)
        while self._left:
            node = self._left.pop()
            for given in node.shader.GetInputs():
                self._copy_input(node, given.GetBaseName())
        return shader

    def _copy(self, node: Node) -> Any:
        """A node, once; None, with a warning, if MaterialX has none of its kind."""
        path = node.shader.GetPath()
        if path not in self._copies:
            defined = standard_nodes().getNodeDef(RENAMED.get(node.id, node.id))
            if defined is None:
                self._made.warn(f"shaders of the kind {node.id!r} are left out")
                self._copies[path] = None
            else:
                name = library().createValidName(str(path).lstrip("/"))
                name = self.document.createValidChildName(name)
                self._copies[path] = self.document.addNodeInstance(defined, name)
                self._left.append(node)
        return self._copies[path]

    def _copy_input(self, node: Node, name: str) -> None:
        copy = self._copy(node)
        declared = copy.getNodeDef().getActiveInput(name)
        source = node.source(name)
        if declared is None:
            self._made.warn(f"{name!r} of {node.id!r} is left out")
        elif source is not None:
            origin = self._copy(source)
            if origin is not None:
                made = copy.addInput(name, declared.getType())
                made.setNodeName(origin.getName())
                if len(origin.getNodeDef().getActiveOutputs()) > 1:
                    made.setOutputString(source.output)
        else:
            self._copy_value(node, declared, copy)

    def _copy_value(self, node: Node, declared: Any, copy: Any) -> None:
        name, kind = declared.getName(), declared.getType()
        attribute, value = node.attribute(name), node.value(name, None)
        if attribute is None or value is None:
            return
        text = self._file(attribute, node) if kind == "filename" else text_of(value)
        if name == "geomprop" and copy.getType() == "vector2":
            self._textures.take_uv(text)
            text = UV
        if text:
            made = copy.addInput(name, kind)
            made.setValueString(text)
            if attribute.HasColorSpace():
                made.setColorSpace(attribute.GetColorSpace())

    def _file(self, attribute: Any, node: Node) -> str:
        """The path of a file; one within a package is read."""
        found = asset(attribute, node.time, self._made) or {}
        if "data" not in found:
            return str(found.get("filename", ""))
        given = attribute.Get(node.time)
        package, inner = Ar.SplitPackageRelativePathOuter(given.resolvedPath)
        path = str(Path(package, inner).absolute())
        self.contents[path] = found["data"]
        return path


def text_of(value: Any) -> str:
    """A value as MaterialX writes it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str | int):
        return str(value)
    return ", ".join(repr(float(number)) for number in np.ravel(np.array(value)))
