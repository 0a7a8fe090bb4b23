"""Whether the surfaces that glow light a scene, or are details of what is to be lit.

Viewers of glTF bring light along, and models have dials and lamps that glow in it. Their emission
alone would leave the rest in the dark.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..areas import triangle_areas
from ..views import emits, plugins
from .textures import mean_colour

TINY = 1e-300  #: in place of an area of 0
LEAST = 0.02  #: mean radiance of all surfaces that lights a scene


def too_dim(scene: dict[str, Any], unlit: list[dict[str, Any]]) -> bool:
    """Whether meshes alone emit in a scene dict, and too little to light it.

    The emitters of `unlit` materials (KHR_materials_unlit) light nothing, and need no light.
    """
    lights = list(filter(emits, plugins(scene)))
    only_meshes = bool(lights) and all(light["type"] == "mesh" for light in lights)
    shown = {id(emitter) for emitter in unlit}
    shapes = [shape for shape in meshes(scene) if id(shape.get("emitter")) not in shown]
    return only_meshes and bool(shapes) and mean_radiance(shapes) < LEAST


def meshes(scene: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """All of a scene, each with its place in the world; groups once for each of their instances."""
    for plugin in plugins(scene):
        if plugin["type"] == "mesh":
            yield plugin
        if plugin["type"] == "instance":
            for part in plugins(scene[plugin["group"]["id"]]):
                yield part | {"to_world": plugin["to_world"]}


def mean_radiance(shapes: list[dict[str, Any]]) -> float:
    """What meshes emit, averaged over the area of all, glowing or not, and over R, G and B.

    A texture counts with the mean of all its texels, whichever of them the mesh shows.
    """
    emitters = {id(shape.get("emitter")): shape.get("emitter") for shape in shapes}
    areas = dict.fromkeys(emitters, 0.0)
    for shape in shapes:
        triangles = triangle_areas(shape["vertices"], shape["faces"], shape["to_world"])
        areas[id(shape.get("emitter"))] += float(triangles.sum())
    power = sum(
        areas[key] * float(mean_colour(emitter["radiance"]).mean())
        for key, emitter in emitters.items()
        if emitter
    )
    return power / max(sum(areas.values()), TINY)
