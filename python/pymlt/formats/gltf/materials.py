"""Materials of glTF as `openpbr`, which has the same microfacets (glTF 2.0, appendix B).

Roughness is the root of alpha in both.
"""

from __future__ import annotations

from typing import Any

from ..imported import Imported, rgb
from .checked import warn_of_others
from .extensions import Extension
from .layers import LAYERS, SPECULAR, coat, film, fuzz, index_of_refraction, roughness, specular
from .specular_glossiness import SPECULAR_GLOSSINESS, diffuse, specular_glossy
from .textures import Textures
from .transmission import PASSAGES, clear_glass, diffused, is_solid, passage, transmitted
from .transmission import interior as medium

UNLIT, EMISSIVE_STRENGTH = "KHR_materials_unlit", "KHR_materials_emissive_strength"
#: Those that go with specular colours and glossiness.
OF_ANY_MODEL = {UNLIT, EMISSIVE_STRENGTH, SPECULAR_GLOSSINESS}
KNOWN = OF_ANY_MODEL | LAYERS | PASSAGES


def bsdf(material: Any, textures: Textures, made: Imported, *, of_vertices: bool) -> dict[str, Any]:
    """The BSDF of a material, whose base colour may be multiplied by colours of vertices."""
    extensions = material.extensions or {}
    glossy = glossy_part(material)
    warn_of_others(extensions, KNOWN if glossy is None else OF_ANY_MODEL, made)
    warn_of_textures(material, made)
    if is_unlit(material):
        return masked({"type": "diffuse", "reflectance": rgb([0, 0, 0])}, material, textures)
    if glossy is None:
        surface = open_pbr(material, textures, made, of_vertices)
    else:
        surface = specular_glossy(glossy, textures, made, of_vertices=of_vertices)
    if material.normalTexture is not None:
        normals = textures.raw(material.normalTexture)
        surface = {"type": "normalmap", "normalmap": normals, "bsdf": surface}
    if not lets_light_through(material):
        surface = {"type": "twosided", "bsdf": surface}
    return masked(surface, material, textures)


def warn_of_textures(material: Any, made: Imported) -> None:
    """Names what of a material's textures is not read."""
    if material.occlusionTexture is not None:
        made.warn("occlusion textures are left out: what they stand for is rendered")
    if material.normalTexture is not None and (material.normalTexture.scale or 1) != 1:
        made.warn("the scale of normal textures is left out")


def glossy_part(material: Any) -> dict[str, Any] | None:
    """The specular colours and glossiness that take the place of metal and roughness, if any."""
    if is_unlit(material):
        return None
    return (material.extensions or {}).get(SPECULAR_GLOSSINESS)


def lets_light_through(material: Any) -> bool:
    """Whether any light leaves on the other side."""
    if is_unlit(material) or glossy_part(material) is not None:
        return False
    return bool(transmitted(material) or diffused(material))


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


def open_pbr(
    material: Any, textures: Textures, made: Imported, of_vertices: bool
) -> dict[str, Any]:
    """The BSDF of what glTF itself gives a material, and of the extensions for that."""
    pbr, colour = material.pbrMetallicRoughness, base_color(material, textures, of_vertices)
    packed = pbr and pbr.metallicRoughnessTexture
    metallic = 1.0 if pbr is None or pbr.metallicFactor is None else float(pbr.metallicFactor)
    surface = {
        "type": "openpbr",
        "base_color": colour,
        "base_metalness": textures.channel(packed, 2, metallic),
        "specular_ior": index_of_refraction(material),
    }
    surface |= roughness(material, textures, made)
    if is_solid(material):
        if SPECULAR in (material.extensions or {}):
            made.warn(f"{SPECULAR} is left out of solids that light passes")
    else:
        surface |= specular(material, surface["base_metalness"], textures)
    surface |= coat(material, textures, made) | fuzz(material, textures)
    surface |= film(material, textures, made) | passage(material, colour, textures, made)
    return clear_glass(surface) or surface


def is_unlit(material: Any) -> bool:
    """Whether it shows its base colour, whatever the light (KHR_materials_unlit)."""
    return UNLIT in (material.extensions or {})


def interior(material: Any) -> dict[str, Any] | None:
    """What fills a closed mesh of a material."""
    return medium(material) if lets_light_through(material) else None


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
    strength = Extension(material, EMISSIVE_STRENGTH).number("emissiveStrength", 1)
    if not any(factor) or not strength:
        return None
    if material.doubleSided:
        made.warn("double-sided materials that glow do so on the side of their normals alone")
    radiance = [strength * value for value in factor]
    if material.emissiveTexture is None:
        return {"type": "area", "radiance": rgb(radiance)}
    return {"type": "area", "radiance": textures.colour(material.emissiveTexture, radiance)}
