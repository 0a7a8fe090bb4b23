"""Roughness of pbrt-v3's materials: alpha of the GGX distribution (Trowbridge & Reitz 1975)."""

from __future__ import annotations

import math
from typing import Any

from ..arithmetic import Value
from ..params import Params
from ..textures import Textures

#: Of the polynomial in the logarithm of a roughness that is remapped
#: (pbrt-v3, TrowbridgeReitzDistribution::RoughnessToAlpha).
REMAPPED = (1.62142, 0.819955, 0.1734, 0.0171201, 0.000640711)

#: Which parameters a material has: `roughness`, the one of each axis, or all of them.
EVEN, AXES, BOTH = "even", "axes", "both"


def remapped(roughness: float) -> float:
    x = math.log(max(roughness, 1e-3))
    return sum(factor * x**power for power, factor in enumerate(REMAPPED))


def alphas(params: Params, textures: Textures, default: float, names: str = BOTH) -> list[Value]:
    """Along u and v. Some materials have `roughness` alone, some have it along the axes alone."""
    both = textures.number(params, "roughness", default) if names != AXES else default
    found = [both, both]
    if names != EVEN:
        found = [textures.number(params, f"{axis}roughness", both) for axis in "uv"]
    if not params.flag("remaproughness", True):
        return found
    if any(isinstance(value, dict) for value in found):
        params.warn("textures of roughness are taken as alpha, not remapped")
    return [value if isinstance(value, dict) else remapped(value) for value in found]


def even_alpha(params: Params, textures: Textures, default: float, names: str = BOTH) -> float:
    """That of a coating, which is the same in all directions, and everywhere."""
    u, v = alphas(params, textures, default, names)
    if isinstance(u, dict) or isinstance(v, dict):
        params.warn(f"textures of the roughness of a {params.type} are left out")
        return remapped(default)
    if u != v:
        params.warn(f"a {params.type} is equally rough in all directions")
    return math.sqrt(u * v)


def microfacets(plugin: str, found: list[Value]) -> dict[str, Any]:
    """The smooth or the rough plug-in."""
    if found[0] == found[1] == 0:
        return {"type": plugin}
    surface = {"type": f"rough{plugin}", "distribution": "ggx"}
    if found[0] == found[1]:
        return surface | {"alpha": found[0]}
    return surface | {"alpha_u": found[0], "alpha_v": found[1]}
