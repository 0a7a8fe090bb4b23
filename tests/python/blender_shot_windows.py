"""Run by Python with `bpy`: which frames of a shot are rendered together, and with which passes.

Writes facts.json and pictures into a folder.
"""

import json
import sys
from pathlib import Path
from types import SimpleNamespace

import bpy
from blender_engine import ROOT, add, fresh, keyed, lamp
from blender_material import material
from blender_shot import moving, painted, save_to, settings


def small(**given) -> None:
    """A box that moves, in an image of few pixels."""
    fresh(sky=0.3)
    add(bpy.ops.mesh.primitive_cube_add, material("box"), size=1.5)
    keyed(bpy.context.object, "location", {1: (-1, 0, 1), 4: (1, 0, 1)})
    settings(1, 4, **({"samples": 1} | given))
    bpy.context.scene.render.resolution_x = bpy.context.scene.render.resolution_y = 8


def cube():
    return bpy.data.objects["Cube"]


def nothing() -> None:
    pass


def longer() -> None:
    """Seven frames, of which no more than five are to be together."""
    bpy.context.scene.frame_end = 7


def by_path() -> None:
    bpy.context.scene.pymlt.integrator = "path"


def zoom() -> None:
    keyed(bpy.context.scene.camera.data, "lens", {2: 50, 4: 80})


def hide() -> None:
    keyed(cube(), "hide_render", {1: False, 3: True})


def deform() -> None:
    cube().shape_key_add(name="Basis")
    wide = cube().shape_key_add(name="wide")
    wide.data[0].co.x += 1
    keyed(wide, "value", {2: 0.0, 4: 1.0})


def brighten() -> None:
    background = bpy.context.scene.world.node_tree.nodes["Background"]
    keyed(background.inputs["Strength"], "default_value", {2: 0.1, 3: 0.2}, "CONSTANT")


def mirror() -> None:
    keyed(cube(), "scale", {1: (1, 1, 1), 3: (-1, 1, 1)}, "CONSTANT")


def turn() -> None:
    lamp("SUN", 1, (0, 0, 3), angle=0.1)
    keyed(bpy.context.object, "rotation_euler", {2: (0, 0, 0), 3: (0.5, 0, 0)}, "CONSTANT")


def another_layer() -> None:
    bpy.context.scene.view_layers.new("Second")


def cut() -> None:
    scene = bpy.context.scene
    first = scene.camera
    bpy.ops.object.camera_add(location=(0, 0, 8))
    for frame, camera in ((1, first), (3, bpy.context.object)):
        scene.timeline_markers.new("cut", frame=frame).camera = camera


def script() -> None:
    """A script that Blender calls in each frame lifts the box from frame 3 on."""

    def lift(scene, *_) -> None:
        cube().delta_location.z = scene.frame_current > 2

    bpy.app.handlers.frame_change_pre.append(lift)


def ratchet() -> None:
    """A script that lifts the box at frame 3, where it stays."""

    def lift(scene, *_) -> None:
        if scene.frame_current > 2:
            cube().delta_location.z = 1

    bpy.app.handlers.frame_change_pre.append(lift)


CHANGES = (
    nothing, longer, by_path, another_layer,
    zoom, hide, deform, brighten, mirror, turn, cut,
    script, ratchet,
)  # fmt: skip


def watched(shot) -> tuple[list, list]:
    """What shots tell from now on, and which frames they render together."""
    told, windows = [], []
    tell, made = shot.Shot._tell, shot.Together

    def heard(self, engine, change, frame, *then):
        told.append([change, frame])
        tell(self, engine, change, frame, *then)

    def together(joined, frames, scene):
        windows.append(frames)
        return made(joined, frames, scene)

    shot.Shot._tell, shot.Together = heard, together
    return told, windows


def kept(folder: Path) -> None:
    """Frame 2 has a file that is to stay."""
    small()
    save_to(folder / "kept-#")
    bpy.context.scene.render.use_overwrite = False
    (folder / "kept-2.exr").write_bytes(b"kept")
    bpy.ops.pymlt.render_shot()


def entries(shot) -> list[str]:
    """What is in the menu Render, by pymlt and by Cycles."""
    found = []
    layout = SimpleNamespace(operator=lambda name, icon: found.append(name))
    for engine in ("PYMLT", "CYCLES"):
        shot.draw_entry(SimpleNamespace(layout=layout), SimpleNamespace(engine=engine))
    return found


def failure(engine="PYMLT", **given) -> str:
    small(**given)
    bpy.context.scene.render.engine = engine
    try:
        bpy.ops.pymlt.render_shot()
    except RuntimeError as error:
        return str(error)
    return ""


def passes(path: Path, make, **given) -> None:
    """Two frames with a transparent film and all passes, by a shot and as an animation."""
    for kind in ("shot", "alone"):
        make(**given)
        scene = bpy.context.scene
        scene.frame_start, scene.frame_end, scene.frame_step = 2, 3, 1
        scene.render.film_transparent = True
        image = scene.render.image_settings
        if hasattr(image, "media_type"):  # Blender 5
            image.media_type = "MULTI_LAYER_IMAGE"
        image.file_format, image.color_depth = "OPEN_EXR_MULTILAYER", "32"
        save_to(path.with_name(f"{path.name}-{kind}-#"))
        bpy.ops.pymlt.render_shot() if kind == "shot" else bpy.ops.render.render(animation=True)


def main(folder: Path) -> None:
    sys.path.insert(0, str(ROOT))
    import blender
    from blender import shot

    blender.register()
    told, windows = watched(shot)
    facts = {}
    for change in CHANGES:
        small()
        change()
        save_to(folder / f"{change.__name__}-#")
        bpy.ops.pymlt.render_shot(together=5)
        facts[change.__name__] = {"told": told[:], "windows": windows[:]}
        del told[:], windows[:]
        bpy.app.handlers.frame_change_pre.clear()
    kept(folder)
    facts["kept"] = windows[:]
    facts["entries"] = entries(shot)
    facts["by cycles"] = failure("CYCLES")
    facts["by error"] = failure(samples=0, error=5)
    windows.clear()
    passes(folder / "passes", moving, samples=64)
    for denoise in (False, True):
        passes(folder / f"denoised-{denoise}", painted, samples=1, denoise=denoise)
    facts["passes"] = windows
    (folder / "facts.json").write_text(json.dumps(facts))


main(Path(sys.argv[1]))
