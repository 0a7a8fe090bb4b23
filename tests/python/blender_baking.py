"""Run by Python with `bpy`: textures that have no counterpart, baked by the extension.

Writes procedural-unbaked.exr, procedural.exr, procedural-forgotten.exr, procedural-cycles.exr and
facts.json into a folder.
"""

import json
import sys
from pathlib import Path

import bpy
from blender_engine import ROOT, add, fresh, lamp, render
from blender_material import material


def plugged(made, node, output: str | int, socket: str, **values):
    """A new node that feeds a socket of the Principled BSDF, by its object's coordinates."""
    tree = made.node_tree
    new = tree.nodes.new(node)
    for name, value in values.items():
        new.inputs[name].default_value = value
    place = tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(place.outputs["Object"], new.inputs["Vector"])
    tree.links.new(new.outputs[output], tree.nodes["Principled BSDF"].inputs[socket])
    return new


def grouped(made) -> None:
    """A group of nodes that feeds the colour: checks of two colours."""
    inner = bpy.data.node_groups.new("checks", "ShaderNodeTree")
    inner.interface.new_socket("Color", in_out="OUTPUT", socket_type="NodeSocketColor")
    checks, end = (inner.nodes.new(n) for n in ("ShaderNodeTexChecker", "NodeGroupOutput"))
    checks.inputs["Color1"].default_value = (0.8, 0.1, 0.1, 1)
    checks.inputs["Color2"].default_value = (0.1, 0.1, 0.8, 1)
    checks.inputs["Scale"].default_value = 2.0
    inner.links.new(checks.outputs["Color"], end.inputs["Color"])
    group = made.node_tree.nodes.new("ShaderNodeGroup")
    group.node_tree = inner
    principled = made.node_tree.nodes["Principled BSDF"]
    made.node_tree.links.new(group.outputs[0], principled.inputs["Base Color"])


def procedural():
    """A floor of noise, a cube of a group on some faces, and a text, which is no mesh."""
    fresh(sky=0.5)
    floor = bpy.data.materials["floor"]
    plugged(floor, "ShaderNodeTexVoronoi", "Color", "Base Color", Scale=0.4)
    plugged(floor, "ShaderNodeTexGradient", 1, "Roughness")
    checks, plain = material("checks"), material("plain", Base_Color=(0.2, 0.7, 0.2, 1))
    grouped(checks)
    cube = add(bpy.ops.mesh.primitive_cube_add, checks, size=1.5, location=(-1, 0, 0.75))
    cube.data.materials.append(plain)
    cube.data.polygons[5].material_index = 1
    lamp("AREA", 150, (2, -2, 4), (0.5, 0.4, 0), size=1.5)


def state(scene) -> dict:
    """What baking is to leave as it is."""
    return {
        "engine": scene.render.engine,
        "nodes": {m.name: sorted(m.node_tree.nodes.keys()) for m in bpy.data.materials},
        "links": {m.name: len(m.node_tree.links) for m in bpy.data.materials},
        "layers": {m.name: m.uv_layers.active.name for m in bpy.data.meshes if m.uv_layers},
        "selected": [thing.name for thing in bpy.context.selected_objects],
    }


def failures(baking) -> list[list[str]]:
    """What is said of an object that is hidden, and of one that is no mesh."""
    said = [baking.bake(bpy.context, 32)[1]]
    bpy.data.objects["Cube"].hide_render = True
    text = add(bpy.ops.object.text_add, bpy.data.materials["floor"])
    text.data.body = "Hi"
    said.append(baking.bake(bpy.context, 32)[1])
    return said


def main(folder: Path) -> None:
    sys.path.insert(0, str(ROOT))
    import blender
    from blender import baking, left_out

    blender.register()
    procedural()
    scene = bpy.context.scene
    scene.render.engine, scene.pymlt.bake_resolution = "PYMLT", 256
    facts = {"before": state(scene)}
    render(folder / "procedural-unbaked.exr", "PYMLT")
    facts["unbaked"] = left_out.sentences(scene)
    bpy.ops.pymlt.bake()
    facts["after"] = state(scene)
    facts["images"] = sorted(image.name for image in bpy.data.images)
    render(folder / "procedural.exr", "PYMLT")
    facts["baked"] = left_out.sentences(scene)
    render(folder / "procedural-cycles.exr", "CYCLES")
    bpy.ops.pymlt.forget_bakes()
    facts["left"] = sorted(image.name for image in bpy.data.images)
    render(folder / "procedural-forgotten.exr", "PYMLT")
    facts["failures"] = failures(baking)
    (folder / "facts.json").write_text(json.dumps(facts))


main(Path(sys.argv[1]))
