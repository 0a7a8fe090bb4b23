"""Run by Python with `bpy`: lamps with a size or a beam, each by the extension and by Cycles.

Writes NAME.exr, NAME-cycles.exr, and NAME-without.exr, where Cycles renders the lamp without it.
"""

import math
import sys
from pathlib import Path

import bpy
from blender_engine import ROOT, add, fresh, lamp, render

FIRST = {"angle": 0.0, "shadow_soft_size": 0.0, "spot_blend": 0.0, "spread": math.pi}


def diffuse(name: str):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    node = tree.nodes.new("ShaderNodeBsdfDiffuse")
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    return made


def lit(kind: str, *where, **values):
    """A ball above a floor, below a lamp."""
    fresh()
    white = diffuse("white")
    for thing in bpy.context.scene.objects:
        if thing.type == "MESH":
            thing.data.materials[0] = white
    add(bpy.ops.mesh.primitive_uv_sphere_add, white, radius=0.7, location=(0, 0, 1.2))
    lamp(kind, *where, **values)


SPOT = "SPOT", 500, (0.5, -0.5, 4), (0.15, 0.15, 0)
AREA = "AREA", 100, (0.5, -0.5, 3), (0.2, 0.15, 0)
LAMPS = {
    "sun": ("SUN", 3.0, (0, 0, 5), (0.5, 0.4, 0), {"angle": 1.2}),
    "spot-of-a-size": (*SPOT, {"spot_size": 1.2, "spot_blend": 0.2, "shadow_soft_size": 0.5}),
    "spot-blended": (*SPOT, {"spot_size": 1.2, "spot_blend": 1.0, "shadow_soft_size": 0.0}),
    "spot-wide": (*SPOT, {"spot_size": 3.0, "spot_blend": 0.9, "shadow_soft_size": 0.0}),
    "beam": (*AREA, {"spread": 0.6, "shape": "RECTANGLE", "size": 1.5, "size_y": 0.7}),
    "beam-round": (*AREA, {"spread": 1.2, "shape": "ELLIPSE", "size": 1.2, "size_y": 0.6}),
}


def sheared(*where, **values):
    """A lamp that is turned within a parent of other scales."""
    lit(*where, **values)
    thing = bpy.context.object
    bpy.ops.object.empty_add()
    bpy.context.object.scale = (1, 1.5, 1)
    thing.parent = bpy.context.object


def main(folder: Path) -> None:
    sys.path.insert(0, str(ROOT))
    import blender

    blender.register()
    for name, (*where, values) in LAMPS.items():
        lit(*where, **values)
        render(folder / f"{name}.exr", "PYMLT")
        render(folder / f"{name}-cycles.exr", "CYCLES")
        without = FIRST if name != "spot-of-a-size" else {"shadow_soft_size": 0.0}
        lit(*where, **values | {k: v for k, v in without.items() if k in values})
        render(folder / f"{name}-without.exr", "CYCLES")
    for name in ("sun", "beam"):
        *where, values = LAMPS[name]
        sheared(*where, **values)
        render(folder / f"{name}-sheared.exr", "PYMLT")
        render(folder / f"{name}-sheared-cycles.exr", "CYCLES")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
