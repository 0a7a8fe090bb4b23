"""Run by Python with `bpy`: balls of the Principled BSDF, each by the extension and by Cycles.

Writes NAME.exr and NAME-cycles.exr into a folder, with as many pixels a side as is said.
"""

import sys
from pathlib import Path

import bpy
from blender_engine import ROOT, add, fresh, lamp, render, values
from blender_material import material
from mathutils import Vector

RED, BLUE, GOLD = (0.6, 0.1, 0.05, 1), (0.05, 0.1, 0.5, 1), (0.9, 0.6, 0.2, 1)
BALLS = {
    "plastic": {"Base_Color": RED, "Roughness": 0.3},
    "metal": {
        "Base_Color": GOLD,
        "Metallic": 1.0,
        "Roughness": 0.4,
        "Specular_Tint": (0, 0.3, 1, 1),
    },
    "paint": {"Base_Color": BLUE, "Coat_Weight": 1.0, "Coat_Roughness": 0.05},
    "cloth": {
        "Base_Color": (0.2, 0.05, 0.1, 1),
        "Roughness": 0.9,
        "Sheen_Weight": 1.0,
        "Sheen_Tint": (1, 0.9, 0.8, 1),
    },
    "glass": {"Base_Color": (0.4, 0.9, 0.7, 1), "Transmission_Weight": 1.0, "Roughness": 0.3},
    "wax": {
        "Base_Color": (0.8, 0.6, 0.4, 1),
        "Subsurface_Weight": 1.0,
        "Subsurface_Radius": (1.0, 0.5, 0.25),
        "Subsurface_Scale": 0.1,
    },
    "film": {"Base_Color": (0.02, 0.02, 0.02, 1), "Roughness": 0.2, "Thin_Film_Thickness": 400.0},
    "brushed": {
        "Base_Color": (0.8, 0.8, 0.85, 1),
        "Metallic": 1.0,
        "Roughness": 0.4,
        "Anisotropic": 0.8,
    },
    "tinted": {
        "Base_Color": (0.8, 0.8, 0.8, 1),
        "Coat_Weight": 1.0,
        "Coat_Tint": (0.9, 0.5, 0.2, 1),
    },
    "glowing": {
        "Base_Color": RED,
        "Emission_Color": (1, 1, 1, 1),
        "Emission_Strength": 0.5,
        "Coat_Weight": 1.0,
        "Coat_IOR": 2.0,
    },
}
METALLIC = {"Base Color": GOLD, "Edge Tint": (0, 0.3, 1, 1), "Roughness": 0.4, "Anisotropy": 0.8}


def metallic(made) -> None:
    """Makes a material a Metallic BSDF, which is there since Blender 4.3."""
    node = made.node_tree.nodes.new("ShaderNodeBsdfMetallic")
    values(node, **METALLIC)
    output = made.node_tree.nodes["Material Output"]
    made.node_tree.links.new(node.outputs[0], output.inputs["Surface"])


def ball(name: str) -> None:
    """A ball in the middle of the picture, on a grey floor below a sky and a lamp."""
    fresh(sky=8.0)
    floor = bpy.data.materials["floor"].node_tree.nodes["Principled BSDF"]
    floor.inputs["Base Color"].default_value = (0.4, 0.4, 0.4, 1)
    made = material("ball", **BALLS.get(name, {}))
    if name == "metallic":
        metallic(made)
    thing = add(bpy.ops.mesh.primitive_uv_sphere_add, made, segments=64, ring_count=32)
    thing.location = (0, 0, 1)
    thing.data.shade_smooth()
    lamp("AREA", 200, (-2, -4, 4), (0.8, -0.4, 0), size=2.0)
    eye = bpy.context.scene.camera
    eye.location, eye.data.lens = (0, -6, 2.5), 85
    eye.rotation_euler = (Vector((0, 0, 1)) - eye.location).to_track_quat("-Z", "Y").to_euler()


def main(folder: Path, side: int, names: list[str]) -> None:
    sys.path.insert(0, str(ROOT))
    import blender

    blender.register()
    for name in names or [*BALLS, *["metallic"] * (bpy.app.version >= (4, 3))]:
        ball(name)
        cycles, pymlt = bpy.context.scene.cycles, bpy.context.scene.pymlt
        cycles.sample_clamp_indirect = cycles.blur_glossy = 0
        pymlt.path.rr_depth = 300  # since walks in wax are long
        render(folder / f"{name}.exr", "PYMLT", size=(side, side))
        render(folder / f"{name}-cycles.exr", "CYCLES", size=(side, side))


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3:])
