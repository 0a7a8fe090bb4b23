"""The render of a checkpoint, and its scene."""

from __future__ import annotations

import contextlib
import os
from dataclasses import replace

from .. import _core, scenes
from ..formats.files import load_foreign
from ..formats.loading import SceneLike, as_scene, existing_name
from ..scenes.kinds import is_foreign
from ..scenes.loading import load_built_in
from .job import Job
from .options import RenderOptions


def saved_job(
    saved: _core.Checkpoint, path: str, scene: SceneLike | None, options: RenderOptions
) -> Job:
    """The job of the checkpoint that was read from `path`, not yet started."""
    try:
        loaded = saved_scene(saved, path, scene)
    except _core.SceneError as error:
        if isinstance(scene, str | os.PathLike) and str(error).endswith(" the scene as it was"):
            raise _core.SceneError(f"{error}, which {os.fspath(scene)!r} is not") from None
        raise
    options = replace(options, seed=saved.seed, checkpoint=options.checkpoint or path)
    options.light_groups, options.light_layers = False, None  # the integrator has them
    job = Job(loaded, saved.integrator, options)
    saved.resume(job._job)
    return job


def saved_scene(saved: _core.Checkpoint, path: str, scene: SceneLike | None) -> _core.Scene:
    """The scene of a checkpoint, which `scene` may give or name. Raises SceneError for another."""
    if isinstance(scene, _core.Scene | dict):
        return with_saved_light(saved, as_scene(scene))
    name, defines, *asked = saved.built_in or ("", {})
    text = "" if scene is None else os.fspath(scene)
    if text and not os.path.exists(text):
        text = existing_name(text)
    if is_foreign(name) and text not in scenes.names():
        loaded, _ = load_foreign(text or name, *asked)
    elif name and text in ("", name):
        loaded = load_built_in(name, defines, *asked)
    elif name or is_foreign(text) or text in scenes.names():
        own = repr(name) if name else "a scene from elsewhere"
        raise _core.SceneError(f"{path}: is a checkpoint of {own}, not of {text!r}")
    else:
        return saved.load_scene(text)
    return with_saved_light(saved, loaded)


def with_saved_light(saved: _core.Checkpoint, scene: _core.Scene) -> _core.Scene:
    """This scene, with wavelengths if the checkpoint's has them. Raises SceneError for another."""
    try:
        saved.check(scene)
    except _core.SceneError:
        with contextlib.suppress(_core.Error):
            spectral = scene.with_wavelengths()
            saved.check(spectral)
            return spectral
        raise
    return scene
