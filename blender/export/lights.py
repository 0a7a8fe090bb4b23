"""Lamps, whose power Blender counts in watts (suns: watts per square metre)."""

import math

import numpy as np

from pymlt.formats.imported import Imported, rgb

from . import beams
from .camera import unscaled

FLIPPED = np.diag([1.0, -1.0, -1.0, 1.0])  #: lamps shine along their -z
PASSED = {"type": "null"}
LIGHTS = ("constant", "directional", "envmap", "goniometric", "point")
SHARP = math.radians(0.01)  #: angle of a sun below which it has no size

NARROWEST = 0.2  #: radians; the lights of a narrower spread would be seen as dots


def lamp(light, to_world: np.ndarray, made: Imported) -> list[dict]:
    """The plug-ins of a lamp; a lamp with a size is a shape that glows, or many without."""
    colour = np.array(light.color) * light.energy * 2 ** getattr(light, "exposure", 0)
    if getattr(light, "use_temperature", False):
        colour *= light.temperature_color
    if not getattr(light, "normalize", True):
        made.warn("the option Normalize of lights is taken as set")
    if light.node_tree and light.use_nodes:
        made.warn("nodes of lights are left out")
    if not light.use_shadow:
        made.warn("lights without shadows cast them")
    return LAMPS[light.type](light, colour, unscaled(to_world), to_world, made)


def sun(light, colour, placed, *_) -> list[dict]:
    """A disk of the sky whose irradiance is `colour`."""
    if light.angle < SHARP:
        direction = (-placed[:3, 2]).tolist()
        return [{"type": "directional", "irradiance": rgb(colour), "direction": direction}]
    half = light.angle / 2
    disk = beams.image(beams.rows(half, lambda theta: theta < half), colour)
    turned = beams.upright(placed) @ beams.BACKWARDS
    turned[:3, 3] = 0
    scale = 1 / (math.pi * math.sin(half) ** 2)
    return [{"type": "envmap", "data": disk, "scale": scale, "to_world": turned}]


def point(light, colour, placed, *_) -> list[dict]:
    """A power P is an intensity P / 4 pi; a sphere of radius r has the radiance P / (2 pi r)^2."""
    radius = light.shadow_soft_size
    if not radius:
        intensity = rgb(colour / (4 * math.pi))
        return [{"type": "point", "intensity": intensity, "to_world": placed}]
    radiance = rgb(colour / (2 * math.pi * radius) ** 2)
    return [glowing("sphere", placed @ np.diag([radius, radius, radius, 1]), radiance)]


def spot(light, colour, placed, _, made: Imported) -> list[dict]:
    """As bright as a point within the cone, however narrow that is.

    Blender's blend softens the share `blend` of 1 - cos by a smooth step.
    """
    half = light.spot_size / 2
    height = 1 - math.cos(half)

    def profile(theta: np.ndarray) -> np.ndarray:
        t = (np.cos(theta) - 1 + height) / (height * max(light.spot_blend, 1e-6))
        t = np.clip(t, 0, 1)
        return t * t * (3 - 2 * t)

    radius = light.shadow_soft_size
    if radius:
        made.warn("mirrors do not show spots")
    places = radius * beams.lattice(beams.LEAST if radius else 1, disk=True)
    return beams.lamps(beams.rows(half, profile), colour / (4 * math.pi), placed, places)


def area(light, colour, placed, to_world, made: Imported) -> list[dict]:
    """A power P on an area A is a radiance P / pi A."""
    sides = np.linalg.norm(to_world[:3, :2], axis=0) * light.size
    if light.shape in ("RECTANGLE", "ELLIPSE"):
        sides[1] *= light.size_y / light.size
    round_ = light.shape in ("DISK", "ELLIPSE")
    placed = placed @ np.diag([sides[0] / 2, sides[1] / 2, 1, 1])
    if light.spread < math.pi * 0.999:
        made.warn("mirrors do not show areas with a spread")
        if light.spread < NARROWEST:
            made.warn(f"areas have a spread of at least {math.degrees(NARROWEST):.2g} degrees")
        return spread(light.spread / 2, colour / math.pi, placed, round_)
    size = sides[0] * sides[1] * (math.pi / 4 if round_ else 1)
    radiance = rgb(colour / (math.pi * size))
    return [glowing("disk" if round_ else "rectangle", placed @ FLIPPED, radiance)]


def spread(half: float, colour, placed, round_: bool) -> list[dict]:
    """An area behind a grid, which lets (tan half - tan) pass; the same power as without it."""
    half = max(half, NARROWEST / 2)
    tangent = math.tan(half)

    def profile(theta: np.ndarray) -> np.ndarray:
        theta = np.minimum(theta, half)
        return (tangent - np.tan(theta)) * np.cos(theta) / (tangent - half)

    # So many that at the distance of one side forty of them light a point.
    count = max(int(13 / tangent**2), beams.LEAST)
    places = beams.lattice(count, disk=round_)
    return beams.lamps(beams.rows(half, profile), colour, placed, places)


def glowing(shape: str, to_world: np.ndarray, radiance: dict) -> dict:
    """A lamp with a size, which light passes, as in Blender."""
    emitter = {"type": "area", "radiance": radiance}
    return {"type": shape, "to_world": to_world, "bsdf": PASSED, "emitter": emitter}


def is_seen(plugin: dict) -> bool:
    """Whether the camera sees a lamp."""
    return plugin["type"] == "envmap" or plugin.get("bsdf") == PASSED


def is_light(plugin) -> bool:
    """Whether a plug-in of a scene dict is a lamp or the world, neither of which is opaque."""
    return isinstance(plugin, dict) and (plugin["type"] in LIGHTS or plugin.get("bsdf") == PASSED)


LAMPS = {"SUN": sun, "POINT": point, "SPOT": spot, "AREA": area}
