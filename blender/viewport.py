"""What Blender's 3D views ask of a render engine: to follow the scene and the view, and to draw."""

import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d

import pymlt as mlt

from . import left_out
from .export import camera, export
from .preview import Preview


class Viewport:
    """The part of the engine that 3D views use."""

    _preview = None  #: made with the first update; Blender makes an engine for each view

    def view_update(self, context, depsgraph) -> None:
        """The scene has changed."""
        if self._preview is None:
            self._preview = Preview()
        settings = depsgraph.scene.pymlt
        try:
            made = export(depsgraph, view_sensor(context, self._pixel_size(depsgraph)))
            left_out.note(depsgraph.scene, made.warnings)
            how = {"integrator": settings.preview_integrator, "time": settings.preview_time}
            self._preview.update(made.scene, seed=settings.seed, **how)
        except mlt.Error as error:
            self.update_stats("", str(error))

    def view_draw(self, context, depsgraph) -> None:
        """The view has changed, or there are more samples."""
        if self._preview is None:
            return
        try:
            self._preview.look(view_sensor(context, self._pixel_size(depsgraph)))
        except mlt.Error as error:
            self.update_stats("", str(error))
            return
        pixels = self._preview.pixels()
        if pixels is not None:
            self.bind_display_space_shader(depsgraph.scene)
            draw(pixels, context.region)
            self.unbind_display_space_shader()
        self.update_stats("", f"{self._preview.samples:.4g} samples per pixel")
        if not self._preview.ended:
            self.tag_redraw()

    def _pixel_size(self, depsgraph) -> int:
        return int(self.get_preview_pixel_size(depsgraph.scene))


def view_sensor(context, pixel_size: int = 1) -> dict:
    """The camera of a 3D view; its pixels are `pixel_size` pixels of the screen wide."""
    region, view = context.region, context.region_data
    image = camera.film(*(max(side // pixel_size, 1) for side in (region.width, region.height)))
    through = view.view_perspective == "CAMERA" and context.space_data.camera
    lens = camera.lens(through) if through else {}
    return camera.sensor(view.view_matrix.inverted(), view.window_matrix, image, lens)


def draw(pixels: np.ndarray, region) -> None:
    """Fills a region with an image."""
    height, width = pixels.shape[:2]
    data = gpu.types.Buffer("FLOAT", pixels.size, np.ascontiguousarray(pixels).ravel())
    texture = gpu.types.GPUTexture((width, height), format="RGBA16F", data=data)
    draw_texture_2d(texture, (0, 0), region.width, region.height)
