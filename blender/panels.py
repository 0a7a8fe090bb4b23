"""The panels of the render's properties."""

import bpy

from .settings import INTEGRATORS, PymltSettings

NOT_CARRIED = (
    "Volumes of objects, grids and worlds; displacement, hair, point clouds",
    "Procedural textures, groups of nodes",
    "Subsurface, sheen, anisotropy, thin films",
    "Mirrors do not show spots with a size, areas with a spread",
    "Deformation in motion blur, panoramas",
    "Lamps with a size are seen by the camera",
    "Faces glow on the side of their normals",
)


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
            if name not in INTEGRATORS:
                self.layout.prop(context.scene.pymlt, name)


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
    """What looks otherwise than in Cycles."""

    bl_idname = "RENDER_PT_pymlt_left_out"
    bl_label = "Not Rendered"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012

    def draw(self, context) -> None:
        for line in NOT_CARRIED:
            self.layout.label(text=line)


CLASSES = (SamplingPanel, ParametersPanel, LeftOutPanel)


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
