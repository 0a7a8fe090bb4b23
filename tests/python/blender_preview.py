"""Run by Python with `bpy`: what the extension does in a 3D view, but for drawing on a screen.

Writes facts.json, and the pixels that would be drawn as .npy, into a folder.
"""

import json
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np
from mathutils import Matrix

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

import blender  # noqa: E402
from blender import preview, viewport  # noqa: E402


class Engine(viewport.Viewport):
    """Blender's part of an engine."""

    def __init__(self):
        self.redraws = 0
        self.texts = []

    def get_preview_pixel_size(self, scene):
        return "2"

    def bind_display_space_shader(self, scene):
        pass

    def unbind_display_space_shader(self):
        pass

    def update_stats(self, stats, info):
        self.texts.append(info)

    def tag_redraw(self):
        self.redraws += 1


def view(turn=0.0):
    """A view of 128 x 72 pixels through the scene's camera, which is turned to the right."""
    scene, graph = bpy.context.scene, bpy.context.evaluated_depsgraph_get()
    matrix = scene.camera.matrix_world @ Matrix.Rotation(-turn, 4, "Y")
    seen = SimpleNamespace(
        view_matrix=matrix.inverted(),
        window_matrix=scene.camera.calc_matrix_camera(graph, x=128, y=72),
        view_perspective="PERSP",
    )
    region = SimpleNamespace(width=128, height=72)
    return SimpleNamespace(region=region, region_data=seen, space_data=None)


def drawn(engine, context) -> np.ndarray:
    """What a view shows in the end."""
    graph, end = bpy.context.evaluated_depsgraph_get(), time.monotonic() + 60
    while time.monotonic() < end:
        engine.view_draw(context, graph)
        if engine._preview.ended:
            break
        time.sleep(0.02)
    engine.view_draw(context, graph)
    return pictures[-1]


pictures = []


def main(folder: Path) -> None:
    blender.register()
    bpy.context.scene.pymlt.preview_time = 1.0
    viewport.draw = lambda pixels, region: pictures.append(pixels)
    built = []
    load = preview.mlt.load_dict
    preview.mlt.load_dict = lambda described: built.append(described) or load(described)
    engine, facts = Engine(), {}
    engine.view_update(view(), bpy.context.evaluated_depsgraph_get())
    np.save(folder / "first.npy", drawn(engine, view()))
    np.save(folder / "turned.npy", drawn(engine, view(0.1)))
    facts["built after turning"] = len(built)
    job = engine._preview._job
    engine.view_draw(view(0.1), bpy.context.evaluated_depsgraph_get())
    facts["went on"] = engine._preview._job is job
    bpy.data.objects["Cube"].location.z = 50
    bpy.context.view_layer.update()
    engine.view_update(view(), bpy.context.evaluated_depsgraph_get())
    facts["stopped"] = job.ended
    np.save(folder / "empty.npy", drawn(engine, view()))
    facts |= {"redraws": engine.redraws, "text": engine.texts[-1]}
    (folder / "facts.json").write_text(json.dumps(facts))


main(Path(sys.argv[1]))
