"""From a file of any known format to a Scene."""

from __future__ import annotations

import os

from .. import _core
from ..scenes.loading import filter_name, image_size, load_dict, load_file, sensor_index
from .files import is_foreign, load_foreign, warn_all

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
    if not is_foreign(path):
        return load_file(path, size=size, lenient=lenient, sensor=sensor, filter=filter, **defines)
    if defines or lenient is not None:
        raise _core.UsageError(f"{os.fspath(path)}: only Mitsuba XML has defines and is lenient")
    scene, found = load_foreign(path, image_size(size), sensor_index(sensor), filter_name(filter))
    warn_all(found)
    return scene


def as_scene(scene, sensor=None) -> _core.Scene:
    """What `scene` means: itself, a dict, or the path of a file."""
    if isinstance(scene, _core.Scene):
        return scene if sensor is None else scene.with_sensor(sensor_index(sensor))
    if isinstance(scene, dict):
        return load_dict(scene, sensor=sensor)
    if isinstance(scene, str | os.PathLike):
        return load(scene, sensor=sensor)
    raise _core.UsageError(f"{scene!r} is not a scene, a dict, or the path of a file")
