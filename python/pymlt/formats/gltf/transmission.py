"""What goes through a surface: into a solid (KHR_materials_volume), or through a thin wall."""

from __future__ import annotations

import math
from typing import Any

from ..imported import Imported, rgb
from .extensions import Extension
from .textures import Textures

TRANSMISSION, VOLUME = "KHR_materials_transmission", "KHR_materials_volume"
DIFFUSE, DISPERSION = "KHR_materials_diffuse_transmission", "KHR_materials_dispersion"
PASSAGES = {TRANSMISSION, VOLUME, DIFFUSE, DISPERSION}
DISTANCE = "attenuationDistance"  #: infinite if it is not given
ABBE_TIMES_DISPERSION = 20.0  #: KHR_materials_dispersion has 20 / V_d
GREATEST_ABBE = 1e9
DARKEST = 1e-6  #: of attenuation colours, whose logarithm is taken
ABBE = "transmission_dispersion_abbe_number"
#: Perfectly smooth, clear glass, and what makes it another material.
CLEAR = {"specular_roughness": 0, "base_metalness": 0, "transmission_weight": 1}
MORE = {"specular_weight", "specular_color", "coat_weight", "fuzz_weight", "thin_film_weight"}
MORE |= {"subsurface_weight"}


def transmitted(material: Any) -> float:
    """How much of what is not reflected goes straight through or is refracted."""
    return Extension(material, TRANSMISSION).number("transmissionFactor")


def diffused(material: Any) -> float:
    """How much of the diffuse light leaves on the other side."""
    return Extension(material, DIFFUSE).number("diffuseTransmissionFactor")


def is_solid(material: Any) -> bool:
    """Whether what goes through is refracted into something thick."""
    return bool(transmitted(material)) and Extension(material, VOLUME).number("thicknessFactor") > 0


def passage(material: Any, base: Any, textures: Textures, made: Imported) -> dict[str, Any]:
    """Parameters of what goes through, in the base colour."""
    solid, diffuse = is_solid(material), diffused(material)
    found: dict[str, Any] = {}
    if factor := transmitted(material):
        info = Extension(material, TRANSMISSION).texture("transmissionTexture")
        found["transmission_weight"] = textures.channel(info, 0, factor)
        found["transmission_color"] = base
    if solid and diffuse:
        made.warn(f"{DIFFUSE} is left out of solids")
    elif diffuse:
        found |= leaf(material, diffuse, textures)
    if found and not solid:
        found["geometry_thin_walled"] = True
    return found | dispersion(material, solid, made)


def leaf(material: Any, factor: float, textures: Textures) -> dict[str, Any]:
    """Diffuse light that leaves on the other side alone, in a colour of its own."""
    given = Extension(material, DIFFUSE)
    colour = given.colour("diffuseTransmissionColorFactor")
    return {
        "subsurface_weight": textures.opacity(
            given.texture("diffuseTransmissionTexture"), factor, None
        ),
        "subsurface_color": textures.colour(
            given.texture("diffuseTransmissionColorTexture"), colour
        ),
        "subsurface_scatter_anisotropy": 1.0,
    }


def dispersion(material: Any, solid: bool, made: Imported) -> dict[str, Any]:
    """By 20 over Abbe's number; 0 is the same index at all wavelengths."""
    strength = max(Extension(material, DISPERSION).number("dispersion"), 0.0)
    if strength and not solid:
        made.warn("dispersion is left out of what has no thickness or lets no light through")
    if not strength or not solid:
        return {}
    abbe = min(ABBE_TIMES_DISPERSION / strength, GREATEST_ABBE)
    return {"transmission_dispersion_scale": 1.0, ABBE: abbe}


def clear_glass(surface: dict[str, Any]) -> dict[str, Any] | None:
    """Perfectly smooth, clear glass of one colour, with exact mirrors; None for others."""
    if not CLEAR.items() <= surface.items() or MORE & surface.keys():
        return None
    colour, index = surface["transmission_color"], surface["specular_ior"]
    if colour["type"] != "rgb":
        return None
    kind = "thindielectric" if "geometry_thin_walled" in surface else "dielectric"
    if ABBE in surface:
        index = f"abbe {index!r} {surface[ABBE]!r}"
    return {"type": kind, "int_ior": index, "specular_transmittance": colour}


def interior(material: Any) -> dict[str, Any] | None:
    """What is in a closed mesh (KHR_materials_volume): a medium that absorbs, so that white light
    has the attenuation colour after the attenuation distance. The mesh itself says how thick it is.
    """
    volume = Extension(material, VOLUME)
    distance, colour = volume.number(DISTANCE), volume.colour("attenuationColor")
    if not is_solid(material) or distance <= 0:
        return None
    absorbed = [-math.log(min(max(c, DARKEST), 1)) / distance for c in colour]
    return {"type": "homogeneous", "sigma_s": 0.0, "sigma_a": rgb(absorbed)}
