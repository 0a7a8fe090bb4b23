"""From a file of any known format to a Scene."""

from __future__ import annotations

import os
from typing import Any

from .. import _core, scenes
from ..scenes import replaced
from ..scenes.kinds import check_kind, is_foreign
from ..scenes.loading import (
    define_texts,
    filter_name,
    image_size,
    load_built_in,
    load_dict,
    sensor_index,
)
from ..scenes.traversal import SceneParameters
from .files import load_foreign, warn_all

SceneLike = _core.Scene | SceneParameters | dict | str | os.PathLike
SensorLike = _core.Scene.Part | int | dict


def load(
    path: str | os.PathLike[str],
    /,
    *,
    size: tuple[int, int] | None = None,
    lenient: bool | None = None,
    sensor: int | None = None,
    filter: str | None = None,
    spectral: bool = False,
    **defines: Any,
) -> _core.Scene:
    """Load a scene from a file of any known format, which its extension tells, or by its name.

    .gltf, .glb
        glTF 2.0; needs the extra `gltf`.
    .pbrt
        pbrt-v3 and pbrt-v4.
    .mtlx
        materials of MaterialX, each on a ball (`load_materials` gives them alone); needs the extra
        `materialx`.
    .usd, .usda, .usdc, .usdz
        Universal Scene Description; needs the extra `usd`.
    .ply, .obj, .stl, .ply.gz, .obj.gz
        one mesh, in which y is up, with a grey material, light, and a camera that it fits.
    anything else that exists, but files of other programs (.blend, .fbx, ...)
        Mitsuba XML; see `load_file` for `lenient` and `defines`.
    the name of a built-in scene ("ring", "door-ajar"; see `pymlt.scenes`)
        that scene; `defines` are its parameters.

    `size` is the image's (width, height) in pixels, `sensor` says which of several cameras is
    meant, `filter` names another reconstruction filter; with `spectral` light has wavelengths
    instead of R, G and B. What a file of another program has and a
    Mitsuba scene cannot say is named in a warning of Python. Raises FileError, SceneError and
    UsageError, as `load_file` and `convert` do.
    """
    scene, found = load_with_warnings(path, defines, size, lenient, sensor, filter)
    warn_all(found)
    return scene.with_wavelengths() if spectral else scene


def load_with_warnings(
    path, defines: dict, size=None, lenient=None, sensor=None, filter=None
) -> tuple[_core.Scene, list[str]]:
    """What `load` loads, and what of the file has no counterpart in a Mitsuba scene."""
    asked = size, sensor, filter = image_size(size), sensor_index(sensor), filter_name(filter)
    text = os.fspath(path)
    if not os.path.exists(text):
        return load_built_in(existing_name(text), define_texts(defines), *asked), []
    check_kind(text)
    if not is_foreign(text):
        return _core.load_file(text, define_texts(defines), size, lenient, sensor, filter), []
    if defines or lenient is not None:
        raise _core.UsageError(
            f"{text}: only Mitsuba XML has parameters (-D) and is read leniently or strictly"
        )
    return load_foreign(text, *asked)


def built_in_name(text: str) -> str | None:
    """The name of the built-in scene that `text` means, be it door_ajar or door-ajar."""
    name = text.replace("-", "_")
    return name if name in scenes.names() else None


def existing_name(text: str) -> str:
    """As built_in_name. Raises FileError for what looks like a file, UsageError for other names."""
    if name := built_in_name(text):
        return name
    if "." in text or os.sep in text:
        raise _core.FileError(f"{text}: there is no such file")
    raise _core.UsageError(
        f"{text!r} is neither a file nor a built-in scene"
        + _core.suggestion(text.replace("-", "_"), scenes.names()),
    )


def as_scene(scene, sensor=None, spectral=False) -> _core.Scene:
    """What `scene` means: itself, a dict, the path of a file, or a built-in scene's name.

    `sensor` is the index of one of its sensors, a member of `Scene.sensors`, or the dict of another
    one.
    """
    index = None if isinstance(sensor, dict) else sensor
    if isinstance(scene, SceneParameters):
        scene = scene.scene
    if isinstance(scene, _core.Scene):
        replaced.fetch(scene)
        replaced.warn_if_replaced(scene)
        found = scene if index is None else scene.with_sensor(sensor_index(index))
    elif isinstance(scene, dict):
        found = load_dict(scene, sensor=index)
    elif isinstance(scene, str | os.PathLike):
        found = load(scene, sensor=index)
    else:
        raise _core.UsageError(f"{scene!r} is not a scene, a dict, the path of a file, or a name")
    if index is not sensor:
        found = found.with_sensor(sensor)
    return found.with_wavelengths() if spectral else found
