"""From a scene description to a Scene."""

from __future__ import annotations

import inspect
import operator
import os

from .. import _core, scenes
from .arrays import with_bytes

SceneLike = _core.Scene | dict | str | os.PathLike


def load(path, /, *, size=None, lenient=None, sensor=None, filter=None, **defines) -> _core.Scene:
    """Load a scene from a file of any known format, which its extension tells.

    .gltf, .glb
        glTF 2.0; needs the extra `gltf`.
    .pbrt
        pbrt-v4.
    anything else
        Mitsuba XML; see `load_file` for `lenient` and `defines`, which only these files have.

    `size` is the image's (width, height) in pixels, `sensor` says which of several cameras is
    meant, `filter` names another reconstruction filter. What a file of another program has and a
    Mitsuba scene cannot say is named in a warning of Python. Raises FileError, SceneError and
    UsageError, as `load_file` and `convert` do.
    """
    from ..formats.files import is_foreign, load_foreign, warn_all

    if not is_foreign(path):
        return load_file(path, size=size, lenient=lenient, sensor=sensor, filter=filter, **defines)
    if defines or lenient is not None:
        raise _core.UsageError(f"{os.fspath(path)}: only Mitsuba XML has defines and is lenient")
    scene, found = load_foreign(path, _size(size), _sensor(sensor), _filter(filter))
    warn_all(path, found)
    return scene


def load_file(
    path, /, *, size=None, lenient=None, sensor=None, filter=None, **defines
) -> _core.Scene:
    """Load a Mitsuba XML scene.

    `defines` are values for the scene's <default> parameters (`resx=640`); `size` is the image's
    (width, height) in pixels, in place of the film's own. Unknown parameters and integrators are
    left out with a warning if `lenient`, refused if not; by default (None) the former in files of
    Mitsuba 0.x, the latter in files of Mitsuba 2 and 3. `sensor` says which of several sensors is
    meant, counted from 0; None is the first one. `filter` names a reconstruction filter ("box") in
    place of the film's own. Raises FileError for files that cannot be read, SceneError (with file
    and line) for what is wrong in them, UsageError for the arguments.
    """
    return _core.load_file(
        os.fspath(path),
        _texts(defines),
        _size(size),
        lenient,
        _sensor(sensor),
        _filter(filter),
    )


def load_string(
    xml: str, /, *, directory=".", size=None, lenient=None, sensor=None, filter=None, **defines
) -> _core.Scene:
    """Load a scene from a string of Mitsuba XML; file names in it are relative to `directory`.

    Otherwise as `load_file`.
    """
    return _core.load_string(
        xml,
        os.fspath(directory),
        _texts(defines),
        _size(size),
        lenient,
        _sensor(sensor),
        _filter(filter),
    )


def load_dict(scene: dict, /, *, size=None, sensor=None, filter=None) -> _core.Scene:
    """Load a scene from a Mitsuba 3 dict.

    Transforms may be `Transform`, Mitsuba's own, numpy arrays or nested lists; file names are
    relative to the current directory. Meshes, textures and environment maps may be arrays; see
    `pymlt.scenes.arrays`. `size`, `sensor`, `filter` and errors are those of `load_file`.
    """
    if not isinstance(scene, dict):
        raise _core.UsageError(f"load_dict needs a dict, not a {type(scene).__name__}")
    return _core.load_dict(with_bytes(scene), _size(size), _sensor(sensor), _filter(filter))


def load_built_in(
    name: str, defines: dict[str, str], size=None, sensor=None, filter=None
) -> _core.Scene:
    """Load a scene of this package by its name; `defines` are its parameters, as texts."""
    function = getattr(scenes, name)
    known = inspect.signature(function).parameters
    for define in defines:
        if define not in known:
            raise _core.UsageError(
                f"-D {define}: unknown parameter of the scene {name!r}"
                + _core.suggestion(define, list(known)),
            )
    scene = function(**{key: _number(value) for key, value in defines.items()})
    return _core.load_dict(scene, _size(size), _sensor(sensor), _filter(filter), name, defines)


def _number(text: str) -> int | float | str:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def _size(size) -> tuple[int, int] | None:
    if size is None:
        return None
    try:
        width, height = size
        if int(width) == width and int(height) == height:
            return int(width), int(height)
    except (TypeError, ValueError):
        pass
    raise _core.UsageError(f"size is {size!r}, but should be (width, height)")


def _sensor(sensor) -> int | None:
    if sensor is None:
        return None
    try:
        if not isinstance(sensor, bool):
            return operator.index(sensor)
    except TypeError:
        pass
    raise _core.UsageError(f"sensor is {sensor!r}, but should be an integer")


def _filter(filter) -> str:
    if filter is None or isinstance(filter, str):
        return filter or ""
    raise _core.UsageError(f"filter is {filter!r}, but should be a name, such as 'box'")


def _texts(defines: dict) -> dict[str, str]:
    return {name: _text(value) for name, value in defines.items()}


def _text(value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list | tuple):
        return ", ".join(map(_text, value))
    return str(value)


def as_scene(scene, sensor=None) -> _core.Scene:
    """What `scene` means: itself, a dict, or the path of a file."""
    if isinstance(scene, _core.Scene):
        return scene if sensor is None else scene.with_sensor(_sensor(sensor))
    if isinstance(scene, dict):
        return load_dict(scene, sensor=sensor)
    if isinstance(scene, str | os.PathLike):
        return load(scene, sensor=sensor)
    raise _core.UsageError(f"{scene!r} is not a scene, a dict, or the path of a file")
