"""Lamps, whose power Blender counts in watts (suns: watts per square metre)."""

import math

import numpy as np

from pymlt.formats.imported import Imported, rgb

from .camera import unscaled

FLIPPED = np.diag([1.0, -1.0, -1.0, 1.0])  #: lamps shine along their -z
PROFILE = 256  #: texels across the beam of a spot


def lamp(light, to_world: np.ndarray, made: Imported) -> dict:
    """The plug-in of a lamp; a lamp with a size is a shape that glows."""
    colour = np.array(light.color) * light.energy * 2 ** getattr(light, "exposure", 0)
    if getattr(light, "use_temperature", False):
        colour *= light.temperature_color
    if not getattr(light, "normalize", True):
        made.warn("the option Normalize of lights is taken as set")
    if light.node_tree and light.use_nodes:
        made.warn("nodes of lights are left out")
    return LAMPS[light.type](light, colour, unscaled(to_world), to_world, made)


def sun(light, colour, placed, _, made: Imported) -> dict:
    if light.angle > math.radians(1):
        made.warn("suns have no size: their shadows are sharp")
    direction = (-placed[:3, 2]).tolist()
    return {"type": "directional", "irradiance": rgb(colour), "direction": direction}


def point(light, colour, placed, _, made: Imported) -> dict:
    """Of power P: intensity P / 4 pi; a sphere of radius r has the radiance P / (2 pi r)^2."""
    radius = light.shadow_soft_size
    if not radius:
        intensity = rgb(colour / (4 * math.pi))
        return {"type": "point", "intensity": intensity, "to_world": placed}
    radiance = rgb(colour / (2 * math.pi * radius) ** 2)
    return glowing("sphere", placed @ np.diag([radius, radius, radius, 1]), radiance)


def spot(light, colour, placed, _, made: Imported) -> dict:
    """As bright as a point within the cone, however narrow that is."""
    if light.shadow_soft_size:
        made.warn("spots have no size: their shadows are sharp")
    half = min(light.spot_size / 2, math.radians(89))
    beam = {"cutoff_angle": math.degrees(half), "beam_width": math.degrees(half)}
    texture = {"type": "bitmap", "data": spot_profile(half, light.spot_blend), "raw": True}
    return {
        "type": "spot",
        "intensity": rgb(colour / (4 * math.pi)),
        "to_world": placed @ FLIPPED,
        "texture": texture,
        **beam,
    }


def spot_profile(half: float, blend: float) -> np.ndarray:
    """How bright the beam is on a plane across it: (PROFILE, PROFILE).

    Blender's blend softens the share `blend` of 1 - cos by a smooth step.
    """
    across = (np.arange(PROFILE) + 0.5) / PROFILE * 2 - 1
    tangent = np.hypot(across[:, None], across) * math.tan(half)
    cosine = 1 / np.sqrt(1 + tangent**2)
    inner = max(blend * (1 - math.cos(half)), 1e-6)
    t = np.clip((cosine - math.cos(half)) / inner, 0, 1)
    return (t * t * (3 - 2 * t)).astype(np.float32)


def area(light, colour, placed, to_world, made: Imported) -> dict:
    """Of power P and area A: the radiance is P / pi A."""
    if light.spread < math.pi * 0.999:
        made.warn("the spread of area lights is left out")
    sides = np.linalg.norm(to_world[:3, :2], axis=0) * light.size
    if light.shape in ("RECTANGLE", "ELLIPSE"):
        sides[1] *= light.size_y / light.size
    round_ = light.shape in ("DISK", "ELLIPSE")
    size = sides[0] * sides[1] * (math.pi / 4 if round_ else 1)
    placed = placed @ FLIPPED @ np.diag([sides[0] / 2, sides[1] / 2, 1, 1])
    return glowing("disk" if round_ else "rectangle", placed, rgb(colour / (math.pi * size)))


def glowing(shape: str, to_world: np.ndarray, radiance: dict) -> dict:
    made = {"type": shape, "to_world": to_world, "bsdf": {"type": "diffuse", "reflectance": 0.0}}
    return made | {"emitter": {"type": "area", "radiance": radiance}}


LAMPS = {"SUN": sun, "POINT": point, "SPOT": spot, "AREA": area}
