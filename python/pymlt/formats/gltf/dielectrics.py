"""What dielectrics reflect (KHR_materials_ior, _specular), and sheen (KHR_materials_sheen)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ..imported import Imported
from .checked import number, numbers, texture_info
from .textures import Textures, mean_colour

if TYPE_CHECKING:
    import numpy as np

IOR, SPECULAR = "KHR_materials_ior", "KHR_materials_specular"
SHEEN = "KHR_materials_sheen"
LEAST_INDEX, GREATEST_INDEX = 1.001, 999.0


def index_of_refraction(extensions: dict[str, Any], textures: Textures, made: Imported) -> float:
    """The index whose reflectance at normal incidence is that of the material.

    At grazing angles all light is reflected, whatever `specularFactor` is.
    """
    ior = number(extensions.get(IOR, {}).get("ior", 1.5), "ior")
    ior = max(ior or math.inf, LEAST_INDEX)  # the extension has 0 for infinity
    given = extensions.get(SPECULAR)
    transmits = extensions.get("KHR_materials_transmission", {}).get("transmissionFactor")
    if given is not None and transmits:
        made.warn(f"{SPECULAR} is left out of what transmits")
    if given is None or transmits:
        return min(ior, GREATEST_INDEX)
    strength = number(given.get("specularFactor", 1), "specularFactor")
    info = texture_info(given.get("specularTexture"), "specularTexture")
    if info is not None:
        made.warn(f"of specularTexture ({SPECULAR}) the mean is taken")
    strength = float(mean_colour(textures.opacity(info, strength, None))[0])
    colour = _mean_of(given, "specularColor", [1, 1, 1], textures, made)
    reflectances = [strength * min(reflectance_of(ior) * float(c), 1.0) for c in colour]
    return index_of(sum(reflectances) / 3)


def sheen(extensions: dict[str, Any], textures: Textures, made: Imported) -> dict[str, float]:
    """The white sheen of `principled`, which has no roughness of its own."""
    given = extensions.get(SHEEN, {})
    strength = float(_mean_of(given, "sheenColor", [0, 0, 0], textures, made).mean())
    if strength and (given.get("sheenRoughnessFactor") or "sheenRoughnessTexture" in given):
        made.warn("the roughness of sheen is left out")
    return {"sheen": strength} if strength else {}


def reflectance_of(index: float) -> float:
    """Fresnel's reflectance at normal incidence, by the index inside over that outside."""
    return ((index - 1) / (index + 1)) ** 2 if math.isfinite(index) else 1.0


def index_of(reflectance: float) -> float:
    """The index above 1 that has a reflectance at normal incidence."""
    root = math.sqrt(max(reflectance, 0.0))
    return min((1 + root) / (1 - root), GREATEST_INDEX) if root < 1 else GREATEST_INDEX


def _mean_of(
    given: dict[str, Any], name: str, default: list[float], textures: Textures, made: Imported
) -> np.ndarray:
    """The mean of a factor times a texture, (3,); warns of a texture and of a hue."""
    factor = numbers(given.get(f"{name}Factor", default), 3, f"{name}Factor")
    info = texture_info(given.get(f"{name}Texture"), f"{name}Texture")
    mean = mean_colour(textures.colour(info, factor))
    if info is not None:
        made.warn(f"of {name}Texture the mean is taken")
    if mean.max() - mean.min() > 1e-3:
        made.warn(f"the hue of {name}Factor is left out: the mean of R, G and B is taken")
    return mean
