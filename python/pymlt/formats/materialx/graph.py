"""The values of nodes, where texture coordinates are given."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ... import _core
from ..limits import NESTING
from .colour_spaces import canonical
from .images import Images, Lookup
from .nodes import NODES
from .scope import FILE, File, Scope
from .units import converted_unit
from .values import COUNTS, checked, full, numbers, path_of

COLOURS = ("color3", "color4")
EXPANDED = 10_000  #: nodes that a value is made of, with those in the graphs of nodes
STEP = 1 / 2048  #: of texture coordinates, on both sides of a point at which a slope is wanted
#: Names of texture coordinates in programs that write MaterialX.
UV_SETS = ("", "st", "st0", "UVMap", "uv", "uv0", "map1", "UV0", "UV", "i_texcoord_0")


@dataclass(frozen=True)
class Use:
    """That a value depends on the texture coordinates: by an image, or by these themselves."""

    coordinates: np.ndarray  #: (height, width, 2), with v upwards
    lookup: Lookup | None = None


class Graph:
    """A document at texture coordinates (height, width, 2), where v points up."""

    def __init__(self, document: Any, images: Images, uv: np.ndarray, *, sloped: bool = False):
        self._document = document
        self._images = images
        self._uv = uv
        self._sloped = sloped  #: whether slopes are made of what is computed here
        self._known: dict[tuple[str, str, str, bool], Any] = {}
        self._depth = 0
        self._conversions = 0
        self._placing = 0  #: images whose coordinates are being computed
        self.uses: list[Use] = []

    def argument(self, node: Any, name: str, scope: Scope = FILE) -> Any:
        """The value of a node's input, which may be its default."""
        given = node.getInput(name)
        declared = definition(node).getActiveInput(name)
        if declared is None:
            raise _core.SceneError(f"{path_of(node)}: the node has no input {name!r}")
        if given is not None and is_set(given):
            return checked(self.value(given, scope), declared.getType(), given)
        if declared.getDefaultGeomPropString():
            return self._geometry(declared.getDefaultGeomPropString(), node)
        return self.constant(declared)

    def value(self, port: Any, scope: Scope) -> Any:
        """What an input or an output is connected to, or its constant."""
        if name := port.getInterfaceName():
            return self._bound(port, name, scope)
        if port.getNodeGraphString():
            return self.value(existing(port.getConnectedOutput(), port), scope)
        if port.getNodeName():
            node = existing(port.getConnectedNode(), port)
            return self.node_value(node, scope, port.getOutputString())
        return self.constant(port)

    def _bound(self, port: Any, name: str, scope: Scope) -> Any:
        """The value of an input of the graph in which a port stands."""
        if scope.given is not None:
            return scope.given[name]
        if scope.outer is not None:
            return self.argument(scope.node, name, scope.outer)
        return self.value(interface(port, name), FILE)

    def node_value(self, node: Any, scope: Scope, output: str = "") -> Any:
        """The value of one of a node's outputs, by default the first."""
        key = (scope.key, node.getNamePath(), output, self._placing > 0)
        if key not in self._known:
            self._depth += 1
            if len(self._known) > EXPANDED:
                raise _core.SceneError(f"{path_of(node)}: is one of more than {EXPANDED} nodes")
            if self._depth > NESTING:
                raise _core.SceneError(
                    f"{path_of(node)}: nodes are connected more than {NESTING} deep, or in a circle"
                )
            self._known[key] = self._computed(node, output, scope)
            self._depth -= 1
        return self._known[key]

    def _computed(self, node: Any, output: str, scope: Scope) -> Any:
        graph = implementation(node)
        if graph is not None:
            return self.value(output_of(graph, output, node), scope.inside(node))

        def given(name: str) -> Any:
            return self.argument(node, name, scope)

        match category := node.getCategory():
            case "image":
                return self._image(node, given)
            case "texcoord":
                return self._geometry("UV0", node)
            case "geompropvalue" if node.getType() == "vector2" and given("geomprop") in UV_SETS:
                return self._geometry("UV0", node)
            case "heighttonormal":
                return self._slopes(node, scope)
            case "convert":
                return full(given("in"), node.getType())
        if category not in NODES:
            raise refused(node)
        with np.errstate(all="ignore"):
            return full(NODES[category](given), node.getType())

    def _image(self, node: Any, given: Any) -> np.ndarray:
        file = given("file")
        self._placing += 1
        coordinates = given("texcoord")
        self._placing -= 1
        lookup = Lookup(
            file, node.getType(), given("uaddressmode"), given("vaddressmode"), given("filtertype")
        )
        self.uses.append(Use(coordinates, lookup))
        pixels = self._images.pixels(lookup, self.linear)
        if pixels is None:
            return given("default")
        return lookup.sampled(pixels, coordinates, given("default"))

    def _slopes(self, node: Any, scope: Scope) -> np.ndarray:
        """Normals (N + 1) / 2 of heights over texture coordinates, by differences of these.

        A sixteenth of the slope is that of the nodes that MaterialX generates for viewers.
        """
        if self._sloped:
            raise _core.SceneError(f"{path_of(node)}: makes slopes of slopes")
        self.argument(node, "in", scope)  # for its uses
        factor = self.argument(node, "scale", scope) / 16
        parts = []
        for axis in np.eye(2):
            ahead, behind = (
                Graph(self._document, self._images, self._uv + sign * STEP * axis, sloped=True)
                for sign in (1, -1)
            )
            rise = ahead.argument(node, "in", scope) - behind.argument(node, "in", scope)
            parts.append(-factor * rise / (2 * STEP))
        normal = np.concatenate([*np.broadcast_arrays(*parts, np.ones(parts[0].shape))], axis=-1)
        unit: np.ndarray = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
        return (unit + 1) / 2

    def _geometry(self, name: str, node: Any) -> np.ndarray:
        if name != "UV0":
            raise refused(node)
        if not self._placing:
            self.uses.append(Use(self._uv))
        return self._uv

    def constant(self, port: Any) -> Any:
        """The value that an input itself holds."""
        kind, text = port.getType(), port.getResolvedValueString()
        if kind == "filename":
            return self._file(port, text)
        if kind not in COUNTS:
            return text
        values = numbers(text, COUNTS[kind], port)
        values = converted_unit(values, port)
        array = np.array(values).reshape(1, 1, -1)
        if kind not in COLOURS:
            return array
        return self.linear(array, port.getActiveColorSpace(), path_of(port))

    def _file(self, port: Any, text: str) -> File:
        if not text:
            raise _core.SceneError(f"{path_of(port)}: names no file")
        folder = Path(port.getActiveSourceUri()).parent
        path = (folder / text.replace("\\", "/")).absolute()
        return File(path, port.getActiveColorSpace(), path_of(port))

    def linear(self, colours: np.ndarray, space: str, place: str) -> np.ndarray:
        """Colours (..., 3 or 4) of a space as linear Rec. 709, by the standard library's graphs.

        Raises SceneError, which names the place, for a space that the library does not know.
        """
        name = canonical(space)
        if not name:
            return colours
        nodes = self._document.getDataLibrary()
        found = nodes.getNodeDef(f"ND_{name}_to_lin_rec709_color3")
        if found is None:
            raise _core.SceneError(f"{place}: the colour space {space!r} is not known")
        self._conversions += 1
        given = {"in": colours[..., :3]}
        scope = Scope(f"conversion-{self._conversions}", given=given)
        linear = self.value(found.getImplementation().getOutputs()[0], scope)
        return np.concatenate([linear, colours[..., 3:]], axis=-1)


def output_of(graph: Any, name: str, node: Any) -> Any:
    """An output of the graph that a node is made of, the first one if no name is given."""
    found = graph.getOutput(name) if name else next(iter(graph.getOutputs()), None)
    if found is None:
        raise _core.SceneError(f"{path_of(node)}: the node has no output {name!r}")
    return found


def existing(found: Any, port: Any) -> Any:
    """What a port is connected to. Raises SceneError if there is nothing."""
    if found is None:
        raise _core.SceneError(f"{path_of(port)}: is connected to what does not exist")
    return found


def is_set(port: Any) -> bool:
    """Whether an input has a value or a connection."""
    attributes = ("value", "nodename", "nodegraph", "interfacename")
    return any(port.getAttribute(name) for name in attributes)


def definition(node: Any) -> Any:
    """What the inputs of a node are; of the most similar node if no one has all that it gives.

    Raises SceneError for a node that nothing defines.
    """
    found = node.getNodeDef()
    if found is not None:
        return found
    names = {given.getName() for given in node.getInputs()}
    similar = [
        candidate
        for candidate in node.getDocument().getMatchingNodeDefs(node.getCategory())
        if candidate.getType() == node.getType()
    ]
    if not similar:
        raise _core.SceneError(
            f"{path_of(node)}: there is no node {node.getCategory()!r} of type {node.getType()!r}"
        )
    return max(
        similar, key=lambda one: len(names & {given.getName() for given in one.getActiveInputs()})
    )


def implementation(node: Any) -> Any:
    """The graph that a node is made of, None if it is made of none."""
    found = definition(node).getImplementation()
    return found if found is not None and found.getCategory() == "nodegraph" else None


def interface(port: Any, name: str) -> Any:
    """An input of the graph in which a port stands."""
    graph = port.getParent()
    while graph is not None and graph.getCategory() != "nodegraph":
        graph = graph.getParent()
    found = graph.getInput(name) if graph is not None else None
    if found is None:
        raise _core.SceneError(f"{path_of(port)}: there is no input {name!r} of a graph around it")
    return found


def refused(node: Any) -> _core.SceneError:
    """An error for a node that is no function of texture coordinates, or not one of ours."""
    return _core.SceneError(
        f"{path_of(node)}: the node {node.getCategory()!r} is not read; read are image, texcoord, "
        f"geompropvalue of texture coordinates, heighttonormal, {', '.join(sorted(NODES))}, and "
        "all that are made of these, such as tiledimage, place2d and checkerboard"
    )
