"""Render Shot: an animation, as many frames of which are rendered together as can be."""

import os

import bpy
from bpy.props import IntProperty

from pymlt.rendering.windows import MOST_TOGETHER

from .export import Joined
from .together import Together, most_frames


class Shot:
    """An animation while it is rendered."""

    def __init__(self, most: int):
        self._most = most
        self._rendered: dict[str, Together] = {}  #: what was rendered last, by view layer
        self._told: set[str] = set()

    def together(self, engine, depsgraph, described: dict) -> Together | None:
        """The render of the present frame with others; None if it is to be rendered alone."""
        layer, frame = depsgraph.view_layer.name, depsgraph.scene.frame_current
        found = self._rendered.pop(layer, None)
        if found and frame in found.frames:
            if found.shows(frame, described):
                self._rendered[layer] = found
                return found
            change = "things are not where they were when looked at before"
            self._tell(engine, change, frame, "each frame is rendered alone from there on")
            self._most = 1
        found = None  # so that no two renders are in memory
        found = self._ahead(engine, depsgraph, described)
        if found:
            self._rendered[layer] = found
        return found

    def _ahead(self, engine, depsgraph, described: dict) -> Together | None:
        """A render of this frame and some that follow, which are looked at."""
        scene, joined = depsgraph.scene, Joined(described)
        frames = [scene.frame_current]
        coming = frames_to_come(scene)[: self._limit(scene, described["camera"]) - 1]
        for frame in coming:
            change = self._add(joined, engine, depsgraph, frame)
            if change:
                self._tell(engine, change, frame)
                break
            frames.append(frame)
        if coming:
            engine.frame_set(frames[0], subframe=0)
        frames = frames[: power_of_two(len(frames))]
        return Together(joined, frames, scene) if len(frames) > 1 else None

    def _limit(self, scene, sensor: dict) -> int:
        return power_of_two(min(self._most, most_frames(scene, sensor)))

    def _add(self, joined: Joined, engine, depsgraph, frame: int) -> str:
        """Looks at a frame that is to come; says what makes it one of another render."""
        eye = depsgraph.scene.camera
        engine.frame_set(frame, subframe=0)
        if depsgraph.scene.camera != eye:
            return "the camera is another one"
        return joined.add(engine.read(depsgraph).scene)

    def _tell(self, engine, change: str, frame: int, then="another render begins there") -> None:
        """Says why frames are not rendered together: each reason once."""
        if change not in self._told:
            self._told.add(change)
            engine.report({"INFO"}, f"pymlt: {change} in frame {frame}, so {then}")


def power_of_two(most: int) -> int:
    """The largest one that is not more.

    A motion has 2^k steps, which begin and end with the frames if there are 2^j of these.
    """
    return 1 << (most.bit_length() - 1)


def frames_to_come(scene) -> list[int]:
    """The frames that Blender will render after the present one."""
    step, end = max(scene.frame_step, 1), scene.frame_end
    frames = range(scene.frame_current + step, end + 1, step)
    return [f for f in frames if scene.render.use_overwrite or not exists(scene, f)]


def exists(scene, frame: int) -> bool:
    return os.path.exists(bpy.path.abspath(scene.render.frame_path(frame=frame)))


_running: Shot | None = None


def together(engine, depsgraph, described: dict) -> Together | None:
    """The render of the present frame with others of a shot; None if it is to be rendered alone."""
    shot = _running if engine.is_animation else None
    return shot and shot.together(engine, depsgraph, described)


class ShotOperator(bpy.types.Operator):
    """Render the animation, several frames at a time, so that caustics flicker less"""

    bl_idname = "pymlt.render_shot"
    bl_label = "Render Shot"

    together: IntProperty(
        name="Together",
        default=MOST_TOGETHER,
        min=1,
        max=MOST_TOGETHER,
        description="The most frames that are rendered at a time: 1, 2, 4, 8 or 16",
    )

    @classmethod
    def poll(cls, context) -> bool:
        return context.engine == "PYMLT"

    def execute(self, context) -> set[str]:
        return self._render("EXEC_DEFAULT")

    def invoke(self, context, event) -> set[str]:
        """Renders in the background of the window."""
        return self._render("INVOKE_DEFAULT")

    def _render(self, how: str) -> set[str]:
        begin(Shot(self.together))
        try:
            done = bpy.ops.render.render(how, animation=True)
        except RuntimeError as error:
            self.report({"ERROR"}, str(error).strip())
            done = {"CANCELLED"}
        if "RUNNING_MODAL" in done:
            return {"FINISHED"}
        end()
        return done


def begin(shot: Shot) -> None:
    global _running
    _running = shot


@bpy.app.handlers.persistent
def end(*_) -> None:
    """The render has ended, or was cancelled."""
    global _running
    _running = None


def draw_entry(menu, context) -> None:
    if context.engine == "PYMLT":
        menu.layout.operator(ShotOperator.bl_idname, icon="RENDER_ANIMATION")


HANDLERS = (bpy.app.handlers.render_complete, bpy.app.handlers.render_cancel)


def register() -> None:
    bpy.utils.register_class(ShotOperator)
    bpy.types.TOPBAR_MT_render.append(draw_entry)
    for handlers in HANDLERS:
        handlers.append(end)


def unregister() -> None:
    for handlers in HANDLERS:
        handlers.remove(end)
    bpy.types.TOPBAR_MT_render.remove(draw_entry)
    bpy.utils.unregister_class(ShotOperator)
