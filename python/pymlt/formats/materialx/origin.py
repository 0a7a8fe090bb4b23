"""Where a value comes from, through the nodes and graphs that hand it on as it is."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ... import _core
from .graph import existing, implementation, interface, is_set, output_of
from .scope import FILE, Scope
from .values import path_of

Port = tuple[Any, Scope]  #: an input or an output, and where it stands
Node = tuple[Any, Scope]

LINKS = 1000  #: from a value to the node that makes it; more go round

#: The numbers of a node's input, None if they are not the same everywhere.
Factor = Callable[[Any, str, Scope], list[float] | None]


def origin(port: Port | None, factor: Factor) -> Node | None:
    """The node that makes a value, None if that is a constant.

    Raises SceneError for links that go on without end.
    """
    node, links = None, 0
    while port is not None:
        links += 1
        if links > LINKS:
            raise _core.SceneError(f"{path_of(port[0])}: is connected in a circle")
        node, port = step(*port, factor)
    return node


def step(port: Any, scope: Scope, factor: Factor) -> tuple[Node | None, Port | None]:
    """Either the node that makes a value, or the port that it comes from, one link further."""
    if name := port.getInterfaceName():
        if scope.outer is None:
            return None, (interface(port, name), FILE)
        given = scope.node.getInput(name)
        return None, (given, scope.outer) if given is not None and is_set(given) else None
    if port.getNodeGraphString():
        return None, (existing(port.getConnectedOutput(), port), scope)
    if not port.getNodeName():
        return None, None
    node = existing(port.getConnectedNode(), port)
    if (graph := implementation(node)) is not None:
        output = output_of(graph, port.getOutputString(), node)
        return None, (output, scope.inside(node))
    unchanged = handed_on(node, scope, factor)
    if unchanged is not None and is_set(unchanged):
        return None, (unchanged, scope)
    return (node, scope), None


def handed_on(node: Any, scope: Scope, factor: Factor) -> Any:
    """The input whose value a node has as its own, if there is one."""
    match node.getCategory():
        case "dot":
            return node.getInput("in")
        case "multiply":
            for name, other in (("in1", "in2"), ("in2", "in1")):
                if set(factor(node, other, scope) or ()) == {1.0}:
                    return node.getInput(name)
    return None
