"""Materials of glTF as `principled`, which has the same microfacets (glTF 2.0, appendix B).

Roughness is the root of alpha in both; a dielectric has the index 1.5, hence `eta`.
"""

from __future__ import annotations

import math
from typing import Any

from ..imported import Imported, rgb
from .checked import number, numbers, warn_of_others
from .dielectrics import IOR, SHEEN, SPECULAR, index_of_refraction, sheen
from .specular_glossiness import SPECULAR_GLOSSINESS, diffuse, specular_glossy
from .textures import Textures

UNLIT, EMISSIVE_STRENGTH = "KHR_materials_unlit", "KHR_materials_emissive_strength"
#: Those that go with specular colours and glossiness.
OF_ANY_MODEL = {UNLIT, EMISSIVE_STRENGTH, SPECULAR_GLOSSINESS}
KNOWN = OF_ANY_MODEL | {
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    IOR,
    SHEEN,
    SPECULAR,
    "KHR_materials_transmission",
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
    glossy = glossy_part(material)
    warn_of_others(extensions, KNOWN if glossy is None else OF_ANY_MODEL, made)
    warn_of_textures(material, made)
    if is_unlit(material):
        return masked({"type": "diffuse", "reflectance": rgb([0, 0, 0])}, material, textures)
    if glossy is None:
        surface = metallic_rough(material, textures, made, of_vertices)
    else:
        surface = specular_glossy(glossy, textures, made, of_vertices=of_vertices)
    if material.normalTexture is not None:
        normals = textures.raw(material.normalTexture)
        surface = {"type": "normalmap", "normalmap": normals, "bsdf": surface}
    if not transmission(material):
        surface = {"type": "twosided", "bsdf": surface}
    return masked(surface, material, textures)


def warn_of_textures(material: Any, made: Imported) -> None:
    """Names what of a material's textures is not read."""
    for name in UNTEXTURED:
        for key in sorted((material.extensions or {}).get(name, {})):
            if key.endswith("Texture"):
                made.warn(f"{key} ({name}) is left out")
    if material.occlusionTexture is not None:
        made.warn("occlusion textures are left out: what they stand for is rendered")
    if material.normalTexture is not None and (material.normalTexture.scale or 1) != 1:
        made.warn("the scale of normal textures is left out")


def glossy_part(material: Any) -> dict[str, Any] | None:
    """The specular colours and glossiness that take the place of metal and roughness, if any."""
    if is_unlit(material):
        return None
    return (material.extensions or {}).get(SPECULAR_GLOSSINESS)


def transmission(material: Any) -> float:
    """How much of what is not reflected goes through."""
    if glossy_part(material) is not None:
        return 0.0
    given = (material.extensions or {}).get("KHR_materials_transmission", {})
    return number(given.get("transmissionFactor") or 0, "transmissionFactor")


def base(material: Any) -> tuple[list[float], Any]:
    """The factor of the colour below all reflection, with alpha, and its texture."""
    glossy, pbr = glossy_part(material), material.pbrMetallicRoughness
    if glossy is not None:
        return diffuse(glossy)
    if pbr is None:
        return [1, 1, 1, 1], None
    return list(pbr.baseColorFactor or [1, 1, 1, 1]), pbr.baseColorTexture


def base_color(material: Any, textures: Textures, of_vertices: bool) -> dict[str, Any]:
    """A factor times a texture or the colours of vertices."""
    factor, info = base(material)
    return textures.colour(info, factor, of_vertices=of_vertices)


def metallic_rough(
    material: Any, textures: Textures, made: Imported, of_vertices: bool
) -> dict[str, Any]:
    """The BSDF of what glTF itself gives a material, and of the extensions for that."""
    extensions = material.extensions or {}
    surface = principled(material, extensions, textures)
    surface |= {"eta": index_of_refraction(extensions, textures, made)}
    surface |= sheen(extensions, textures, made)
    surface["base_color"] = base_color(material, textures, of_vertices)
    dispersion = _dispersion(extensions)
    return dispersive(surface, dispersion, made) if dispersion else surface


def principled(material: Any, extensions: dict[str, Any], textures: Textures) -> dict[str, Any]:
    """Metal, roughness, transmission and clear coat, still without colour and index."""
    pbr = material.pbrMetallicRoughness
    given: dict[str, Any] = {"type": "principled"}
    packed = pbr.metallicRoughnessTexture if pbr else None
    given["roughness"] = textures.channel(packed, 1, _number(pbr, "roughnessFactor"))
    given["metallic"] = textures.channel(packed, 2, _number(pbr, "metallicFactor"))
    if transmitted := transmission(material):
        given["spec_trans"] = transmitted
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
    volume = (material.extensions or {}).get("KHR_materials_volume", {})
    given = {name: number(volume.get(name, 0), name) for name in ("thicknessFactor", DISTANCE)}
    if not transmission(material) or min(given.values()) <= 0:
        return None
    colour = numbers(volume.get("attenuationColor", [1, 1, 1]), 3, "attenuationColor")
    absorbed = [-math.log(min(max(c, DARKEST), 1)) / given[DISTANCE] for c in colour]
    return {"type": "homogeneous", "sigma_s": 0.0, "sigma_a": rgb(absorbed)}


def masked(surface: dict[str, Any], material: Any, textures: Textures) -> dict[str, Any]:
    """With the transparency of its alpha."""
    if (material.alphaMode or "OPAQUE") == "OPAQUE":
        return surface
    factor, info = base(material)
    cutoff = None
    if material.alphaMode == "MASK":
        cutoff = 0.5 if material.alphaCutoff is None else material.alphaCutoff
    opacity = textures.opacity(info, factor[3], cutoff)
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
        return {"type": "area", "radiance": base_color(material, textures, of_vertices)}
    factor = list(material.emissiveFactor or [0, 0, 0])
    extension = (material.extensions or {}).get(EMISSIVE_STRENGTH, {})
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
