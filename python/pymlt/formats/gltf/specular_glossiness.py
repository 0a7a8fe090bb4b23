"""Materials whose reflection has a colour of its own (KHR_materials_pbrSpecularGlossiness).

A blend of a dielectric, whose grey reflectance at normal incidence is g, with a metal of the share
w = (M - g) / (1 - g) and the colour b, where (1 - w) g + w b is the specular colour and M its
greatest channel. What the dielectric reflects is missing below it, so that the blend has 1 - M of
the diffuse colour, as in the extension; at grazing angles both reflect all light.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ..imported import Imported
from .checked import number, numbers, texture_info
from .layers import GREATEST_INDEX
from .textures import Textures

if TYPE_CHECKING:
    import numpy as np

SPECULAR_GLOSSINESS = "KHR_materials_pbrSpecularGlossiness"
GREY = 0.04  #: reflectance of what is no metal, where the specular colour leaves a choice
NOTABLE = 1e-3  #: error of a reflectance


def diffuse(given: dict[str, Any]) -> tuple[list[float], Any]:
    """The factor of the diffuse colour, with alpha, and its texture."""
    factor = numbers(given.get("diffuseFactor", [1, 1, 1, 1]), 4, "diffuseFactor")
    return factor, texture_info(given.get("diffuseTexture"), "diffuseTexture")


def specular_glossy(
    given: dict[str, Any], textures: Textures, made: Imported, *, of_vertices: bool
) -> dict[str, Any]:
    """The BSDF of what the extension gives a material."""
    info = texture_info(given.get("specularGlossinessTexture"), "specularGlossinessTexture")
    colour, roughness = specular_and_roughness(given, info, textures)
    grey = float(min(max(GREY, colour.min()), colour.max()))
    share, metal = metallic_part(colour, grey, made)
    rough = {"type": "openpbr", "specular_roughness": textures.made_of(roughness, info)}
    factor, image = diffuse(given)
    base = textures.colour(image, factor, of_vertices=of_vertices)
    dielectric = rough | {"specular_ior": index_of(grey), "base_color": base}
    shining = rough | {"base_metalness": 1.0, "base_color": textures.made_of(metal, info)}
    if not share.any():
        return dielectric
    if share.min() == 1:
        return shining
    weight = textures.made_of(share, info)
    return {"type": "blendbsdf", "weight": weight, "first": dielectric, "second": shining}


def specular_and_roughness(
    given: dict[str, Any], info: Any, textures: Textures
) -> tuple[np.ndarray, np.ndarray]:
    """Factors times textures: (height, width, 3) and (height, width, 1)."""
    colour = numbers(given.get("specularFactor", [1, 1, 1]), 3, "specularFactor")
    glossiness = number(given.get("glossinessFactor", 1), "glossinessFactor")
    both = (textures.linear(info) * [*colour, glossiness]).clip(0, 1)
    return both[..., :3], 1 - both[..., 3:]


def metallic_part(colour: np.ndarray, grey: float, made: Imported) -> tuple[np.ndarray, np.ndarray]:
    """The share of the metal, (height, width, 1), and its colour.

    Warns of specular colours that the grey dielectric alone exceeds.
    """
    import numpy as np

    share = ((colour.max(axis=2, keepdims=True) - grey) / max(1 - grey, NOTABLE)).clip(0, 1)
    metal = (grey + (colour - grey) / np.where(share > 0, share, 1)).clip(0, 1)
    if ((1 - share) * grey + share * metal - colour).max() > NOTABLE:
        made.warn(f"specular colours below {GREY} are raised, to {GREY} at most")
    return share, metal


def index_of(reflectance: float) -> float:
    """The index above 1 that has a reflectance at normal incidence."""
    root = math.sqrt(max(reflectance, 0.0))
    return min((1 + root) / (1 - root), GREATEST_INDEX) if root < 1 else GREATEST_INDEX
