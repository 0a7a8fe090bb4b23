"""Which reader a file needs, and scenes of other programs as scenes of ours."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from .. import _core
from ..scenes.arrays import with_bytes
from ..scenes.kinds import EXTENSIONS, MESHES, USD, check_kind, is_foreign
from ..scenes.loading import load_dict
from . import limits

if TYPE_CHECKING:
    from .imported import Imported


def read_foreign(path: str | os.PathLike[str]) -> Imported:
    """A scene of another program, with its meshes and images as arrays."""
    import numpy as np

    from .imported import Imported
    from .missing import refuse_missing

    source = Path(os.fspath(path))
    made = Imported()
    try:
        with np.errstate(over="raise", divide="raise", invalid="raise"):
            reader_of(source)(source, made)
    except _core.Error:
        refuse_missing(made, source)  # other errors may be due to that
        raise
    except limits.CONTRADICTIONS as error:
        kind = type(error).__name__
        raise _core.SceneError(f"{source}: contradicts itself: {kind}: {error!s:.200}") from None
    refuse_missing(made, source)
    return made


def reader_of(path: Path) -> Callable[[Path, Imported], None]:
    """The reader for files of this extension."""
    if path.suffix.lower() == ".pbrt":
        from .pbrt import read_pbrt

        return read_pbrt
    if path.name.lower().endswith(MESHES):
        from .mesh_file import read_mesh

        return read_mesh
    if path.name.lower().endswith(USD):
        from .usd import read_usd

        return read_usd
    from .gltf import read_gltf

    return read_gltf


def load_foreign(
    path: str | os.PathLike[str],
    size: tuple[int, int] | None = None,
    sensor: int | None = None,
    filter: str = "",
) -> tuple[_core.Scene, list[str]]:
    """The Scene of a file of another program, and what of it has no counterpart."""
    made = read_foreign(path)
    # A checkpoint knows the scene by this name.
    name = os.path.abspath(path)
    try:
        scene = _core.load_dict(with_bytes(made.scene), size, sensor, filter, name, {})
    except (_core.SceneError, _core.FileError) as error:
        raise made.placed_error(error, os.fspath(path)) from None
    return scene, made.placed_warnings(os.fspath(path))


def convert(path: str | os.PathLike[str] | dict, output: str | os.PathLike[str]) -> list[str]:
    """Write a scene as Mitsuba XML.

    `path` names a scene of another program (.gltf, .glb, .pbrt, .usd) or a mesh (.ply, .obj,
    .stl), or is a scene dict. Its meshes (.ply) and images are written beside `output`, with names
    that begin as its own does. Returns what has no counterpart, one line each. Raises FileError for
    files that cannot be read or written, SceneError for what is wrong in them, UsageError for
    another extension or without the extra that reading needs.
    """
    from .written import Written
    from .xml_writer import to_xml

    target = Path(os.fspath(output))
    if not isinstance(path, dict) and not is_foreign(path):
        check_kind(path)
        raise _core.UsageError(
            f"{os.fspath(path)}: cannot be converted; valid are: {', '.join(EXTENSIONS)}"
        )
    if target.suffix.lower() != ".xml":
        raise _core.UsageError(f"{target}: a scene is written as .xml")
    _core.check_file_writable(str(target))
    made = described(path) if isinstance(path, dict) else read_foreign(path)
    scene = Written(target.parent, target.stem).scene(made.scene)
    target.write_text(to_xml(scene, target.parent), encoding="utf-8")
    return [] if isinstance(path, dict) else made.placed_warnings(os.fspath(path))


def described(scene: dict) -> Imported:
    """A scene dict, which `load_dict` has accepted. Raises SceneError if it does not."""
    from .imported import Imported
    from .plain import plain

    load_dict(scene)
    return Imported(plain(scene))


def warn_all(texts: list[str]) -> None:
    """As warnings of Python."""
    for text in texts:
        warnings.warn(text, stacklevel=3)
