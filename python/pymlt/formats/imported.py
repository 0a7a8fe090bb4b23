"""A scene while it is read: the dict so far, its files, and what has no counterpart."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .ply import Mesh, write_ply


@dataclass
class Imported:
    """What a reader has made of a file."""

    folder: Path  #: where meshes and images are written
    stem: str  #: with which their names begin
    scene: dict[str, Any] = field(default_factory=lambda: {"type": "scene"})
    warnings: list[str] = field(default_factory=list)
    _names: set[str] = field(default_factory=set)

    def warn(self, text: str) -> None:
        """Names something that has no counterpart, once."""
        if text not in self.warnings:
            self.warnings.append(text)

    def name(self, wanted: str) -> str:
        """A name in which XML and file names have no special signs, and that nothing else has."""
        plain = re.sub(r"[^A-Za-z0-9_-]+", "_", wanted).strip("_") or "unnamed"
        found, i = plain, 1
        while found in self._names:
            i += 1
            found = f"{plain}_{i}"
        self._names.add(found)
        return found

    def add(self, wanted: str, plugin: dict[str, Any]) -> str:
        """Adds a plug-in to the scene; returns its id."""
        name = self.name(wanted)
        # No negative zeros, so that XML says the same.
        self.scene[name] = {k: v + 0.0 if hasattr(v, "shape") else v for k, v in plugin.items()}
        return name

    def file(self, name: str) -> Path:
        """Where a file of the scene is to be written."""
        return self.folder / f"{self.stem}-{name}"

    def mesh(self, wanted: str, mesh: Mesh) -> dict[str, Any]:
        """A shape; its file is written."""
        path = self.file(f"{self.name(f'{wanted}-mesh')}.ply")
        write_ply(path, mesh)
        return {"type": "ply", "filename": str(path)}


def rgb(values: Any) -> dict[str, Any]:
    """A linear Rec. 709 colour for a scene dict."""
    return {"type": "rgb", "value": [float(v) for v in values]}
