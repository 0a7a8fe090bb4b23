"""Run by Python with `bpy`: exports a scene as glTF and USD, and writes what its camera sees.

Also Blender's default cube below one lamp at a time, with the picture of Cycles.
"""

import json
import math
import sys
from pathlib import Path

import bpy
from blender_material import material
from mathutils import Vector

WIDTH, HEIGHT = 32, 18


def add(make, *, surface, **options):
    make(**options)
    bpy.context.object.data.materials.append(surface)
    bpy.ops.object.shade_smooth()


def build():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    mesh = bpy.ops.mesh
    add(mesh.primitive_plane_add, size=6, surface=material("floor", Base_Color=(0.8, 0.5, 0.2, 1)))
    metal = material("metal", Metallic=1.0, Roughness=0.2)
    add(mesh.primitive_uv_sphere_add, location=(0, 0, 1), surface=metal)
    glass = material("glass", Transmission_Weight=1.0, Roughness=0.0, IOR=1.5)
    add(mesh.primitive_cube_add, location=(1.8, 0.3, 0.6), rotation=(0.1, 0.2, 0.3), surface=glass)
    bpy.context.object.scale = (0.6, 0.4, 0.5)
    glow = material("glow", Emission_Color=(1, 0.8, 0.5, 1), Emission_Strength=2.0)
    add(mesh.primitive_monkey_add, size=1.4, location=(-1.8, 0.3, 0.7), surface=glow)
    for kind in ("POINT", "SUN", "SPOT"):
        bpy.ops.object.light_add(type=kind, location=(1, -2, 4))
    bpy.ops.object.camera_add(location=(0.5, -7, 3), rotation=(1.2, 0, 0.05))
    bpy.context.scene.camera = bpy.context.object
    bpy.context.scene.render.resolution_x = 640
    bpy.context.scene.render.resolution_y = 360
    bpy.context.view_layer.update()


def seen():
    """Where the rays through the middles of the pixels end; None where nothing is."""
    scene, camera = bpy.context.scene, bpy.context.scene.camera
    corners = [camera.matrix_world @ corner for corner in camera.data.view_frame(scene=scene)]
    right_top, _, left_bottom, left_top = corners
    origin = camera.matrix_world.translation
    found = []
    for y in range(HEIGHT):
        for x in range(WIDTH):
            across = left_top + (right_top - left_top) * ((x + 0.5) / WIDTH)
            down = (left_bottom - left_top) * ((y + 0.5) / HEIGHT)
            ray = Vector(across + down - origin).normalized()
            graph = bpy.context.evaluated_depsgraph_get()
            hit, place, *_ = scene.ray_cast(graph, origin, ray)
            found.append(list(place) if hit else None)
    return found


def build_cube(lamp):
    bpy.ops.wm.read_factory_settings()
    bpy.context.scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    light = bpy.data.objects["Light"]
    if lamp == "glow":
        bpy.data.objects.remove(light)
        glow = material("glow", Emission_Color=(1, 0.8, 0.5, 1), Emission_Strength=20.0)
        # Both faces of a mesh glow in Blender, the outer one here: this plane looks at the cube.
        turned = {"location": (4, 1, 6), "rotation": (math.pi, 0, 0)}
        add(bpy.ops.mesh.primitive_plane_add, size=2, surface=glow, **turned)
        return
    light.data.type = lamp
    light.rotation_euler = (-light.location).to_track_quat("-Z", "Y").to_euler()
    if lamp == "SUN":
        bpy.data.lights["Light"].energy = 3


def render(path):
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples = "CYCLES", 64
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    scene.render.resolution_x, scene.render.resolution_y = 64, 36
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def export(path, kind="GLB"):
    bpy.ops.export_scene.gltf(
        filepath=str(path), export_format=kind, export_cameras=True, export_lights=True
    )


def export_usd(path):
    bpy.ops.wm.usd_export(filepath=str(path))


def main(folder: Path) -> None:
    build()
    export_usd(folder / "scene.usdc")
    for kind, name in (("GLB", "scene.glb"), ("GLTF_SEPARATE", "scene.gltf")):
        export(folder / name, kind)
    (folder / "seen.json").write_text(json.dumps(seen()))
    for lamp in ("POINT", "SUN", "SPOT", "AREA", "glow"):
        build_cube(lamp)
        render(folder / f"{lamp}.exr")
        export(folder / f"{lamp}.glb")
        export_usd(folder / f"{lamp}.usdc")


main(Path(sys.argv[1]))
