"""Where a node stands: in the file itself, or in the graph that another node is made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple


class File(NamedTuple):
    """An image as a file of MaterialX names it."""

    path: Path
    space: str  #: the name of its colour space
    place: str  #: the element that names it


@dataclass(frozen=True)
class Scope:
    """The graph that a node is made of, which takes its inputs from the node."""

    key: str  #: tells it from others
    node: Any = None
    outer: Scope | None = None  #: where the node stands
    given: Mapping[str, Any] | None = None  #: inputs of a graph that belongs to no node

    def inside(self, node: Any) -> Scope:
        """The graph of a node that stands here."""
        return Scope(f"{self.key}/{node.getNamePath()}", node, self)


FILE = Scope("")  #: of what belongs to no instance of a graph
