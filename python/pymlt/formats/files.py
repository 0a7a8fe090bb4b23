"""Which reader a file needs, and scenes of other programs as scenes of ours."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import _core
from ..scenes.arrays import with_bytes
from ..scenes.kinds import EXTENSIONS, MESHES, USD, check_kind, is_foreign
from ..scenes.loading import load_dict
from . import limits

if TYPE_CHECKING:
    from .imported import Imported


def read_foreign(path: str | os.PathLike[str]) -> Imported:
    """A scene of another program, with its meshes and images as arrays."""
    from .imported import Imported
    from .solids import give_priorities

    made = Imported()
    source = Path(os.fspath(path))
    read_with(reader_of(source), source, made)
    give_priorities(made.scene)
    return made


def read_with(reader: Callable[[Path, Imported], Any], source: Path, made: Imported) -> Any:
    """What a reader makes of a file. Raises SceneError for a file that contradicts itself, and
    FileError if files are missing that it names.
    """
    import numpy as np

    from .missing import refuse_missing

    try:
        with np.errstate(over="raise", divide="raise", invalid="raise"):
            found = reader(source, made)
    except _core.Error:
        refuse_missing(made, source)  # other errors may be due to that
        raise
    except limits.CONTRADICTIONS as error:
        kind = type(error).__name__
        raise _core.SceneError(f"{source}: contradicts itself: {kind}: {error!s:.200}") from None
    refuse_missing(made, source)
    return found


def reader_of(path: Path) -> Callable[[Path, Imported], None]:
    """The reader for files of this extension."""
    if path.suffix.lower() == ".pbrt":
        from .pbrt import read_pbrt

        return read_pbrt
    if path.suffix.lower() == ".mtlx":
        from .materialx import read_materialx

        return read_materialx
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


def load_materials(path: str | os.PathLike[str]) -> dict[str, dict[str, Any]]:
    """The materials of a MaterialX file (.mtlx) by their names, for shapes of a scene dict.

    Each is a dict with a "bsdf", the dict of an `openpbr`, and with an "emitter", that of an `area`
    light, if it glows. These are what a shape takes:

        brass = mlt.load_materials("metals.mtlx")["Brass"]
        ball = {"type": "sphere", **brass}

    Radiance is the luminance in nits times the colour. Lengths that have a unit become metres, and
    thicknesses of films micrometres; colours are linear Rec. 709. Textures are images of their
    files, or arrays where nodes compute them. What has no counterpart is named in a warning of
    Python. Raises FileError for a file that cannot be read or that the file names and that is
    missing, SceneError for what is wrong in it and for shaders and nodes that are not read,
    UsageError for another extension or without the extra `materialx`.
    """
    from .imported import Imported
    from .materialx import read_materials

    source = Path(os.fspath(path))
    if source.suffix.lower() != ".mtlx":
        raise _core.UsageError(f"{source}: load_materials reads MaterialX (.mtlx)")
    made = Imported()
    found = read_with(read_materials, source, made)
    warn_all(made.placed_warnings(os.fspath(path)))
    return found


def convert(path: str | os.PathLike[str] | dict, output: str | os.PathLike[str]) -> list[str]:
    """Write a scene as Mitsuba XML.

    `path` names a scene of another program (.gltf, .glb, .pbrt, .usd), materials (.mtlx) or a mesh
    (.ply, .obj, .stl), or is a scene dict. Its meshes (.ply) and images are written beside
    `output`, with names that begin as its own does. Returns what has no counterpart, one line each.
    Raises FileError for files that cannot be read or written, SceneError for what is wrong in them,
    UsageError for another extension or without the extra that reading needs.
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
