"""Run by Python with `bpy`: animations by "Render Shot" and by Blender's own "Render Animation".

Writes NAME-KIND-SEED-FRAME.exr into a folder, where KIND is "shot" or "alone".
"""

import sys
from pathlib import Path

import bpy
from blender_engine import ROOT, add, fresh, keyed, lamp
from blender_material import material

SEEDS = 8


def settings(first: int, last: int, step: int = 1, **given) -> None:
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end, scene.frame_step = first, last, step
    render, image = scene.render, scene.render.image_settings
    render.engine = "PYMLT"
    render.resolution_x, render.resolution_y = 32, 18
    render.threads_mode, render.threads = "FIXED", 1
    image.file_format, image.color_depth = "OPEN_EXR", "32"
    for name, value in ({"integrator": "mlt", "time": 0, "error": 0} | given).items():
        setattr(scene.pymlt, name, value)


def moving(**given) -> None:
    """A glass ball, a lamp that is its child, and a camera move while the shutter is open."""
    fresh(sky=0.3)
    glass = material("glass", Transmission_Weight=1.0, Roughness=0.0)
    ball = add(bpy.ops.mesh.primitive_uv_sphere_add, glass)
    ball.data.shade_smooth()
    keyed(ball, "location", {1: (-1.5, 0, 1.2), 4: (1.5, 0, 1.2)})
    lamp("POINT", 150, (0.5, 0, 2), shadow_soft_size=0.5)
    bpy.context.object.parent = ball
    keyed(bpy.context.scene.camera, "location", {1: (0, -7, 4), 4: (0.8, -7, 4)})
    settings(1, 4, **given)
    render = bpy.context.scene.render
    render.use_motion_blur, render.motion_blur_shutter = True, 1.5


def painted(**given) -> None:
    """A box that moves, and a floor that has another colour from frame 5 on."""
    fresh(sky=0.5)
    box = add(bpy.ops.mesh.primitive_cube_add, material("box"), size=1.5)
    keyed(box, "location", {1: (-2, 0, 1), 7: (2, 0, 1)})
    floor = bpy.data.materials["floor"].node_tree.nodes["Principled BSDF"].inputs["Base Color"]
    colours = {1: (0.1, 0.4, 0.8, 1), 5: (0.8, 0.3, 0.1, 1)}
    keyed(floor, "default_value", colours, interpolation="CONSTANT")
    settings(1, 7, step=2, **given)


def both(folder: Path, make) -> None:
    """Each animation with several seeds; alone, frames are rendered by `bdpt`."""
    for seed in range(SEEDS):
        make(samples=32, seed=seed)
        save_to(folder / f"{make.__name__}-shot-{seed}-#")
        bpy.ops.pymlt.render_shot()
        make(integrator="bdpt", samples=64, seed=1000 * (seed + 1))
        save_to(folder / f"{make.__name__}-alone-{seed}-#")
        bpy.ops.render.render(animation=True)


def save_to(path: Path) -> None:
    bpy.context.scene.render.filepath = str(path)


def main(folder: Path) -> None:
    sys.path.insert(0, str(ROOT))
    import blender

    blender.register()
    for make in (moving, painted):
        both(folder, make)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
