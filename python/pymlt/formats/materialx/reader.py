"""A file of MaterialX: its materials alone, or on balls as a scene."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ... import _core
from ..imported import Imported
from ..missing import ABSENT, files_of, is_missing
from .document import read_document
from .materials import Materials
from .preview import preview


def read_materialx(path: Path, made: Imported) -> None:
    """Adds the materials of a file to a scene, each on a ball, with a floor, light and a camera.

    Raises FileError for files that cannot be read, SceneError for what is wrong in them or is not
    read, UsageError without the extra `materialx`.
    """
    preview(read_materials(path, made), made)


def read_materials(path: Path, made: Imported) -> dict[str, dict[str, Any]]:
    """The parts of shapes, a `bsdf` and perhaps an `emitter`, by the names of the materials."""
    document = read_document(path)
    materials = Materials(document, made)
    try:
        found = materials.read()
        files = files_of(found, {})
        made.missing |= {f"{name}: {ABSENT}": "" for name, _ in files if is_missing(name)}
        return found
    except (_core.SceneError, _core.FileError) as error:
        raise type(error)(f"{path}: {error}") from None
    finally:
        made.missing |= dict.fromkeys(materials.textures.images.missing, "")
