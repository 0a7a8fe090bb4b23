"""A mesh that lies in a file of its own, as a scene: with a material, light and a camera."""

from __future__ import annotations

from pathlib import Path

from .imported import Imported
from .stl import read_stl
from .views import complete

MATERIAL = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": 0.6}}


def read_mesh(path: Path, made: Imported) -> None:
    """Reads a file of MESHES, in which y is up. Raises FileError and SceneError."""
    if path.suffix.lower() == ".stl":
        shape = made.mesh("mesh", read_stl(path))
    else:
        kind = path.name.lower().removesuffix(".gz")[-3:]
        shape = {"type": kind, "filename": str(path.absolute())}
    made.add("mesh", shape | {"bsdf": MATERIAL})
    complete(made, announced=False)
