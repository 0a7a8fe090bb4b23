"""Textures that have no counterpart, baked by Cycles to images that have one."""

from contextlib import contextmanager

import bpy
from bpy.props import CollectionProperty, PointerProperty, StringProperty

from .export import bakes, unknown_textures


class Bake(bpy.types.PropertyGroup):
    """An image that takes the place of what is plugged into a socket."""

    material: PointerProperty(type=bpy.types.Material)
    node: StringProperty()
    socket: StringProperty()
    image: PointerProperty(type=bpy.types.Image)


def bake(context, resolution: int) -> tuple[int, list[str]]:
    """Bakes the unknown textures of a scene anew.

    Returns how many images there are, and sentences on what could not be baked.
    """
    scene = context.scene
    for thing in scene.objects:
        forget(thing.data)
    unknown = unknown_textures(context.evaluated_depsgraph_get())
    count, failures, seen = 0, [], set()
    with cycles(scene):
        for thing in scene.objects:
            wanted = [m for m in materials(thing) if m.name_full in unknown]
            if not wanted or thing.data in seen:
                continue
            seen.add(thing.data)
            try:
                count += bake_object(context, thing, wanted, unknown, resolution)
            except (RuntimeError, ValueError) as error:
                forget(thing.data)
                failures.append(f"{thing.name} could not be baked: {plain(error)}.")
    return count, failures


def plain(error: Exception) -> str:
    """What an operator says, without the words that stand before it."""
    text = str(error).strip().splitlines()[0].removeprefix("Error: ")
    return text.rstrip(".")


def materials(thing) -> list:
    """The materials of an object, each once."""
    return list({slot.material: None for slot in thing.material_slots if slot.material})


def forget(data) -> None:
    """Removes the baked images of a mesh, and their UV map."""
    if not isinstance(data, bpy.types.Mesh) or data.library:
        return
    for made in data.pymlt_bakes:
        if made.image:
            bpy.data.images.remove(made.image)
    data.pymlt_bakes.clear()
    if layer := data.uv_layers.get(bakes.LAYER):
        data.uv_layers.remove(layer)


@contextmanager
def cycles(scene):
    """Cycles as the engine, with few samples, since nothing is lit."""
    before = scene.render.engine, scene.cycles.samples
    scene.render.engine, scene.cycles.samples = "CYCLES", 8
    try:
        yield
    finally:
        scene.render.engine, scene.cycles.samples = before


def bake_object(context, thing, wanted: list, unknown: dict, resolution: int) -> int:
    """Bakes the sockets of these materials of an object; returns how many."""
    if thing.type != "MESH":
        raise ValueError("it is no mesh; convert it to one")
    if thing.data.library:
        raise ValueError("it belongs to another file")
    if thing.hide_render or not thing.visible_get():
        raise ValueError("it is hidden")
    with alone(context, thing):
        unwrap(thing)
        for material in wanted:
            for node, socket in unknown[material.name_full]:
                image = new_image(material, socket, resolution)
                made = thing.data.pymlt_bakes.add()
                made.material, made.node, made.socket, made.image = material, node, socket, image
                with targets(thing, material, node, socket, image):
                    bpy.ops.object.bake(
                        type="EMIT", target="IMAGE_TEXTURES", save_mode="INTERNAL", margin=4,
                        uv_layer=bakes.LAYER,
                    )  # fmt: skip
                image.pack()
    return sum(len(unknown[material.name_full]) for material in wanted)


@contextmanager
def alone(context, thing):
    """An object as the only one that is selected."""
    objects = context.view_layer.objects
    before, active = context.selected_objects, objects.active
    for other in before:
        other.select_set(False)
    thing.select_set(True)
    objects.active = thing
    try:
        yield
    finally:
        thing.select_set(False)
        for other in before:
            other.select_set(True)
        objects.active = active


def unwrap(thing) -> None:
    """Gives a mesh a UV map on which no faces lie above each other."""
    layers = thing.data.uv_layers
    shown = layers.active_index
    layers.new(name=bakes.LAYER)
    if bakes.LAYER not in layers:
        raise ValueError("it has no room for another UV map")
    layers.active = layers[bakes.LAYER]
    try:
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.uv.smart_project(island_margin=0.01)
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")
        layers.active_index = max(shown, 0)


def new_image(material, socket: str, resolution: int):
    """An image of linear values."""
    name = f"{material.name} {socket} baked"
    image = bpy.data.images.new(name, resolution, resolution, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    return image


@contextmanager
def targets(thing, material, node: str, socket: str, image):
    """What feeds a socket glows, and is baked to `image`; other materials to one that is lost."""
    lost = bpy.data.images.new("pymlt lost", 4, 4)
    added = []
    tree = material.node_tree
    output = tree.get_output_node("CYCLES").inputs["Surface"]
    before = [link.from_socket for link in output.links]
    try:
        for other in materials(thing):
            target = other.node_tree.nodes.new("ShaderNodeTexImage")
            added.append((other.node_tree, target))
            target.image = image if other == material else lost
            other.node_tree.nodes.active = target
        glow = tree.nodes.new("ShaderNodeEmission")
        added.append((tree, glow))
        fed = next(s for s in tree.nodes[node].inputs if s.identifier == socket)
        tree.links.new(fed.links[0].from_socket, glow.inputs["Color"])
        tree.links.new(glow.outputs[0], output)
        yield
    finally:
        for other, made in added:
            other.nodes.remove(made)
        for link in before:
            tree.links.new(link, output)
        bpy.data.images.remove(lost)


class BakeOperator(bpy.types.Operator):
    """Let Cycles bake textures that are left out to images"""

    bl_idname = "pymlt.bake"
    bl_label = "Bake Textures"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012

    @classmethod
    def poll(cls, context) -> bool:
        return context.mode == "OBJECT"

    def execute(self, context) -> set[str]:
        count, failures = bake(context, context.scene.pymlt.bake_resolution)
        for sentence in failures:
            self.report({"WARNING"}, sentence)
        self.report({"INFO"}, f"{count} images baked")
        return {"FINISHED"}


class ForgetOperator(bpy.types.Operator):
    """Remove the baked images of all objects"""

    bl_idname = "pymlt.forget_bakes"
    bl_label = "Remove Baked Textures"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012

    def execute(self, context) -> set[str]:
        for thing in context.scene.objects:
            forget(thing.data)
        return {"FINISHED"}


CLASSES = (Bake, BakeOperator, ForgetOperator)


def register() -> None:
    for known in CLASSES:
        bpy.utils.register_class(known)
    bpy.types.Mesh.pymlt_bakes = CollectionProperty(type=Bake)


def unregister() -> None:
    del bpy.types.Mesh.pymlt_bakes
    for known in reversed(CLASSES):
        bpy.utils.unregister_class(known)
