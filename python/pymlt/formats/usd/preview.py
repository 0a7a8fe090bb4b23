"""UsdPreviewSurface as `openpbr`, whose parameters are those of the OpenPBR Surface 1.1.

Both have GGX microfacets whose alpha is the square of the roughness, a dielectric base with an
index of refraction or a metal, and a coat above it.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ..imported import Imported, rgb
from .surface import Surface
from .textures import Textures

COAT_INDEX = 1.5
MOST_OF_A_DIELECTRIC = 0.25  #: reflectance at normal incidence: that of the index 3


def preview_surface(textures: Textures, made: Imported) -> Surface:
    """The BSDF of a UsdPreviewSurface, with its opacity, normals and emission."""
    bsdf: dict[str, Any] = {
        "type": "openpbr",
        "base_color": textures.colour("diffuseColor", [0.18] * 3),
        "specular_roughness": textures.number("roughness", 0.5),
        "specular_ior": float(textures.value("ior", 1.5)),
    }
    if int(textures.value("useSpecularWorkflow", 0)) == 1:
        bsdf |= specular(textures, made)
    else:
        bsdf["base_metalness"] = textures.number("metallic", 0.0)
    coat = textures.number("clearcoat", 0.0)
    if coat != 0:
        bsdf |= {"coat_weight": coat, "coat_ior": COAT_INDEX, "coat_darkening": 0.0}
        bsdf["coat_roughness"] = textures.number("clearcoatRoughness", 0.01)
    if textures.is_given("displacement") and (
        textures.is_textured("displacement") or textures.value("displacement", 0.0)
    ):
        made.warn("displacement is left out")
    if textures.is_textured("occlusion"):
        made.warn("occlusion textures are left out: what they stand for is rendered")
    return Surface(bsdf, opacity(textures, bsdf), textures.normals("normal"), glow(textures))


def opacity(textures: Textures, bsdf: dict[str, Any]) -> float | dict[str, Any]:
    """How much of the surface is there.

    One number below 1 is a surface that lets light through and still reflects, unless the material
    says that it is not there.
    """
    threshold = float(textures.value("opacityThreshold", 0.0))
    found = textures.opacity("opacity", threshold)
    is_thin = str(textures.value("opacityMode", "transparent")) == "transparent"
    if isinstance(found, dict) or found >= 1 or threshold > 0 or not is_thin:
        return found
    bsdf |= {"transmission_weight": 1 - found, "geometry_thin_walled": True}
    return 1.0


def specular(textures: Textures, made: Imported) -> dict[str, Any]:
    """A reflectance at normal incidence as an index of refraction and a tint, or as a metal."""
    if textures.is_textured("specularColor"):
        made.warn("textures of 'specularColor' are left out: the index of refraction is taken")
        return {}
    colour = np.array(textures.colour("specularColor", [0.0] * 3)["value"])
    most = float(colour.max())
    if most <= 0:
        return {"specular_weight": 0.0}
    if most > MOST_OF_A_DIELECTRIC:
        made.warn("materials with a 'specularColor' above 0.25 become metals of that colour")
        return {"base_metalness": 1.0, "base_color": rgb(np.minimum(colour, 1))}
    if colour.min() < most:
        made.warn("coloured 'specularColor' tints what is reflected at grazing angles, too")
    root = math.sqrt(most)
    return {"specular_ior": (1 + root) / (1 - root), "specular_color": rgb(colour / most)}


def glow(textures: Textures) -> dict[str, Any] | None:
    """The radiance of the surface; None if it is dark."""
    found = textures.colour("emissiveColor", [0.0] * 3, math.inf)
    dark = found["type"] == "rgb" and not any(found["value"])
    return None if dark else found
