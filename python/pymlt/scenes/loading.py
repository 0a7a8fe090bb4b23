"""From a scene description to a Scene."""

from __future__ import annotations

import inspect
import operator
import os
from collections.abc import Iterable
from typing import Any

from .. import _core, scenes
from .arrays import with_bytes
from .kinds import check_is_mitsuba
from .parts import check_is_scene


def load_file(
    path: str | os.PathLike[str],
    /,
    *,
    size: tuple[int, int] | None = None,
    lenient: bool | None = None,
    sensor: int | None = None,
    filter: str | None = None,
    **defines: Any,
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
    check_is_mitsuba(path)
    return _core.load_file(
        os.fspath(path),
        define_texts(defines),
        image_size(size),
        lenient,
        sensor_index(sensor),
        filter_name(filter),
    )


def load_string(
    xml: str,
    /,
    *,
    directory: str | os.PathLike[str] = ".",
    size: tuple[int, int] | None = None,
    lenient: bool | None = None,
    sensor: int | None = None,
    filter: str | None = None,
    **defines: Any,
) -> _core.Scene:
    """Load a scene from a string of Mitsuba XML; file names in it are relative to `directory`.

    Otherwise as `load_file`.
    """
    return _core.load_string(
        xml,
        os.fspath(directory),
        define_texts(defines),
        image_size(size),
        lenient,
        sensor_index(sensor),
        filter_name(filter),
    )


def load_dict(
    scene: dict,
    /,
    *,
    size: tuple[int, int] | None = None,
    sensor: int | None = None,
    filter: str | None = None,
) -> _core.Scene:
    """Load a scene from a Mitsuba 3 dict.

    Transforms may be `Transform`, Mitsuba's own, numpy arrays or nested lists; file names are
    relative to the current directory. Meshes, textures and environment maps may be arrays; see
    `pymlt.scenes.arrays`. `size`, `sensor`, `filter` and errors are those of `load_file`.
    """
    if not isinstance(scene, dict):
        raise _core.UsageError(f"load_dict needs a dict, not a {type(scene).__name__}")
    check_is_scene(scene)
    return _core.load_dict(
        with_bytes(scene), image_size(size), sensor_index(sensor), filter_name(filter)
    )


def load_built_in(
    name: str, defines: dict[str, str], size=None, sensor=None, filter=None
) -> _core.Scene:
    """Load a scene of this package by its name; `defines` are its parameters, as texts."""
    built_in_defaults(name, defines)
    scene = getattr(scenes, name)(**{key: number_or_text(value) for key, value in defines.items()})
    return _core.load_dict(
        scene, image_size(size), sensor_index(sensor), filter_name(filter), name, defines
    )


def built_in_defaults(name: str, defines: Iterable[str]) -> dict[str, Any]:
    """The parameters of a built-in scene. Raises UsageError for a define that is none of them."""
    known = inspect.signature(getattr(scenes, name)).parameters
    for define in defines:
        if define not in known:
            raise _core.UsageError(
                f"-D {define}: unknown parameter of the scene {name!r}"
                + _core.suggestion(define, list(known)),
            )
    return {parameter.name: parameter.default for parameter in known.values()}


def number_or_text(text: str) -> int | float | str:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def image_size(size) -> tuple[int, int] | None:
    if size is None:
        return None
    try:
        width, height = size
        if int(width) == width and int(height) == height and max(abs(width), abs(height)) < 2**31:
            return int(width), int(height)
    except (OverflowError, TypeError, ValueError):
        pass
    raise _core.UsageError(f"size is {size!r}, but should be (width, height) in pixels")


def sensor_index(sensor) -> int | None:
    if sensor is None:
        return None
    try:
        if not isinstance(sensor, bool) and abs(operator.index(sensor)) < 2**31:
            return operator.index(sensor)
    except TypeError:
        pass
    raise _core.UsageError(f"sensor is {sensor!r}, but should be the number of a sensor, from 0 on")


def filter_name(filter) -> str:
    if filter is None or isinstance(filter, str):
        return filter or ""
    raise _core.UsageError(f"filter is {filter!r}, but should be a name, such as 'box'")


def define_texts(defines: dict) -> dict[str, str]:
    return {name: _text(value) for name, value in defines.items()}


def _text(value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list | tuple):
        return ", ".join(map(_text, value))
    return str(value)
