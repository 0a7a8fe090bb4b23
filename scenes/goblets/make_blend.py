"""Makes goblets.blend, this scene for Blender: python make_blend.py [PATH]

Python needs pymlt and Blender as a module (`pip install bpy`). The numbers are those of scene.xml.
"""

import math
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

import pymlt as mlt

HERE = Path(__file__).resolve().parent
AXES = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])  #: up is z in Blender
TURNED = np.diag([-1.0, 1.0, -1.0, 1.0])  #: cameras and lamps look along -z there
IOR = 1.5046 / 1.000277  #: glass in air, pymlt's default
GLASSES = ("amber_goblet", "blue_goblet", "green_tumbler", "ruby_ball")


def place(to_world=None, turned=False) -> Matrix:
    return Matrix(AXES @ np.array(to_world) @ (TURNED if turned else np.eye(4)))


def at(center) -> Matrix:
    return place(mlt.Transform.translate(center))


def material(name: str, shader: str, colour, **sockets):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.remove(nodes["Principled BSDF"])
    node = nodes.new(f"ShaderNodeBsdf{shader}")
    node.inputs["Color"].default_value = (*colour, 1)
    for key, value in sockets.items():
        node.inputs[key].default_value = value
    links.new(node.outputs[0], nodes["Material Output"].inputs["Surface"])
    return made


def add(name: str, to_world: Matrix, surface=None, smooth=True):
    """Names, places and paints the object that an operator has just made."""
    made = bpy.context.object
    made.name, made.matrix_world = name, to_world
    if surface:
        made.data.name = name
        made.data.materials.append(surface)
        if smooth:
            made.data.shade_smooth()
    return made


def table(shape: dict) -> None:
    bpy.ops.mesh.primitive_circle_add(vertices=256, radius=1, fill_type="NGON")
    paint = material("table", "Diffuse", shape["bsdf"]["reflectance"]["value"])
    add("table", place(shape["to_world"]), paint, smooth=False)


def glass(name: str, shape: dict) -> None:
    # Light that enters and leaves is filtered by Blender's colour once, by pymlt's twice.
    colour = np.square(shape["bsdf"]["specular_transmittance"]["value"])
    if shape["type"] == "sphere":
        bpy.ops.mesh.primitive_uv_sphere_add(segments=128, ring_count=64, radius=shape["radius"])
        where = at(shape["center"])
    else:
        bpy.ops.wm.ply_import(filepath=shape["filename"])
        where = place(shape["to_world"])
    add(name, where, material(name, "Glass", colour, Roughness=0.0, IOR=IOR))


def radiance(shape: dict, area: float):
    """Blender's colour of a lamp, and its power, from radiance."""
    values = np.array(shape["emitter"]["radiance"]["value"])
    return values / values.max(), values.max() * math.pi * area


def lamp(shape: dict) -> None:
    bpy.ops.object.light_add(type="POINT")
    made = add("lamp", at(shape["center"])).data
    made.shadow_soft_size = shape["radius"]
    made.color, made.energy = radiance(shape, 4 * math.pi * shape["radius"] ** 2)


def window(shape: dict) -> None:
    to_world = np.array(shape["to_world"])
    sides = np.linalg.norm(to_world[:3, :2], axis=0)
    to_world[:3, :2] /= sides
    bpy.ops.object.light_add(type="AREA")
    made = add("window", place(to_world, turned=True)).data
    made.shape, made.size, made.size_y = "RECTANGLE", *(2 * sides)
    made.color, made.energy = radiance(shape, 4 * sides[0] * sides[1])


def sky(emitter: dict) -> None:
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    colour = (*emitter["radiance"]["value"], 1)
    world.node_tree.nodes["Background"].inputs["Color"].default_value = colour
    bpy.context.scene.world = world


def camera(sensor: dict) -> None:
    bpy.ops.object.camera_add()
    made = add("camera", place(sensor["to_world"], turned=True))
    made.data.sensor_fit, made.data.angle = "HORIZONTAL", math.radians(sensor["fov"])
    bpy.context.scene.camera = made


def settings(integrator: dict) -> None:
    """Those of the gallery's picture."""
    scene = bpy.context.scene
    scene.render.engine = "PYMLT"
    scene.render.resolution_x, scene.render.resolution_y = 1280, 720
    scene.view_settings.view_transform = "Standard"
    scene.pymlt.integrator, scene.pymlt.mlt.max_depth = integrator["type"], integrator["max_depth"]
    scene.pymlt.samples, scene.pymlt.time, scene.pymlt.error = 400, 0, 0
    scene.pymlt.denoise = True
    scene.pymlt.preview_integrator = "bdpt"


def make(path: Path) -> None:
    """Writes the file; the extension is registered."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    described = mlt.scenes.goblets()
    table(described["table"])
    for name in GLASSES:
        glass(name, described[name])
    lamp(described["lamp"])
    window(described["window"])
    sky(described["emitter"])
    camera(described["sensor"])
    settings(described["integrator"])
    bpy.ops.wm.save_as_mainfile(filepath=str(path.resolve()), compress=True)


def main(path: Path) -> None:
    sys.path.insert(0, str(HERE.parents[1]))
    import blender

    blender.register()
    make(path)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "goblets.blend")
