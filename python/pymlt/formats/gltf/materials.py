"""Materials of glTF as `principled`, which has the same microfacets (glTF 2.0, appendix B).

Roughness is the root of alpha in both; a dielectric has the index 1.5, hence `eta`.
"""

from __future__ import annotations

import math
from typing import Any

from ..imported import Imported, rgb
from .checked import number, numbers, warn_of_others
from .dielectrics import IOR, SHEEN, SPECULAR, index_of_refraction, sheen
from .textures import Textures

UNLIT = "KHR_materials_unlit"
KNOWN = {
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    IOR,
    SHEEN,
    SPECULAR,
    "KHR_materials_transmission",
    UNLIT,
    "KHR_materials_volume",
}

#: Extensions whose factors are read, but not their textures.
UNTEXTURED = ("KHR_materials_clearcoat", "KHR_materials_transmission", "KHR_materials_volume")
DISTANCE = "attenuationDistance"  #: infinite if it is not given
ABBE_TIMES_DISPERSION = 20  #: KHR_materials_dispersion has 20 / V_d
DARKEST = 1e-6  #: of attenuation colours, whose logarithm is taken


def bsdf(material: Any, textures: Textures, made: Imported, *, of_vertices: bool) -> dict[str, Any]:
    """The BSDF of a material, whose base colour may be multiplied by colours of vertices."""
    extensions = material.extensions or {}
    warn_of_others(extensions, KNOWN, made)
    for name in UNTEXTURED:
        for key in sorted(extensions.get(name, {})):
            if key.endswith("Texture"):
                made.warn(f"{key} ({name}) is left out")
    if material.occlusionTexture is not None:
        made.warn("occlusion textures are left out: what they stand for is rendered")
    if UNLIT in extensions:
        return masked({"type": "diffuse", "reflectance": rgb([0, 0, 0])}, material, textures)
    surface = principled(material, extensions, textures)
    surface |= {"eta": index_of_refraction(extensions, textures, made)}
    surface |= sheen(extensions, textures, made)
    surface["base_color"] = base_color(material.pbrMetallicRoughness, textures, of_vertices)
    transmits = "spec_trans" in surface
    if dispersion := _dispersion(extensions):
        surface = dispersive(surface, dispersion, made)
    if material.normalTexture is not None:
        if (material.normalTexture.scale or 1) != 1:
            made.warn("the scale of normal textures is left out")
        normals = textures.raw(material.normalTexture)
        surface = {"type": "normalmap", "normalmap": normals, "bsdf": surface}
    if not transmits:
        surface = {"type": "twosided", "bsdf": surface}
    return masked(surface, material, textures)


def base_color(pbr: Any, textures: Textures, of_vertices: bool) -> dict[str, Any]:
    """A factor times a texture or the colours of vertices."""
    factor = list(pbr.baseColorFactor or [1, 1, 1, 1]) if pbr else [1, 1, 1, 1]
    return textures.colour(pbr.baseColorTexture if pbr else None, factor, of_vertices=of_vertices)


def principled(material: Any, extensions: dict[str, Any], textures: Textures) -> dict[str, Any]:
    """Metal, roughness, transmission and clear coat, still without colour and index."""
    pbr = material.pbrMetallicRoughness
    given: dict[str, Any] = {"type": "principled"}
    packed = pbr.metallicRoughnessTexture if pbr else None
    given["roughness"] = textures.channel(packed, 1, _number(pbr, "roughnessFactor"))
    given["metallic"] = textures.channel(packed, 2, _number(pbr, "metallicFactor"))
    if transmission := extensions.get("KHR_materials_transmission", {}).get("transmissionFactor"):
        given["spec_trans"] = number(transmission, "transmissionFactor")
    if coat := extensions.get("KHR_materials_clearcoat", {}).get("clearcoatFactor"):
        given["clearcoat"] = number(coat, "clearcoatFactor")
        roughness = extensions["KHR_materials_clearcoat"].get("clearcoatRoughnessFactor", 0)
        given["clearcoat_gloss"] = 1 - number(roughness, "clearcoatRoughnessFactor")
    return given


def _dispersion(extensions: dict[str, Any]) -> float:
    """20 over Abbe's number; 0 for what has the same index at all wavelengths."""
    given = extensions.get("KHR_materials_dispersion", {}).get("dispersion", 0)
    return max(number(given, "dispersion"), 0.0)


def dispersive(surface: dict[str, Any], dispersion: float, made: Imported) -> dict[str, Any]:
    """Clear glass, as `principled` has one index alone. Other materials stay what they are."""
    colour = surface["base_color"]
    clear = surface.get("spec_trans") == 1 and surface["metallic"] == 0
    plain = isinstance(surface["roughness"], float | int) and "clearcoat" not in surface
    if not (clear and plain and colour["type"] == "rgb"):
        made.warn("dispersion is left out of what is not clear, uncoated glass of one colour")
        return surface
    index = f"abbe {surface['eta']!r} {ABBE_TIMES_DISPERSION / dispersion!r}"
    glass = {"type": "dielectric", "int_ior": index, "specular_transmittance": colour}
    if not surface["roughness"]:
        return glass
    alpha = float(surface["roughness"]) ** 2
    return glass | {"type": "roughdielectric", "distribution": "ggx", "alpha": alpha}


def is_unlit(material: Any) -> bool:
    """Whether it shows its base colour, whatever the light (KHR_materials_unlit)."""
    return UNLIT in (material.extensions or {})


def interior(material: Any) -> dict[str, Any] | None:
    """What is in a closed mesh (KHR_materials_volume): a medium that absorbs, so that white light
    has the attenuation colour after the attenuation distance. The mesh itself says how thick it is.
    """
    extensions = material.extensions or {}
    volume = extensions.get("KHR_materials_volume", {})
    given = {name: number(volume.get(name, 0), name) for name in ("thicknessFactor", DISTANCE)}
    transmits = extensions.get("KHR_materials_transmission", {}).get("transmissionFactor")
    if not transmits or min(given.values()) <= 0:
        return None
    colour = numbers(volume.get("attenuationColor", [1, 1, 1]), 3, "attenuationColor")
    absorbed = [-math.log(min(max(c, DARKEST), 1)) / given[DISTANCE] for c in colour]
    return {"type": "homogeneous", "sigma_s": 0.0, "sigma_a": rgb(absorbed)}


def masked(surface: dict[str, Any], material: Any, textures: Textures) -> dict[str, Any]:
    """With the transparency of its alpha."""
    if (material.alphaMode or "OPAQUE") == "OPAQUE":
        return surface
    pbr = material.pbrMetallicRoughness
    factor = (pbr.baseColorFactor or [1, 1, 1, 1])[3] if pbr else 1
    cutoff = None
    if material.alphaMode == "MASK":
        cutoff = 0.5 if material.alphaCutoff is None else material.alphaCutoff
    opacity = textures.opacity(pbr.baseColorTexture if pbr else None, factor, cutoff)
    return {"type": "mask", "opacity": opacity, "bsdf": surface}


def emission(
    material: Any, textures: Textures, made: Imported, *, of_vertices: bool
) -> dict[str, Any] | None:
    """The area light of a material that glows; that of an unlit one has its base colour.

    Its strength is taken as radiance, not as nits: Blender writes and reads it as it is.
    """
    if is_unlit(material):
        made.warn("unlit materials are seen from the side of their normals alone, and light others")
        if (material.alphaMode or "OPAQUE") != "OPAQUE":
            made.warn("unlit materials that are transparent are as bright as if they were opaque")
        colour = base_color(material.pbrMetallicRoughness, textures, of_vertices)
        return {"type": "area", "radiance": colour}
    factor = list(material.emissiveFactor or [0, 0, 0])
    extension = (material.extensions or {}).get("KHR_materials_emissive_strength", {})
    strength = number(extension.get("emissiveStrength", 1), "emissiveStrength")
    if not any(factor) or not strength:
        return None
    if material.doubleSided:
        made.warn("double-sided materials that glow do so on the side of their normals alone")
    radiance = [strength * value for value in factor]
    if material.emissiveTexture is None:
        return {"type": "area", "radiance": rgb(radiance)}
    return {"type": "area", "radiance": textures.colour(material.emissiveTexture, radiance)}


def _number(pbr: Any, name: str) -> float:
    value = getattr(pbr, name, None)
    return 1.0 if value is None else float(value)
