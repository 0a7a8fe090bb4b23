"""Materials of pbrt-v4 as BSDFs (Pharr, Jakob & Humphreys 2023, ch. 9 and 10)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ..imported import rgb
from . import lobes
from .arithmetic import Value, multiplied
from .metals import complex_index
from .params import Params
from .spectra import DISPERSIVE
from .textures import Textures

Named = dict[str, dict[str, Any]]
#: Those whose two sides are of one BSDF.
TRANSMITTING = ("dielectric", "diffusetransmission", "thindielectric")


def bsdf(params: Params, textures: Textures, named: Named) -> dict[str, Any]:
    """The BSDF of a material; what is not known becomes diffuse, with a warning."""
    if params.type in ("", "interface", "none"):
        return {"type": "null"}
    if params.type == "mix":
        return mix(params, textures, named)
    make = MATERIALS.get(params.type)
    if make is None:
        params.warn(f"the material {params.type!r} has no counterpart; it becomes diffuse")
        make = diffuse
    surface = make(params, textures)
    if image := params.text("normalmap"):
        normals = textures.bitmap(image) | {"raw": True}
        surface = {"type": "normalmap", "normalmap": normals, "bsdf": surface}
    params.finish(ignored=("thickness", "maxdepth", "nsamples"))
    if params.type in TRANSMITTING:
        return surface
    return {"type": "twosided", "bsdf": surface}


def diffuse(params: Params, textures: Textures) -> dict[str, Any]:
    return {"type": "diffuse", "reflectance": textures.colour(params, "reflectance", 0.5)}


def diffuse_transmission(params: Params, textures: Textures) -> dict[str, Any]:
    """Both shares are cut off at 1, after the scale."""
    scale = params.number("scale", 1.0)
    reflected, transmitted = (
        clamped(multiplied(textures.colour(params, name, 0.25), scale))
        for name in ("reflectance", "transmittance")
    )
    return lobes.total([lobes.diffuse(reflected), lobes.diffuse_transmission(transmitted)])


def clamped(colour: Value) -> Value:
    """At most 1; textures are left as they are."""
    if not isinstance(colour, dict):
        return min(colour, 1.0)
    match colour["type"]:
        case "rgb":
            return rgb([min(v, 1.0) for v in colour["value"]])
        case "spectrum":
            return colour | {"value": [(wave, min(v, 1.0)) for wave, v in colour["value"]]}
    return colour


def coated_diffuse(params: Params, textures: Textures) -> dict[str, Any]:
    """The analytic model of (rough)plastic in place of a random walk between the layers."""
    surface = rough(params, textures, "plastic", 0.0)
    surface["diffuse_reflectance"] = textures.colour(params, "reflectance", 0.5)
    return surface | {"int_ior": index(params, 1.5), "nonlinear": True}


def conductor(params: Params, textures: Textures, prefix: str = "") -> dict[str, Any]:
    surface = rough(params, textures, "conductor", 0.0, prefix)
    if params.get("reflectance"):
        return surface | {"specular_reflectance": textures.colour(params, "reflectance", 1.0)}
    return surface | complex_index(params, textures, prefix)


def coated_conductor(params: Params, textures: Textures) -> dict[str, Any]:
    if params.number("interface.roughness", 0):
        params.warn("the roughness of coatings of conductors is left out")
    inner = conductor(params, textures, "conductor.")
    eta = index(params, 1.5, "interface.eta")
    if isinstance(eta, float | str) and "specular_reflectance" not in inner:
        inner["ext_eta"] = eta  # light meets the metal in the coating
    return {"type": "coating", "int_ior": eta, "bsdf": inner}


def dielectric(params: Params, textures: Textures) -> dict[str, Any]:
    return rough(params, textures, "dielectric", 0.0) | {"int_ior": index(params, 1.5)}


def thin_dielectric(params: Params, textures: Textures) -> dict[str, Any]:
    return {"type": "thindielectric", "int_ior": index(params, 1.5)}


def mix(params: Params, textures: Textures, named: Named) -> dict[str, Any]:
    """`amount` is the share of the second material."""
    given = params.get("materials")
    names = given.values if given else []
    return blend(params, names, named, textures.number(params, "amount", 0.5))


def blend(params: Params, names: list[str], named: Named, weight: Any) -> dict[str, Any]:
    """Two materials by their names; the weight is the share of the second one."""
    if len(names) != 2 or any(name not in named for name in names):
        raise params.where.error("a mix needs the names of two materials that stand above it")
    parts = [named[name] for name in names]
    two_sided = all(part["type"] == "twosided" for part in parts)
    inner = {f"bsdf_{i}": part["bsdf"] if two_sided else part for i, part in enumerate(parts)}
    blended = {"type": "blendbsdf", "weight": weight} | inner
    return {"type": "twosided", "bsdf": blended} if two_sided else blended


def rough(
    params: Params, textures: Textures, plugin: str, default: float, prefix: str = ""
) -> dict[str, Any]:
    """The smooth or the rough plug-in, with GGX; alpha is the root of a roughness that is remapped
    (pbrt-v4, TrowbridgeReitzDistribution::RoughnessToAlpha)."""
    remap = params.flag("remaproughness", True)
    both = textures.number(params, f"{prefix}roughness", default)
    found = [textures.number(params, f"{prefix}{axis}roughness", both) for axis in "uv"]
    if remap and any(isinstance(value, dict) for value in found):
        params.warn("textures of roughness are taken as alpha, not remapped")
    alphas = [math.sqrt(v) if remap and isinstance(v, float) and v > 0 else v for v in found]
    if all(alpha == 0 for alpha in alphas):
        return {"type": plugin}
    surface = {"type": f"rough{plugin}", "distribution": "ggx"}
    if alphas[0] == alphas[1]:
        return surface | {"alpha": alphas[0]}
    if plugin == "plastic":
        params.warn("anisotropic coatings are left out")
        return surface | {"alpha": alphas[0]}
    return surface | {"alpha_u": alphas[0], "alpha_v": alphas[1]}


def index(params: Params, default: float, name: str = "eta") -> Any:
    """Of refraction: a number, the text of a glass, or a table that depends on the wavelength."""
    given = params.get(name)
    if given is not None and given.values and given.values[0] in DISPERSIVE:
        return DISPERSIVE[given.values[0]]
    found = params.colour(name, default)
    if not isinstance(found, dict):
        return float(found)
    values = found["value"]
    if found["type"] == "spectrum":
        return found if len(values) > 1 else values[0][1]
    params.warn("an index of refraction has no colour: that of green is taken")
    return float(values[len(values) // 2]) if isinstance(values, list | tuple) else float(values)


MATERIALS: dict[str, Callable[[Params, Textures], dict[str, Any]]]
MATERIALS = {
    "coatedconductor": coated_conductor,
    "coateddiffuse": coated_diffuse,
    "conductor": conductor,
    "dielectric": dielectric,
    "diffuse": diffuse,
    "diffusetransmission": diffuse_transmission,
    "thindielectric": thin_dielectric,
}
