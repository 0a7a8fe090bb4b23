"""How a scene of Blender is rendered; the parameters of integrators are those of the schemas."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

import pymlt as mlt
from pymlt import _core


def schema_property(parameter: dict):
    """The property for a parameter of an integrator; None where nothing stands for "not given"."""
    default, options = parameter["default"], {"description": parameter["doc"]}
    if default is None:
        return None
    if parameter["choices"]:
        items = [(choice, choice, "") for choice in parameter["choices"]]
        return EnumProperty(items=items, default=default, **options)
    kinds = {"boolean": BoolProperty, "integer": IntProperty, "float": FloatProperty}
    kind = kinds.get(parameter["type"])
    return kind and kind(default=default, **options)


def integrator_class(name: str) -> type:
    """A group of properties, one for each parameter of an integrator."""
    parameters = _core.schema("integrator", name)["parameters"]
    found = {p["name"]: schema_property(p) for p in parameters}
    fields = {key: value for key, value in found.items() if value is not None}
    return type(f"Pymlt_{name}", (bpy.types.PropertyGroup,), {"__annotations__": fields})


#: Files of Blender know an integrator by its place here: new ones come at the end.
PLACES = ("aov", "bdpt", "depth", "direct", "erpt", "mlt", "mmlt", "path", "pssmlt", "ptracer",
          "rjmlt")  # fmt: skip
INTEGRATORS = {name: integrator_class(name) for name in mlt.available("integrator")}


def integrator_items() -> list[tuple]:
    documented = {name: _core.schema("integrator", name)["doc"] for name in INTEGRATORS}
    return [(name, name, doc, "NONE", PLACES.index(name)) for name, doc in documented.items()]


class PymltSettings(bpy.types.PropertyGroup):
    """How a scene is rendered."""

    integrator: EnumProperty(name="Integrator", items=integrator_items(), default="mlt")
    time: FloatProperty(
        name="Time",
        default=60,
        min=0,
        subtype="TIME_ABSOLUTE",
        unit="TIME_ABSOLUTE",
        description="Seconds after which the render ends; 0: any",
    )
    samples: IntProperty(
        name="Samples",
        default=0,
        min=0,
        description="Samples per pixel after which the render ends; 0: any",
    )
    error: FloatProperty(
        name="Error (%)",
        default=2,
        min=0,
        max=100,
        description="Relative error at which the render ends; 0: any",
    )
    seed: IntProperty(name="Seed", default=0, min=0, description="Of all random numbers")
    animate_seed: BoolProperty(
        name="Animate Seed", default=True, description="Other random numbers for each frame"
    )
    denoise: BoolProperty(
        name="Denoise",
        default=False,
        description="Let Open Image Denoise guess what is left of the noise",
    )

    preview_integrator: EnumProperty(
        name="Viewport Integrator", items=integrator_items(), default="path"
    )
    preview_time: FloatProperty(
        name="Viewport Time",
        default=20,
        min=0.1,
        subtype="TIME_ABSOLUTE",
        unit="TIME_ABSOLUTE",
        description="Seconds after which a view is good enough",
    )

    bake_resolution: IntProperty(
        name="Resolution",
        default=1024,
        min=16,
        max=16384,
        description="Width and height of baked textures, in pixels",
    )

    def chosen_integrator(self, *, transparent: bool = False) -> dict:
        """The integrator as a scene dict has it, with the parameters that are no defaults.

        A film that is transparent hides the world.
        """
        group = getattr(self, self.integrator)
        given = {n: getattr(group, n) for n in group.__annotations__ if group.is_property_set(n)}
        if transparent and "hide_emitters" in group.__annotations__:
            given["hide_emitters"] = True
        return {"type": self.integrator, **given}

    def budget(self) -> dict:
        """When the render ends, as `pymlt.start` takes it; None stands for "any"."""
        return {
            "time": self.time or None,
            "spp": self.samples or None,
            "error": self.error / 100 or None,
        }


def threads(scene) -> int:
    """Threads of a render; 0 stands for all there are."""
    return scene.render.threads if scene.render.threads_mode == "FIXED" else 0


PymltSettings.__annotations__ |= {
    name: PointerProperty(type=group) for name, group in INTEGRATORS.items()
}
CLASSES = [*INTEGRATORS.values(), PymltSettings]


def register() -> None:
    for known in CLASSES:
        bpy.utils.register_class(known)
    bpy.types.Scene.pymlt = PointerProperty(type=PymltSettings)


def unregister() -> None:
    del bpy.types.Scene.pymlt
    for known in reversed(CLASSES):
        bpy.utils.unregister_class(known)
