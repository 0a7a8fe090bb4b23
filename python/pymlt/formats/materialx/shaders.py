"""Shaders of MaterialX, each as the inputs of OpenPBR.

Other shaders become OpenPBR by graphs: that for `standard_surface` is MaterialX's own, those for
`gltf_pbr` and `UsdPreviewSurface` are in translations.mtlx.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ... import _core
from .document import standard_nodes
from .graph import definition, is_set
from .origin import Port, origin
from .scope import FILE
from .values import path_of

OPENPBR = "open_pbr_surface"
#: The graph that makes OpenPBR of a shader, and its inputs for normals of all and of the coat.
SHADERS = {
    OPENPBR: ("", "geometry_normal", "geometry_coat_normal"),
    "standard_surface": ("NG_standard_surface_to_open_pbr_surface", "normal", "coat_normal"),
    "gltf_pbr": ("NG_gltf_pbr_to_open_pbr_surface", "normal", "clearcoat_normal"),
    "UsdPreviewSurface": ("NG_UsdPreviewSurface_to_open_pbr_surface", "normal", "normal"),
}
TANGENTS = {"geometry_tangent", "geometry_coat_tangent"}  #: of OpenPBR, which are not read


@dataclass(frozen=True)
class Shader:
    """A node of the file that shades a surface."""

    node: Any

    @property
    def kind(self) -> str:
        return self.node.getCategory()

    @property
    def graph(self) -> Any:
        """The graph that makes OpenPBR of it, None if it is that."""
        name = SHADERS[self.kind][0]
        return standard_nodes().getNodeGraph(name) if name else None

    def port(self, name: str) -> Port | None:
        """What gives an input of OpenPBR its value; None where that is the default."""
        if self.graph is not None:
            output = self.graph.getOutput(f"{name}_out")
            return None if output is None else (output, FILE.inside(self.node))
        return self.given(name)

    def given(self, name: str) -> Port | None:
        """An input of the shader itself, if the file gives it."""
        given = self.node.getInput(name)
        return (given, FILE) if given is not None and is_set(given) else None

    @property
    def normal(self) -> Port | None:
        """The normals that the file gives."""
        return self.given(SHADERS[self.kind][1])

    @property
    def coat_has_its_own_normals(self) -> bool:
        """Whether the file does not give the coat those that it gives all."""
        all_of_it, coat = (self.node.getInput(name) for name in SHADERS[self.kind][1:])
        links = ("nodename", "nodegraph", "output")
        return coat is None or any(
            coat.getAttribute(link) != all_of_it.getAttribute(link) for link in links
        )

    def left_out(self) -> list[str]:
        """The names of inputs that the file gives and that do not become any of OpenPBR."""
        known = self._read() | {SHADERS[self.kind][1]}
        if self.normal is not None and not self.coat_has_its_own_normals:
            known.add(SHADERS[self.kind][2])
        return [
            given.getName()
            for given in self.node.getInputs()
            if is_set(given) and given.getName() not in known and not self._is_default(given)
        ]

    def _read(self) -> set[str]:
        if self.graph is None:
            defined = {given.getName() for given in definition(self.node).getActiveInputs()}
            return defined - TANGENTS - {SHADERS[OPENPBR][2]}
        inner = [given for node in self.graph.getNodes() for given in node.getInputs()]
        return {given.getInterfaceName() for given in inner}

    def _is_default(self, given: Any) -> bool:
        """Whether an input says nothing: its default, or the surface's own normals or tangents."""
        node = origin((given, FILE), lambda *_: None)
        if node is not None:
            return node[0].getCategory() in ("normal", "tangent")
        declared = definition(self.node).getActiveInput(given.getName())
        return declared is not None and given.getValue() == declared.getValue()


def shader_of(material: Any) -> Shader:
    """The shader of a `surfacematerial`. Raises SceneError for one that is not read."""
    given = material.getInput("surfaceshader")
    port = given.getConnectedOutput() if given is not None and given.getNodeGraphString() else given
    node = port.getConnectedNode() if port is not None else None
    if node is None:
        raise _core.SceneError(f"{path_of(material)}: the material has no surface shader")
    if node.getCategory() not in SHADERS:
        raise _core.SceneError(
            f"{path_of(node)}: the shader {node.getCategory()!r} is not read; read are "
            f"{', '.join(SHADERS)}"
        )
    return Shader(node)
