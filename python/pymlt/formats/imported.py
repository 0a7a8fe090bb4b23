"""A scene while it is read: the dict so far, and what has no counterpart."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

from .. import _core
from . import limits
from .ply import Mesh

LONGEST = 100  #: characters of a name, which may become that of a file


@dataclass
class Imported:
    """What a reader has made of a file."""

    scene: dict[str, Any] = field(default_factory=lambda: {"type": "scene"})
    _names: dict[str, int] = field(default_factory=dict)  #: and how often each was wanted
    _warned: dict[str, str] = field(default_factory=dict)  #: what was said, and of which place
    _memory: int = 0
    place: str = ""  #: file:line of what is being read, if the format has lines
    places: dict[str, str] = field(default_factory=dict)  #: of plug-ins, by name
    missing: dict[str, str] = field(default_factory=dict)  #: that a file is, and where it is named

    def warn(self, text: str, place: str = "") -> None:
        """Names something that has no counterpart, once: where (as file:line) it is met first."""
        self._warned.setdefault(text, place)

    @property
    def warnings(self) -> list[str]:
        """What was said, without the places."""
        return list(self._warned)

    def placed_warnings(self, source: str) -> list[str]:
        """What was said, after its file and line, or after `source` where no line is known."""
        return [f"{place or source}: {text}" for text, place in self._warned.items()]

    def name(self, wanted: str) -> str:
        """A name in which XML and file names have no special signs, and that nothing else has."""
        plain = re.sub(r"[^A-Za-z0-9_-]+", "_", wanted[:LONGEST]).strip("_") or "unnamed"
        found, i = plain, self._names.get(plain, 0)
        while found in self._names:
            i += 1
            found = f"{plain}_{i}"
        self._names[plain] = max(i, 1)
        self._names.setdefault(found, 1)
        self.note(found)
        return found

    def note(self, name: str) -> None:
        """What has this name stands where the reader is."""
        if self.place:
            self.places[name] = self.place

    def placed_error(self, error: _core.Error, source: str) -> _core.Error:
        """One about the scene dict, such as "scene['sphere']: ...", as one about the file."""
        text = str(error)
        where = re.match(r"scene((?:\['[^']*'\])+): ", text)
        names = re.findall(r"\['([^']*)'\]", where[1]) if where else []
        places = [self.places[name] for name in reversed(names) if self.places.get(name)]
        return type(error)(f"{places[0]}: {text[where.end() :]}" if places else f"{source}: {text}")

    def add(self, wanted: str, plugin: dict[str, Any]) -> str:
        """Adds a plug-in to the scene; returns its id."""
        name = self.name(wanted)
        self.charge(plugin)
        # No negative zeros, so that XML says the same.
        self.scene[name] = {k: v + 0.0 if is_matrix(v) else v for k, v in plugin.items()}
        return name

    def charge(self, plugin: dict[str, Any]) -> None:
        """Counts what a plug-in takes. Raises SceneError if that is too much with all others."""
        self._memory += limits.measured(plugin)
        if self._memory > limits.MEMORY:
            raise _core.SceneError(f"the scene takes more than {limits.MEMORY} bytes of memory")

    def mesh(self, wanted: str, mesh: Mesh) -> dict[str, Any]:
        """A shape of arrays. Raises SceneError for indices without a vertex."""
        faces, count = mesh.triangles, len(mesh.positions)
        if faces.size and not 0 <= faces.min() <= faces.max() < count:
            raise _core.SceneError(f"{wanted}: a triangle has a vertex that does not exist")
        shape = {"type": "mesh", "vertices": mesh.positions, "faces": faces}
        optional = {"normals": mesh.normals, "uv": mesh.uvs, "vertex_color": mesh.colours}
        return shape | {key: given for key, given in optional.items() if given is not None}


def is_matrix(value: Any) -> bool:
    return getattr(value, "shape", None) == (4, 4)


def rgb(values: Any) -> dict[str, Any]:
    """A linear Rec. 709 colour for a scene dict."""
    return {"type": "rgb", "value": [float(v) for v in values]}
