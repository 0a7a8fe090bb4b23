"""The render engine and its final renders."""

from functools import partial
from time import monotonic

import bpy

import pymlt as mlt
from pymlt.formats.imported import Imported

from . import glow, left_out, passes, shot
from .export import stepped_export
from .settings import threads
from .together import Together
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
        passes.add(self)
        made = self.read(depsgraph)
        together = shot.together(self, depsgraph, made.scene)
        if together is None:
            self._render_alone(depsgraph, made.scene)
            return
        if not together.has_begun:
            self._render_first(together, depsgraph.view_layer.name)
        if not self.test_break():
            found = together.result(depsgraph.scene.frame_current)
            self._show(depsgraph.view_layer.name, 0.0, found, 1)

    def read(self, depsgraph) -> Imported:
        """The export of the frame; what is left out of it is told."""
        self.update_stats("", "Reading the scene")
        made = stepped_export(self, depsgraph)
        left_out.note(depsgraph.scene, made.warnings)
        tell_left_out(self, made.warnings)
        return made

    def _render_alone(self, depsgraph, described: dict) -> None:
        world = mlt.load_dict(described)
        settings, seen = depsgraph.scene.pymlt, 0.0
        if depsgraph.scene.render.film_transparent:
            seen = glow.seen_directly(described, settings.seed)
        show = partial(self._show, depsgraph.view_layer.name, seen)
        found = follow(start(world, depsgraph.scene), self.test_break, show)
        show(found, 1)

    def _render_first(self, together: Together, layer: str) -> None:
        """Renders several frames, of which the first one is seen."""

        def show(found: mlt.Result, progress: float) -> None:
            self._show(layer, 0.0, together.picture(found), progress)

        together.picture(follow(together.start(), self.test_break, show))

    def _show(self, layer: str, seen, found: mlt.Result, progress: float) -> None:
        height, width = found.image.shape[:2]
        result = self.begin_result(0, 0, width, height, layer=layer)
        passes.write(result.layers[0], found.image + seen, found.layers)
        self.end_result(result)
        self.update_stats("", statistics(found))
        self.update_progress(progress)


def start(world: mlt.Scene, scene) -> mlt.Job:
    """The render of a scene with Blender's settings."""
    settings = scene.pymlt
    seed = settings.seed + settings.animate_seed * max(scene.frame_current, 0)
    transparent = scene.render.film_transparent
    integrator = settings.chosen_integrator(transparent=transparent)
    options = {"aovs": passes.AOVS, "alpha": transparent, "denoise": settings.denoise}
    options |= settings.budget()
    return mlt.start(world, integrator, seed=seed, threads=threads(scene), **options)


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
    error, frames = stats.get("denoised_error", stats["error"]), stats.get("exposures", 1)
    known = "" if error is None else f", error {100 * error:.2g} %"
    of_each = f" in each of {frames} frames" if frames > 1 else ""
    return f"{stats['spp_done']:.4g} samples per pixel{of_each}{known}"


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
