"""The objects of an evaluated scene, with all that its modifiers and instances make."""

from collections import Counter

import numpy as np

import pymlt as mlt
from pymlt.formats.imported import Imported
from pymlt.formats.solids import give_priorities

from . import bakes, camera, meshes, omissions, world
from .lights import is_seen, lamp
from .materials import Materials
from .motion import Motion, animated, identity


def export(depsgraph, sensor: dict, motion: Motion | None = None) -> Imported:
    """A scene dict, and what could not be carried over, of what `depsgraph` holds now."""
    made = Imported()
    made.add("camera", sensor)
    if surroundings := world.light(depsgraph.scene_eval.world, made):
        made.add("world", surroundings)
    Objects(made, motion or Motion(), depsgraph.scene).add_all(depsgraph)
    give_priorities(made.scene)
    return made


def unknown_textures(depsgraph) -> dict[str, list[tuple[str, str]]]:
    """Materials that have textures without a counterpart: nodes and sockets that are plugged in."""
    objects = Objects(Imported(), Motion(), depsgraph.scene)
    objects.add_all(depsgraph)
    return objects.materials.unknown


def looked_through(depsgraph) -> Imported:
    """A scene as it stands still, seen by its camera if there is one."""
    eye = depsgraph.scene_eval.camera
    return export(depsgraph, final_sensor(None, depsgraph, Motion()) if eye else {})


def stepped_export(engine, depsgraph) -> Imported:
    """A scene dict for a final render: seen by its camera, with the motion of the frame."""
    motion = Motion.of_frame(engine, depsgraph)
    return export(depsgraph, final_sensor(engine, depsgraph, motion), motion)


def final_sensor(engine, depsgraph, motion: Motion) -> dict:
    """The camera of the scene as pymlt's, with the image that is to be rendered."""
    scene = depsgraph.scene_eval
    eye, render = scene.camera, scene.render
    if eye.data.type not in ("PERSP", "ORTHO"):
        raise mlt.SceneError(f"the camera {eye.name!r} should be perspective or orthographic")
    scale = render.resolution_percentage / 100
    size = int(render.resolution_x * scale), int(render.resolution_y * scale)
    projection = eye.calc_matrix_camera(
        depsgraph, x=size[0], y=size[1],
        scale_x=render.pixel_aspect_x, scale_y=render.pixel_aspect_y,
    )  # fmt: skip
    image = camera.film(*size, camera.border(render, *size))
    if depsgraph.scene.pymlt.denoise:  # which needs pixels whose noise is independent
        image["rfilter"] = {"type": "box"}
    places = motion.matrices(("camera",), np.array(eye.matrix_world))
    made = [camera.sensor(place, projection, image, camera.lens(eye)) for place in places]
    return animated(made, motion) | motion.shutter()


class Objects:
    """The objects while they are added."""

    def __init__(self, made: Imported, motion: Motion, scene):
        self._made = made
        self._scene = scene
        self._motion = motion
        self.materials = Materials(made)
        self._shapes: dict[tuple, list[dict]] = {}
        self._placed: list[tuple[tuple, str, tuple]] = []  #: shape, name, identity

    def add_all(self, depsgraph) -> None:
        still: dict[tuple, np.ndarray] = {}
        for instance in depsgraph.object_instances:
            thing, key = instance.object, identity(instance)
            if not instance.show_self:
                continue
            still[key] = np.array(instance.matrix_world)
            if thing.type == "LIGHT":
                self._add_lamp(thing, self._motion.matrices(key, still[key]))
                continue
            omissions.warn(thing, self._scene, self._made)
            if thing.type == "MESH":
                self._placed.append((self._shape(thing), thing.name, key))
        self._add_placed(still)

    def _add_lamp(self, thing, places) -> None:
        if thing.data.type == "SUN":  # which stays where it is when the shutter opens
            places = places[:1]
        lamps = [lamp(thing.data, place, self._made) for place in places]
        for moments in zip(*lamps, strict=True):
            self._made.add(thing.name, animated(list(moments), self._motion))
        if is_seen(lamps[0][0]) and not self._scene.render.film_transparent:
            self._made.warn("lamps with a size are seen by the camera")

    def _shape(self, thing) -> tuple:
        """The key of the shapes that an object is made of."""
        slots = [slot.material for slot in thing.material_slots]
        key = (thing.data.as_pointer(), *(slot and slot.name_full for slot in slots))
        if key not in self._shapes:
            given = thing.original.data
            baked = {i for i, material in enumerate(slots) if bakes.of(given, material)}
            self._shapes[key] = [
                self._part(mesh, slots, i, given) for i, mesh in meshes.parts(thing, baked)
            ]
        return key

    def _part(self, mesh: dict, slots: list, index: int, given) -> dict:
        material = slots[min(index, len(slots) - 1)] if slots else None
        surface = self.materials.surface(material, given)
        if surface.radiance:
            self._made.warn("faces glow on the side of their normals alone")
        glow = surface.radiance and {"emitter": {"type": "area", "radiance": surface.radiance}}
        inside = surface.medium and {"interior": surface.medium}
        return mesh | {"bsdf": surface.bsdf} | (glow or {}) | (inside or {})

    def _add_placed(self, still: dict[tuple, np.ndarray]) -> None:
        uses = Counter(key for key, *_ in self._placed)
        groups: dict[tuple, str] = {}
        for key, name, instance in self._placed:
            shapes = self._shapes[key]
            if uses[key] > 1 and shapes and not any("emitter" in shape for shape in shapes):
                if key not in groups:
                    parts = {f"part_{i}": shape for i, shape in enumerate(shapes)}
                    groups[key] = self._made.add(f"{name}-shapes", {"type": "shapegroup", **parts})
                shapes = [{"type": "instance", "of": {"type": "ref", "id": groups[key]}}]
            places = self._motion.matrices(instance, still[instance])
            for shape in shapes:
                placed = [shape | {"to_world": place} for place in places]
                self._made.add(name, animated(placed, self._motion))
