"""The render engine and its final renders."""

from functools import partial
from time import monotonic

import bpy

import pymlt as mlt

from . import glow, left_out, passes
from .export import stepped_export
from .viewport import Viewport

INTERVAL = 0.5  #: seconds between two looks at a render, at the least
REST = 4.0  #: times as long as a look takes until the next one, which may be denoised


class PymltEngine(Viewport, bpy.types.RenderEngine):
    """Renders by pymlt."""

    bl_idname = "PYMLT"
    bl_label = "pymlt"
    bl_use_preview = False
    bl_use_shading_nodes_custom = False
    bl_use_postprocess = True

    def update_render_passes(self, scene, layer) -> None:
        passes.register(self, scene, layer)

    def render(self, depsgraph) -> None:
        """Renders a frame. What is wrong with the scene is Blender's message."""
        try:
            self._render(depsgraph)
        except mlt.Error as error:
            self.error_set(str(error))
            self.report({"ERROR"}, str(error))

    def _render(self, depsgraph) -> None:
        if depsgraph.scene.camera is None:
            raise mlt.SceneError("the scene has no camera")
        self.update_stats("", "Reading the scene")
        made = stepped_export(self, depsgraph)
        left_out.note(depsgraph.scene, made.warnings)
        tell_left_out(self, made.warnings)
        world = mlt.load_dict(made.scene)
        passes.add(self)
        settings, seen = depsgraph.scene.pymlt, 0.0
        if depsgraph.scene.render.film_transparent:
            seen = glow.seen_directly(made.scene, settings.seed)
        show = partial(self._show, depsgraph.view_layer.name, seen)
        found = follow(start(world, depsgraph.scene), self.test_break, show)
        show(found, 1)

    def _show(self, layer: str, seen, found: mlt.Result, progress: float) -> None:
        height, width = found.image.shape[:2]
        result = self.begin_result(0, 0, width, height, layer=layer)
        passes.write(result.layers[0], found.image + seen, found.layers)
        self.end_result(result)
        self.update_stats("", statistics(found))
        self.update_progress(progress)


def start(world: mlt.Scene, scene) -> mlt.Job:
    """The render of a scene with Blender's settings."""
    settings, threads = scene.pymlt, 0
    if scene.render.threads_mode == "FIXED":
        threads = scene.render.threads
    seed = settings.seed + settings.animate_seed * max(scene.frame_current, 0)
    transparent = scene.render.film_transparent
    integrator = settings.chosen_integrator(transparent=transparent)
    options = {"aovs": passes.AOVS, "alpha": transparent, "denoise": settings.denoise}
    options |= settings.budget()
    return mlt.start(world, integrator, seed=seed, threads=threads, **options)


def follow(job: mlt.Job, is_stopped, show) -> mlt.Result:
    """Shows a render while it runs, until it has ended or Blender stops it."""
    try:
        due = 0.0
        while not job.wait(INTERVAL) and not is_stopped():
            if (begun := monotonic()) >= due:
                show(job.snapshot(), job.progress)
                due = monotonic() + REST * (monotonic() - begun)
    finally:
        job.cancel()
    job.wait()
    return job.snapshot()


def statistics(found: mlt.Result) -> str:
    """What the line above the picture says."""
    stats = found.stats
    samples, error = stats["spp_done"], stats.get("denoised_error", stats["error"])
    known = "" if error is None else f", error {100 * error:.2g} %"
    return f"{samples:.4g} samples per pixel{known}"


_told: set[str] = set()


def tell_left_out(engine, warnings: list[str]) -> None:
    """Reports what could not be carried over: each thing once, not per frame."""
    for text in warnings:
        if text not in _told:
            _told.add(text)
            engine.report({"WARNING"}, f"pymlt: {text}")


def register() -> None:
    bpy.utils.register_class(PymltEngine)


def unregister() -> None:
    bpy.utils.unregister_class(PymltEngine)
