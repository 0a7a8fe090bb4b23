"""The shader open_pbr_surface of MaterialX, whose inputs `openpbr` has by the same names."""

from __future__ import annotations

import math
from typing import Any

from ..imported import Imported, rgb
from .surface import Surface
from .textures import Textures

#: Inputs that are colours, and what they are if a file does not say.
COLOURS = {
    "base_color": 0.8,
    "specular_color": 1.0,
    "transmission_color": 1.0,
    "subsurface_color": 0.8,
    "coat_color": 1.0,
    "fuzz_color": 1.0,
}
#: Inputs that are numbers, and may be textures.
NUMBERS = {
    "base_weight": 1.0,
    "base_diffuse_roughness": 0.0,
    "base_metalness": 0.0,
    "specular_weight": 1.0,
    "specular_roughness": 0.3,
    "specular_roughness_anisotropy": 0.0,
    "transmission_weight": 0.0,
    "subsurface_weight": 0.0,
    "coat_weight": 0.0,
    "coat_roughness": 0.0,
    "coat_roughness_anisotropy": 0.0,
    "fuzz_weight": 0.0,
    "fuzz_roughness": 0.5,
    "thin_film_weight": 0.0,
}
#: Inputs that are one number for the whole surface.
REALS = (
    "specular_ior",
    "transmission_depth",
    "transmission_scatter_anisotropy",
    "transmission_dispersion_scale",
    "transmission_dispersion_abbe_number",
    "subsurface_radius",
    "subsurface_scatter_anisotropy",
    "coat_ior",
    "coat_darkening",
    "thin_film_thickness",
    "thin_film_ior",
)


def open_pbr_surface(textures: Textures, made: Imported) -> Surface:
    """The BSDF of the inputs that a file gives, with its opacity, normals and emission."""
    bsdf: dict[str, Any] = {"type": "openpbr"}
    for name, default in COLOURS.items():
        if textures.is_given(name):
            bsdf[name] = textures.colour(name, [default] * 3)
    for name, number in NUMBERS.items():
        if textures.is_given(name):
            bsdf[name] = textures.number(name, number)
    for name in REALS:
        if textures.is_given(name) and (value := textures.value(name, None)) is not None:
            bsdf[name] = float(value)
    scatter = textures.value("transmission_scatter", None)
    if scatter is not None:
        bsdf["transmission_scatter"] = rgb(textures.cut("transmission_scatter", scatter))
    scale = textures.value("subsurface_radius_scale", None)
    if scale is not None:
        bsdf["subsurface_radius_scale"] = rgb(scale)
    if textures.value("geometry_thin_walled", False):
        bsdf["geometry_thin_walled"] = True
    if textures.is_textured("geometry_coat_normal"):
        made.warn("geometry_coat_normal is left out")
    anisotropic = [name for name in bsdf if name.endswith("_anisotropy") and bsdf[name] != 0]
    if anisotropic and textures.is_textured("geometry_tangent"):
        made.warn("geometry_tangent is left out: tangents follow the texture coordinates")
    opacity = textures.number("geometry_opacity", 1.0)
    return Surface(bsdf, opacity, textures.normals("geometry_normal"), glow(textures))


def glow(textures: Textures) -> dict[str, Any] | None:
    """Luminance times colour: a nit is one unit of radiance."""
    luminance = float(textures.value("emission_luminance", 0.0))
    if luminance == 0:
        return None
    colour = textures.colour("emission_color", [1.0] * 3, math.inf)
    if colour["type"] == "rgb":
        return rgb([luminance * value for value in colour["value"]])
    return {"type": "scale", "scale": luminance, "texture": colour}
