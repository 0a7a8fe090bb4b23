"""What of each open scene is left out: what its last export has said."""

import bpy

import pymlt as mlt

from .export import looked_through

_found: dict[str, list[str]] = {}  #: by the name of the scene
_changed: set[str] = set()  #: scenes that are not what they were


def note(scene, warnings: list[str]) -> None:
    _found[scene.name_full] = list(warnings)
    _changed.discard(scene.name_full)


def sentences(scene) -> list[str]:
    """What a panel says of a scene."""
    found = _found.get(scene.name_full)
    if found is None:
        return ["Not looked for yet."]
    said = [f"{text[0].upper()}{text[1:]}." for text in found] or ["Nothing is left out."]
    return said + ["The scene has changed since."] * (scene.name_full in _changed)


class LookOperator(bpy.types.Operator):
    """Export the scene to see what of it is left out"""

    bl_idname = "pymlt.look"
    bl_label = "Look for It"

    def execute(self, context) -> set[str]:
        depsgraph = context.evaluated_depsgraph_get()
        try:
            note(context.scene, looked_through(depsgraph).warnings)
        except mlt.Error as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


@bpy.app.handlers.persistent
def changed(scene, depsgraph) -> None:
    if any(not isinstance(update.id, bpy.types.Scene) for update in depsgraph.updates):
        _changed.add(scene.name_full)


@bpy.app.handlers.persistent
def forget(*_) -> None:
    """Another file is open."""
    _found.clear()


def register() -> None:
    bpy.utils.register_class(LookOperator)
    bpy.app.handlers.depsgraph_update_post.append(changed)
    bpy.app.handlers.load_post.append(forget)


def unregister() -> None:
    bpy.app.handlers.load_post.remove(forget)
    bpy.app.handlers.depsgraph_update_post.remove(changed)
    bpy.utils.unregister_class(LookOperator)
