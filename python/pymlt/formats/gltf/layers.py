"""What lies in and on a surface, as parameters of `openpbr`: each function reads one extension.

Parameters that would change nothing are left out.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ..imported import Imported, rgb
from .extensions import Extension
from .textures import Textures

if TYPE_CHECKING:
    import numpy as np

IOR, SPECULAR = "KHR_materials_ior", "KHR_materials_specular"
CLEARCOAT, SHEEN = "KHR_materials_clearcoat", "KHR_materials_sheen"
ANISOTROPY, IRIDESCENCE = "KHR_materials_anisotropy", "KHR_materials_iridescence"
LAYERS = {IOR, SPECULAR, CLEARCOAT, SHEEN, ANISOTROPY, IRIDESCENCE}

LEAST_INDEX, GREATEST_INDEX = 1.001, 999.0
COAT = {"coat_ior": 1.5, "coat_darkening": 0.0}  #: what all coats of glTF are
FUZZ_EXPONENT = 0.4  #: of the roughness of sheen, in MaterialX's translation of standard_surface
NANOMETRES = 1000.0  #: in a micrometre


def index_of_refraction(material: Any) -> float:
    """The index of what is no metal."""
    index = Extension(material, IOR).number("ior", 1.5)
    return min(max(index or math.inf, LEAST_INDEX), GREATEST_INDEX)  # 0 stands for infinity


def microfacets(roughness: np.ndarray, info: Any, strength: float, textures: Textures) -> Any:
    """The roughness, and how much it is stretched along the tangent.

    Here alpha is roughness^2 across the tangent and towards 1 along it; OpenPBR keeps the mean of
    both squares.
    """
    import numpy as np

    alpha = roughness**2
    along = alpha + (1 - alpha) * strength**2
    ratio = alpha / along
    stretched = np.sqrt(along * np.sqrt((1 + ratio**2) / 2))
    return {
        "specular_roughness": textures.made_of(stretched, info),
        "specular_roughness_anisotropy": textures.made_of(1 - ratio, info),
    }


def specular(material: Any, metalness: Any, textures: Textures) -> dict[str, Any]:
    """The reflection of what is no metal.

    At normal incidence it is min(F0 of the index x colour, 1) x factor.
    """
    given = Extension(material, SPECULAR)
    if not given.is_given or metalness == 1:
        return {}
    index = index_of_refraction(material)
    most = ((index + 1) / (index - 1)) ** 2
    colour = [min(c, most) for c in given.colour("specularColorFactor")]
    greatest = max(*colour, 0.0)
    factor = given.number("specularFactor", 1) * greatest
    hue = [c / greatest for c in colour] if greatest else [1.0] * 3
    weight = textures.opacity(given.texture("specularTexture"), factor, None)
    tint = textures.colour(given.texture("specularColorTexture"), hue)
    found = {"specular_weight": weight, "specular_color": tint}
    if metalness != 0:
        found = {name: between(value, metalness) for name, value in found.items()}
    return {name: value for name, value in found.items() if value not in (1, rgb([1, 1, 1]))}


def between(value: Any, metalness: dict[str, Any]) -> dict[str, Any]:
    """A value where there is no metal, 1 where there is."""
    return {"type": "mix", "first": value, "second": 1.0, "amount": metalness}


def coat(material: Any, textures: Textures, made: Imported) -> dict[str, Any]:
    """The clear coat above all but sheen."""
    given = Extension(material, CLEARCOAT)
    factor = given.number("clearcoatFactor")
    if not factor:
        return {}
    own, below = given.texture("clearcoatNormalTexture"), material.normalTexture
    if (own and own.index) != (below and below.index):
        made.warn("clear coats have the normals of what is below them")
    rough = given.number("clearcoatRoughnessFactor")
    return COAT | {
        "coat_weight": textures.channel(given.texture("clearcoatTexture"), 0, factor),
        "coat_roughness": textures.channel(given.texture("clearcoatRoughnessTexture"), 1, rough),
    }


def fuzz(material: Any, textures: Textures) -> dict[str, Any]:
    """The sheen, as fibres that cover as much as the greatest component of its colour."""
    import numpy as np

    given = Extension(material, SHEEN)
    factor, info = given.colour("sheenColorFactor", 0), given.texture("sheenColorTexture")
    if not any(factor):
        return {}
    colour = (textures.linear(info)[..., :3] * factor).clip(0, 1)
    weight = colour.max(axis=2, keepdims=True)
    hue = np.where(weight > 0, colour / np.where(weight > 0, weight, 1), 1)
    rough = given.texture("sheenRoughnessTexture")
    roughness = textures.linear(rough)[..., 3:] * given.number("sheenRoughnessFactor")
    return {
        "fuzz_weight": textures.made_of(weight, info),
        "fuzz_color": textures.made_of(hue, info),
        "fuzz_roughness": textures.made_of(roughness.clip(0, 1) ** FUZZ_EXPONENT, rough),
    }


def film(material: Any, textures: Textures, made: Imported) -> dict[str, Any]:
    """The thin film below the coat, which has one thickness."""
    given = Extension(material, IRIDESCENCE)
    factor = given.number("iridescenceFactor")
    if not factor:
        return {}
    thickness = given.number("iridescenceThicknessMaximum", 400)
    info = given.texture("iridescenceThicknessTexture")
    if info is not None:
        least = given.number("iridescenceThicknessMinimum", 100)
        thickness = least + (thickness - least) * float(textures.numbers(info, 1).mean())
        made.warn(f"of iridescenceThicknessTexture ({IRIDESCENCE}) the mean is taken")
    return {
        "thin_film_weight": textures.channel(given.texture("iridescenceTexture"), 0, factor),
        "thin_film_thickness": thickness / NANOMETRES,
        "thin_film_ior": given.number("iridescenceIor", 1.3),
    }


def roughness(material: Any, textures: Textures, made: Imported) -> dict[str, Any]:
    """The roughness of glTF itself, stretched if the material is anisotropic."""
    pbr = material.pbrMetallicRoughness
    info = pbr and pbr.metallicRoughnessTexture
    factor = 1.0 if pbr is None or pbr.roughnessFactor is None else float(pbr.roughnessFactor)
    given = Extension(material, ANISOTROPY)
    strength = given.number("anisotropyStrength")
    if not strength:
        return {"specular_roughness": textures.channel(info, 1, factor)}
    if given.number("anisotropyRotation"):
        made.warn("the rotation of anisotropy is left out: highlights are stretched along u")
    directions = given.texture("anisotropyTexture")
    if directions is not None:
        strength *= float(textures.numbers(directions, 2).mean())
        made.warn("of anisotropyTexture the mean strength is taken, without the directions")
    return microfacets(factor * textures.numbers(info, 1), info, strength, textures)
