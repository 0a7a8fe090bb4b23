"""A mesh that lies in a file of its own, as a scene: with a material, light and a camera."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .imported import Imported
from .stl import read_stl
from .views import overview

MATERIAL = {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": 0.6}}
# An even light, and one over the left shoulder of the camera, which shows the form.
LIGHTS: dict[str, dict[str, Any]] = {
    "sky": {"type": "constant", "radiance": 0.15},
    "sun": {"type": "directional", "direction": [1.0, -1.5, -1.2], "irradiance": 3.0},
}


def read_mesh(path: Path, made: Imported) -> None:
    """Reads a file of MESHES, in which y is up. Raises FileError and SceneError."""
    if path.suffix.lower() == ".stl":
        shape = made.mesh("mesh", read_stl(path))
    else:
        kind = path.name.lower().removesuffix(".gz")[-3:]
        shape = {"type": kind, "filename": str(path.absolute())}
    made.add("mesh", shape | {"bsdf": MATERIAL})
    for name, light in LIGHTS.items():
        made.add(name, light)
    made.add("camera", overview(made.scene))
