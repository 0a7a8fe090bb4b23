"""The panels of the render's properties."""

import textwrap

import bpy

from . import baking, left_out, shot
from .settings import INTEGRATORS, PymltSettings

LETTER = 7  #: pixels, about, at the scale 1 of the interface


class PymltPanel(bpy.types.Panel):
    """A panel that is there while pymlt is the engine."""

    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = {"PYMLT"}  # noqa: RUF012 (Blender reads it from the class)

    @classmethod
    def poll(cls, context) -> bool:
        return context.engine in cls.COMPAT_ENGINES


class SamplingPanel(PymltPanel):
    """Integrator and budget."""

    bl_idname = "RENDER_PT_pymlt"
    bl_label = "Sampling"

    def draw(self, context) -> None:
        self.layout.use_property_split = True
        for name in PymltSettings.__annotations__:
            if name not in (*INTEGRATORS, "bake_resolution"):
                self.layout.prop(context.scene.pymlt, name)
        self.layout.operator(shot.ShotOperator.bl_idname)


class ParametersPanel(PymltPanel):
    """Parameters of the integrator, as its schema has them."""

    bl_idname = "RENDER_PT_pymlt_parameters"
    bl_label = "Integrator"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012

    def draw(self, context) -> None:
        settings = context.scene.pymlt
        self.layout.use_property_split = True
        for name in INTEGRATORS[settings.integrator].__annotations__:
            self.layout.prop(getattr(settings, settings.integrator), name)


class LeftOutPanel(PymltPanel):
    """What of the scene looks otherwise than in Cycles."""

    bl_idname = "RENDER_PT_pymlt_left_out"
    bl_label = "Not Rendered"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012

    def draw(self, context) -> None:
        scale = context.preferences.system.ui_scale
        letters = max(int(context.region.width / (LETTER * scale)) - 6, 20)
        column = self.layout.column(align=True)
        for sentence in left_out.sentences(context.scene):
            for line in textwrap.wrap(sentence, letters):
                column.label(text=line)
        self.layout.operator(left_out.LookOperator.bl_idname)


class BakingPanel(PymltPanel):
    """Textures that have no counterpart, as images."""

    bl_idname = "RENDER_PT_pymlt_baking"
    bl_label = "Baked Textures"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012

    def draw(self, context) -> None:
        self.layout.use_property_split = True
        self.layout.prop(context.scene.pymlt, "bake_resolution")
        for operator in (baking.BakeOperator, baking.ForgetOperator):
            self.layout.operator(operator.bl_idname)


CLASSES = (SamplingPanel, ParametersPanel, LeftOutPanel, BakingPanel)


def shared_panels() -> list[type]:
    """Blender's own panels that make sense here, such as those of lights and materials."""
    eevee, contexts = ("BLENDER_EEVEE", "BLENDER_EEVEE_NEXT"), ("material", "world", "data")

    def fits(panel) -> bool:
        engines = getattr(panel, "COMPAT_ENGINES", ())
        of_eevee = (
            any(name in engines for name in eevee) and getattr(panel, "bl_context", "") in contexts
        )
        return "BLENDER_RENDER" in engines or of_eevee

    return [panel for panel in bpy.types.Panel.__subclasses__() if fits(panel)]


def register() -> None:
    for known in CLASSES:
        bpy.utils.register_class(known)
    for panel in shared_panels():
        panel.COMPAT_ENGINES.add("PYMLT")


def unregister() -> None:
    for panel in shared_panels():
        panel.COMPAT_ENGINES.discard("PYMLT")
    for known in reversed(CLASSES):
        bpy.utils.unregister_class(known)
