"""Run by Python with `bpy`: what the panel says of scenes, and what an export of them warns of.

Writes facts.json into a folder.
"""

import json
import sys
from pathlib import Path
from types import SimpleNamespace

import bpy
from blender_engine import ROOT, add, fresh, lamp
from blender_material import material


def plain():
    """A floor below an even sky: all of it is rendered."""
    fresh(sky=0.5)


def rich():
    """A bit of everything that is left out."""
    fresh(sky=0.5)
    tree = material("noise").node_tree
    noise = tree.nodes.new("ShaderNodeTexNoise")
    principled = tree.nodes["Principled BSDF"]
    tree.links.new(noise.outputs["Color"], principled.inputs["Base Color"])
    for name in ("Anisotropic", "Anisotropic Rotation"):
        principled.inputs[name].default_value = 0.5
    principled.inputs["Emission Strength"].default_value = 0.5
    cube = add(bpy.ops.mesh.primitive_cube_add, bpy.data.materials["noise"])
    cube.visible_shadow = False
    cube.is_shadow_catcher = True
    cube.modifiers.new("hair", "PARTICLE_SYSTEM")
    cube.particle_systems[0].settings.type = "HAIR"
    cube.shape_key_add(name="Basis")
    cube.shape_key_add(name="wide").value = 0.5
    bpy.context.scene.render.use_motion_blur = True
    lamp("SPOT", 100, (0, 0, 4), shadow_soft_size=0.2, use_shadow=False)
    lamp("AREA", 100, (0, 0, 4), spread=1.0)
    lamp("POINT", 100, (0, 0, 4), shadow_soft_size=0.2)


def rendered_small() -> None:
    scene = bpy.context.scene
    scene.render.engine = "PYMLT"
    scene.render.resolution_x, scene.render.resolution_y = 16, 9
    scene.pymlt.samples, scene.pymlt.integrator = 1, "path"
    bpy.ops.render.render()


class Layout:
    """What a panel draws."""

    def __init__(self):
        self.lines, self.operators = [], []

    def column(self, align):
        return self

    def label(self, text):
        self.lines.append(text)

    def operator(self, name):
        self.operators.append(name)


def drawn(panel, width: int) -> Layout:
    context = SimpleNamespace(
        region=SimpleNamespace(width=width),
        preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=1.0)),
        scene=bpy.context.scene,
    )
    layout = Layout()
    panel.draw(SimpleNamespace(layout=layout), context)
    return layout


def main(folder: Path) -> None:
    sys.path.insert(0, str(ROOT))
    import blender
    from blender import engine, left_out, panels

    blender.register()
    facts = {}
    for make in (plain, rich):
        make()
        facts[f"{make.__name__} before"] = left_out.sentences(bpy.context.scene)
        bpy.ops.pymlt.look()
        facts[f"{make.__name__} looked"] = left_out.sentences(bpy.context.scene)
        told = []
        engine.tell_left_out = lambda _, warnings, told=told: told.extend(warnings)
        rendered_small()
        facts[f"{make.__name__} told"] = told
        facts[f"{make.__name__} rendered"] = left_out.sentences(bpy.context.scene)
    for width in (200, 2000):
        layout = drawn(panels.LeftOutPanel, width)
        facts[f"drawn {width}"], facts["operators"] = layout.lines, layout.operators
    bpy.context.object.location.x += 1
    bpy.context.view_layer.update()
    facts["changed"] = left_out.sentences(bpy.context.scene)[-1]
    (folder / "facts.json").write_text(json.dumps(facts))


main(Path(sys.argv[1]))
