"""Run by Python with `bpy`: balls with a coat, each by the extension and by Cycles.

Writes NAME.exr and NAME-cycles.exr, and the ball without it as NAME-bare.exr and NAME-without.exr.
"""

import sys
from pathlib import Path

import bpy
from blender_engine import ROOT, add, fresh, lamp, render
from blender_material import material

RED = {"Base_Color": (0.6, 0.1, 0.05, 1)}
COATS = {
    "smooth": RED | {"Coat_Roughness": 0.0},
    "rough": RED | {"Coat_Roughness": 0.3, "Roughness": 0.8},
    "dense": RED | {"Coat_IOR": 2.0, "Coat_Roughness": 0.2},
    "half": RED | {"Coat_Weight": 0.5, "Coat_IOR": 2.0, "Coat_Roughness": 0.2},
    "tinted": {"Base_Color": (0.8, 0.8, 0.8, 1), "Coat_Tint": (0.9, 0.5, 0.2, 1)},
    "metal": {"Base_Color": (0.9, 0.6, 0.2, 1), "Metallic": 1.0, "Coat_Roughness": 0.2},
    "dark-metal": {"Base_Color": (0.3, 0.1, 0.1, 1), "Metallic": 1.0, "Coat_Roughness": 0.2},
    "glass": {"Base_Color": (0.7, 0.9, 1, 1), "Transmission_Weight": 1.0, "Roughness": 0.0},
    "glowing": RED | {"Emission_Color": (1, 1, 1, 1), "Emission_Strength": 0.5, "Coat_IOR": 2.0},
}


def ball(values: dict) -> None:
    """A ball in the middle of the picture, below a sky and a lamp."""
    fresh(sky=0.5)
    bpy.data.objects.remove(bpy.data.objects["Plane"])
    made = material("ball", **values)
    thing = add(bpy.ops.mesh.primitive_uv_sphere_add, made, segments=64, ring_count=32, radius=1.25)
    thing.location = (0, -0.93, 0.52)
    thing.data.shade_smooth()
    lamp("AREA", 200, (-2, -4, 4), (0.8, -0.4, 0), size=2.0)


def main(folder: Path) -> None:
    sys.path.insert(0, str(ROOT))
    import blender

    blender.register()
    for name, values in COATS.items():
        ball({"Coat_Weight": 1.0, "Coat_Roughness": 0.03} | values)
        render(folder / f"{name}.exr", "PYMLT")
        render(folder / f"{name}-cycles.exr", "CYCLES")
        ball(values | {"Coat_Weight": 0.0})
        render(folder / f"{name}-bare.exr", "PYMLT")
        render(folder / f"{name}-without.exr", "CYCLES")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
