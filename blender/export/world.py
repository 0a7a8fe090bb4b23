"""The world: an even colour, or an image of the surroundings."""

import numpy as np
from mathutils import Euler

from pymlt.formats.imported import Imported, rgb

from .images import colours, samples
from .textures import source

#: The middle of an equirectangular image is at +x in Blender, at +z in `envmap`; up is z, y.
AXES = np.array([[0.0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]])


def light(world, made: Imported) -> dict | None:
    """The emitter that surrounds the scene; None where it is black."""
    if world is None:
        return None
    output = world.node_tree and world.node_tree.get_output_node("CYCLES")
    if not output:
        return even(world.color)
    if source(output.inputs["Volume"]):
        made.warn("the volume of the world is left out")
    found = source(output.inputs["Surface"])
    if found is None:
        return None
    if found.node.type not in ("BACKGROUND", "EMISSION"):
        made.warn(f"the shader {found.node.bl_label!r} of the world is left out")
        return None
    colour, strength = (found.node.inputs[name] for name in ("Color", "Strength"))
    factor, image = strength.default_value, source(colour)
    if image is not None and image.node.type == "TEX_ENVIRONMENT" and image.node.image:
        return surroundings(image.node, factor, made)
    if image is not None:
        made.warn(f"the node {image.node.bl_label!r} of the world is left out")
    return even([factor * value for value in colour.default_value[:3]])


def even(colour) -> dict | None:
    return {"type": "constant", "radiance": rgb(colour)} if any(colour) else None


def surroundings(node, factor: float, made: Imported) -> dict | None:
    values = samples(node.image, made)
    if values is None:
        return None
    if node.projection != "EQUIRECTANGULAR":
        made.warn("images of the world are taken as equirectangular")
    turned = np.eye(4)
    mapping = source(node.inputs["Vector"])
    if mapping is not None and mapping.node.type == "MAPPING":
        # The node turns directions before they are looked up.
        turn = Euler(mapping.node.inputs["Rotation"].default_value).to_matrix()
        turned[:3, :3] = np.array(turn).T
    image = np.ascontiguousarray(colours(values)[::-1])
    return {"type": "envmap", "data": image, "scale": factor, "to_world": turned @ AXES}
