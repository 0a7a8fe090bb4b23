"""Lights (UsdLux), which shine along -z. Their radiance is intensity 2^exposure, times the colour.

One nit is one unit of radiance, one lux one unit of irradiance.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from pxr import Usd, UsdGeom, UsdLux

from ... import _core
from ..areas import triangle_areas
from ..imported import Imported, rgb
from .assets import asset, is_small, rgb_pixels

TURNED = np.diag([-1.0, 1, -1, 1])  #: shapes shine along +z
SPHERE_TO_POINT = 1 / 4  #: the intensity of a point over the radiance x area of a sphere
#: What turns the y axis to z.
Z_POLE = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
#: A rectangle as its texture is seen from where it shines: the first row of the image is above.
ROWS_DOWN = np.array([[1.0, 0, 0, 0], [0, -1, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]])


def light(
    prim: Usd.Prim, time: Usd.TimeCode, to_world: np.ndarray, made: Imported
) -> dict[str, Any] | None:
    """A light with a `to_world` in the frame of its prim; None for those that are dark or unknown.

    `to_world` places the prim, for what is normalised is so by its size in the world.
    """
    warn_of_parts(prim, made)
    for kind, make in LIGHTS.items():
        if prim.IsA(kind):
            if not strength(prim, time).any():
                return None
            return make(kind(prim), time, to_world, made)
    made.warn(f"lights of type {prim.GetTypeName()} are left out")
    return None


def warn_of_parts(prim: Usd.Prim, made: Imported) -> None:
    """Names what lights have that is not read."""
    for name in ("diffuse", "specular"):
        attribute = prim.GetAttribute(f"inputs:{name}")
        if attribute and attribute.Get() not in (None, 1):
            made.warn(f"the factor {name!r} of lights is left out: they light alike")
    api = UsdLux.LightAPI(prim)
    for collection in (api.GetLightLinkCollectionAPI(), api.GetShadowLinkCollectionAPI()):
        if not collection.HasNoIncludedPaths() and collection.GetIncludesRel().GetTargets():
            made.warn("links of lights are left out: they light everything")
    if api.GetFiltersRel().GetTargets():
        made.warn("filters of lights are left out")


def strength(prim: Usd.Prim, time: Usd.TimeCode) -> np.ndarray:
    """Radiance in R, G and B, before it is normalised. Raises SceneError for no temperature."""
    api = UsdLux.LightAPI(prim)
    colour = np.array(api.GetColorAttr().Get(time), dtype=float)
    if api.GetEnableColorTemperatureAttr().Get(time):
        kelvin = float(api.GetColorTemperatureAttr().Get(time))
        if not math.isfinite(kelvin):  # for which USD crashes
            raise _core.SceneError(f"{prim.GetPath()}: colorTemperature is {kelvin}, not in kelvin")
        colour *= np.array(UsdLux.BlackbodyTemperatureAsRgb(kelvin))
    exposure = float(api.GetExposureAttr().Get(time))
    return colour * float(api.GetIntensityAttr().Get(time)) * 2.0**exposure


def radiance(prim: Usd.Prim, time: Usd.TimeCode, area: float) -> np.ndarray:
    """What a surface of this area emits: if the light is normalised, less the larger it is."""
    normalised = UsdLux.LightAPI(prim).GetNormalizeAttr().Get(time)
    return strength(prim, time) / (area if normalised else 1)


def emitter(colour: np.ndarray) -> dict[str, Any]:
    return {"type": "area", "radiance": rgb(colour)}


def sphere(
    given: UsdLux.SphereLight, time: Usd.TimeCode, to_world: np.ndarray, made: Imported
) -> dict[str, Any]:
    """A sphere, or a light of no size if it says so or has a cone."""
    prim = given.GetPrim()
    radius = float(given.GetRadiusAttr().Get(time))
    # An ellipsoid counts as the sphere that has its volume.
    scale = abs(np.linalg.det(to_world[:3, :3])) ** (1 / 3)
    area = 4 * math.pi * (radius * scale) ** 2
    shaped = cone(prim, time, made)
    if radius and not given.GetTreatAsPointAttr().Get(time) and not shaped:
        found = emitter(radiance(prim, time, area))
        return {"type": "sphere", "radius": radius, "emitter": found}
    if radius and not given.GetTreatAsPointAttr().Get(time):
        made.warn("a sphere light with a cone becomes a spot of no size")
    # What has no area is taken as normalised.
    power = radiance(prim, time, area) * area if radius else strength(prim, time)
    intensity = rgb(power * SPHERE_TO_POINT)
    if shaped:
        return {"type": "spot", "intensity": intensity, "to_world": TURNED} | shaped
    return {"type": "point", "intensity": intensity}


def cone(prim: Usd.Prim, time: Usd.TimeCode, made: Imported) -> dict[str, float]:
    """The angles of a spot, if a light is shaped so; nothing else."""
    if not prim.HasAPI(UsdLux.ShapingAPI):
        return {}
    api = UsdLux.ShapingAPI(prim)
    if api.GetShapingFocusAttr().Get(time):
        made.warn("the focus of lights is left out")
    file = api.GetShapingIesFileAttr().Get(time)
    if file and file.path:
        made.warn("IES profiles of lights are left out")
    angle = float(api.GetShapingConeAngleAttr().Get(time))
    if not api.GetShapingConeAngleAttr().HasAuthoredValue() or angle >= 180:
        return {}
    softness = min(max(float(api.GetShapingConeSoftnessAttr().Get(time)), 0.0), 1.0)
    if softness:
        made.warn("the edge of a spot light falls off linearly with the angle")
    return {"cutoff_angle": angle, "beam_width": angle * (1 - softness)}


def warn_of_cone(prim: Usd.Prim, time: Usd.TimeCode, made: Imported) -> None:
    """For the lights with an area, which shine into all directions."""
    if cone(prim, time, made):
        made.warn("cones of other lights than spheres are left out")


def disk(
    given: UsdLux.DiskLight, time: Usd.TimeCode, to_world: np.ndarray, made: Imported
) -> dict[str, Any]:
    warn_of_cone(given.GetPrim(), time, made)
    radius = float(given.GetRadiusAttr().Get(time))
    area = math.pi * radius**2 * area_scale(to_world)
    placed = TURNED @ np.diag([radius, radius, 1, 1])
    found = emitter(radiance(given.GetPrim(), time, area))
    return {"type": "disk", "to_world": placed, "emitter": found}


def rectangle(
    given: UsdLux.RectLight, time: Usd.TimeCode, to_world: np.ndarray, made: Imported
) -> dict[str, Any]:
    """One whose texture is seen upright, by those on whom it shines."""
    warn_of_cone(given.GetPrim(), time, made)
    width, height = (float(a.Get(time)) for a in (given.GetWidthAttr(), given.GetHeightAttr()))
    found = emitter(radiance(given.GetPrim(), time, width * height * area_scale(to_world)))
    file = asset(given.GetTextureFileAttr(), time, made)
    if file:
        texture = {"type": "bitmap", "to_uv": ROWS_DOWN, "wrap_mode": "clamp", **file}
        found["radiance"] = {"type": "scale", "scale": found["radiance"], "texture": texture}
    placed = TURNED @ np.diag([width / 2, height / 2, 1, 1])
    return {"type": "rectangle", "to_world": placed, "emitter": found}


def area_scale(to_world: np.ndarray) -> float:
    """How much larger an area in the xy plane is in the world."""
    return float(np.linalg.norm(np.cross(to_world[:3, 0], to_world[:3, 1])))


def cylinder(
    given: UsdLux.CylinderLight, time: Usd.TimeCode, to_world: np.ndarray, made: Imported
) -> dict[str, Any]:
    """One around the x axis, without its ends."""
    warn_of_cone(given.GetPrim(), time, made)
    radius, length = (float(a.Get(time)) for a in (given.GetRadiusAttr(), given.GetLengthAttr()))
    along, *across = np.linalg.norm(to_world[:3, :3], axis=0)
    area = 2 * math.pi * radius * math.sqrt(across[0] * across[1]) * length * along
    ends = {"p0": [-length / 2, 0.0, 0.0], "p1": [length / 2, 0.0, 0.0]}
    found = emitter(radiance(given.GetPrim(), time, area))
    return {"type": "cylinder", "radius": radius, "emitter": found, **ends}


def distant(
    given: UsdLux.DistantLight, time: Usd.TimeCode, to_world: np.ndarray, made: Imported
) -> dict[str, Any]:
    """A light of one direction, with the irradiance of the disk in the sky that USD describes."""
    angle = math.radians(float(given.GetAngleAttr().Get(time))) / 2
    solid = math.pi * math.sin(angle) ** 2 if angle <= math.pi / 2 else math.pi
    if angle:
        made.warn("the angle of distant lights is left out: their shadows have sharp edges")
    prim = given.GetPrim()
    power = radiance(prim, time, solid) * solid if angle else strength(prim, time)
    return {"type": "directional", "irradiance": rgb(power), "to_world": TURNED}


def dome(given: Any, time: Usd.TimeCode, to_world: np.ndarray, made: Imported) -> dict[str, Any]:
    """An environment: what USD and we see in the middle of a map is in the direction +z."""
    placed = {"to_world": Z_POLE} if pole(given) == UsdGeom.Tokens.z else {}
    colour = strength(given.GetPrim(), time)
    file = asset(given.GetTextureFileAttr(), time, made)
    if file is None:
        return {"type": "constant", "radiance": rgb(colour)}
    layout = given.GetTextureFormatAttr().Get(time)
    if layout not in (UsdLux.Tokens.automatic, UsdLux.Tokens.latlong):
        made.warn(f"dome lights of the format {layout!r} are taken as 'latlong'")
    grey = colour.min() == colour.max()
    image = None if grey and not is_small(file) else rgb_pixels(file)
    if image is not None and (image.shape[0] < 2 or image.shape[1] < 3):
        # So few pixels, which some programs write, are one colour.
        return {"type": "constant", "radiance": rgb(image.mean(axis=(0, 1)) * colour)}
    if image is None or grey:
        return {"type": "envmap", "scale": float(colour[0]), **file, **placed}
    return {"type": "envmap", "data": (image * colour).astype(np.float32), **placed}


def make_glow(
    shapes: list[dict[str, Any]],
    prim: Usd.Prim,
    time: Usd.TimeCode,
    to_world: np.ndarray,
    made: Imported,
) -> None:
    """Lights a mesh that is said to be a light; other shapes stay dark, with a warning."""
    warn_of_parts(prim, made)
    meshes = [shape for shape in shapes if "faces" in shape]
    if len(meshes) < len(shapes):
        made.warn("lights that are other shapes than meshes are left out")
    areas = [triangle_areas(mesh["vertices"], mesh["faces"], to_world).sum() for mesh in meshes]
    for mesh in meshes:
        mesh["emitter"] = emitter(radiance(prim, time, float(sum(areas))))


def pole(given: Any) -> str:
    """The axis of a dome; only those of version 1 have another one than y."""
    axis = given.GetPoleAxisAttr().Get() if hasattr(given, "GetPoleAxisAttr") else "Y"
    if axis == "scene":
        axis = UsdGeom.GetStageUpAxis(given.GetPrim().GetStage())
    return str(axis)


LIGHTS = {
    UsdLux.SphereLight: sphere,
    UsdLux.DiskLight: disk,
    UsdLux.RectLight: rectangle,
    UsdLux.CylinderLight: cylinder,
    UsdLux.DistantLight: distant,
    UsdLux.DomeLight: dome,
    UsdLux.DomeLight_1: dome,
}
