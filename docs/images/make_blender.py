"""Makes the pictures of Blender's window in docs/blender.md, where the extension is installed:

    xvfb-run -s "-screen 0 1280x800x24" blender --window-geometry 0 0 1280 800 \\
        scenes/goblets/goblets.blend --python docs/images/make_blender.py

Needs ImageMagick and xdotool. It moves the mouse as a user does, one step each time Blender asks.
"""

import os
import subprocess
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
LEFT, TOP = 905, 72  #: where the properties begin once their edges have been dragged there


def mouse(*what):
    return lambda: subprocess.run(["xdotool", *map(str, what)], check=True)


def drag(x: int, y: int, over: int, down: int) -> list[tuple]:
    """Steps that drag what is at a place."""
    steps = [(0.5, mouse("mousemove", x, y)), (0.5, mouse("mousedown", 1))]
    third = mouse("mousemove_relative", "--", over // 3, down // 3)
    return [*steps, *[(0.3, third)] * 3, (0.5, mouse("mouseup", 1))]


def picture(name: str, crop: str, *how: str):
    """A part of the screen, in few colours, which makes the file small."""
    path = HERE / f"blender-{name}.png"

    def make():
        subprocess.run(["import", "-window", "root", path], check=True)
        subprocess.run(["mogrify", "-crop", crop, "+repage", *how, path], check=True)

    return make


def areas(kind: str) -> list:
    return [a for a in bpy.context.window_manager.windows[0].screen.areas if a.type == kind]


def show_settings():
    areas("PROPERTIES")[0].spaces[0].context = "RENDER"


def rendered_view():
    bpy.context.scene.pymlt.preview_time = 60
    space = areas("VIEW_3D")[0].spaces[0]
    space.region_3d.view_perspective, space.region_3d.view_camera_zoom = "CAMERA", 22
    space.shading.type = "RENDERED"


def render():
    areas("VIEW_3D")[0].spaces[0].shading.type = "SOLID"
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = 960, 540
    scene.pymlt.samples, scene.pymlt.time = 0, 150
    bpy.ops.render.render("INVOKE_DEFAULT")


def move_window():
    """There is no window manager that would have placed the window of the render."""
    (found,) = subprocess.check_output(["xdotool", "search", "--name", "Render"]).split()
    for command in (["windowsize", found, "1000", "660"], ["windowmove", found, "0", "0"]):
        subprocess.run(["xdotool", *command], check=True)


STEPS = [
    (2, show_settings),
    *drag(1057, 400, -150, 0),
    (1, rendered_view),
    (12, picture("view", "1280x800+0+0", "-resize", "75%", "-dither", "None", "-colors", "128")),
    *drag(1100, 268, 0, -195),
    (1, mouse("mousemove", 1000, 490)),  # the panel Integrator, which is closed
    (0.5, mouse("click", 1)),
    (4, picture("panel", f"374x703+{LEFT + 1}+{TOP + 1}", "-colors", "64")),
    (1, render),
    (8, move_window),
    (190, picture("render", "1000x660+0+0", "-colors", "256")),
    (1, lambda: os._exit(0)),
]


def step() -> float | None:
    STEPS.pop(0)[1]()
    return STEPS[0][0]


bpy.app.timers.register(step, first_interval=STEPS[0][0])
