"""Materials of pbrt-v3 as BSDFs (Pharr, Jakob & Humphreys 2016, ch. 8 and 9)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ...imported import rgb
from ..arithmetic import Value, is_even, product
from ..lobes import (
    Lobe,
    amplified,
    both_sides,
    coating,
    diffuse,
    diffuse_transmission,
    glossy,
    interface,
    total,
)
from ..materials import Named, blend
from ..metals import complex_index
from ..params import Params
from ..spectra import numbers
from ..textures import Textures
from .disney import disney
from .roughness import AXES, EVEN, alphas, even_alpha, microfacets

#: The parameters of materials, which pbrt-v3 lets shapes change.
PARAMETERS = "Kd Kr Ks Kt amount bumpmap eta index k opacity reflect remaproughness roughness sigma"
PARAMETERS += " transmit uroughness vroughness anisotropic clearcoat clearcoatgloss color difftrans"
PARAMETERS += " flatness metallic scatterdistance sheen sheentint speculartint spectrans thin"


def bsdf(params: Params, textures: Textures, named: Named) -> dict[str, Any]:
    """The BSDF of a material; what is not known becomes matte, with a warning."""
    if params.type in ("", "none"):
        return {"type": "null"}
    if params.type == "mix":
        surface = mix(params, textures, named)
    else:
        make = MATERIALS.get(params.type)
        if make is None:
            params.warn(f"the material {params.type!r} has no counterpart; it becomes matte")
            make = matte
        surface = make(params, textures)
    if params.get("bumpmap"):
        params.warn("bump maps are left out")
    params.finish()
    return surface


def matte(params: Params, textures: Textures) -> dict[str, Any]:
    """Oren and Nayar's model where sigma, in degrees, is given."""
    colour, sigma = textures.colour(params, "Kd", 0.5), textures.number(params, "sigma", 0.0)
    if sigma == 0:
        return both_sides({"type": "diffuse", "reflectance": colour})
    alpha = amplified(sigma, math.sqrt(2) * math.radians(1))
    rough = {"type": "roughdiffuse", "alpha": alpha, "use_fast_approx": True}
    return both_sides(rough | {"reflectance": colour})


def plastic(params: Params, textures: Textures) -> dict[str, Any]:
    base, coat = (textures.colour(params, name, 0.25) for name in ("Kd", "Ks"))
    alpha = even_alpha(params, textures, 0.1, EVEN)
    return total([diffuse(base), glossy(coat, alpha, 1.5)])


def substrate(params: Params, textures: Textures) -> dict[str, Any]:
    """A coating of the index that reflects Ks at normal incidence, where it reflects most."""
    base, coat = (textures.colour(params, name, 0.5) for name in ("Kd", "Ks"))
    params.warn("a substrate becomes a diffuse base below a coating of the same reflectance")
    if not is_even(coat):
        params.warn("textures of what a substrate's coating reflects are taken as .5")
        coat = 0.5
    colour, alpha = numbers(coat), even_alpha(params, textures, 0.1, AXES)
    most = min(max(colour), 0.98)
    if most <= 0:
        return both_sides({"type": "diffuse", "reflectance": base})
    root = math.sqrt(most)
    reflected = rgb([min(1.0, value / most) for value in colour])
    layers = {"int_ior": (1 + root) / (1 - root), "specular_reflectance": reflected}
    return both_sides(coating(alpha) | layers | {"diffuse_reflectance": base})


def glass(params: Params, textures: Textures) -> dict[str, Any]:
    surface = microfacets("dielectric", glass_alphas(params, textures))
    reflected, transmitted = (textures.colour(params, name, 1.0) for name in ("Kr", "Kt"))
    return interface(reflected, transmitted, surface | {"int_ior": index(params)}).bsdf


def glass_alphas(params: Params, textures: Textures) -> list[Value]:
    """Glass that is rough along neither axis is smooth, also where roughness is remapped."""
    given = [textures.number(params, f"{axis}roughness", 0.0) for axis in "uv"]
    return [0.0, 0.0] if given == [0, 0] else alphas(params, textures, 0.0, AXES)


def mirror(params: Params, textures: Textures) -> dict[str, Any]:
    reflectance = textures.colour(params, "Kr", 0.9)
    return both_sides({"type": "conductor", "specular_reflectance": reflectance})


def metal(params: Params, textures: Textures) -> dict[str, Any]:
    surface = microfacets("conductor", alphas(params, textures, 0.01))
    return both_sides(surface | complex_index(params, textures))


def translucent(params: Params, textures: Textures) -> dict[str, Any]:
    """What it reflects and transmits are shares of both its diffuse and its glossy part."""
    base, coat = (textures.colour(params, name, 0.25) for name in ("Kd", "Ks"))
    shares = [textures.colour(params, name, 0.5) for name in ("reflect", "transmit")]
    reflected, transmitted = ((product(base, share), product(coat, share)) for share in shares)
    surface = microfacets("dielectric", alphas(params, textures, 0.1, EVEN))
    return total(
        [
            diffuse(reflected[0]),
            diffuse_transmission(transmitted[0]),
            interface(reflected[1], transmitted[1], surface | {"int_ior": 1.5}),
        ]
    )


def uber(params: Params, textures: Textures) -> dict[str, Any]:
    """A sum of lobes, of which the opacity lets a part of the light pass by."""
    base, coat = (textures.colour(params, name, 0.25) for name in ("Kd", "Ks"))
    reflected, transmitted = (textures.colour(params, name, 0.0) for name in ("Kr", "Kt"))
    ior = index(params)
    surface = total(
        [
            diffuse(base),
            glossy(coat, even_alpha(params, textures, 0.1), ior),
            clear(reflected, transmitted, ior),
        ]
    )
    opacity = textures.colour(params, "opacity", 1.0)
    if opacity in (1, rgb([1, 1, 1])):
        return surface
    return {"type": "mask", "opacity": opacity, "bsdf": surface}


def clear(reflected: Value, transmitted: Value, ior: float) -> Lobe:
    if transmitted in (0, rgb([0, 0, 0])):
        return glossy(reflected, 0.0, ior)
    return interface(reflected, transmitted, {"type": "dielectric", "int_ior": ior})


def mix(params: Params, textures: Textures, named: Named) -> dict[str, Any]:
    """`amount` is the share of the first material."""
    names = [params.text(f"namedmaterial{i}") for i in (2, 1)]
    amount = textures.colour(params, "amount", 0.5)
    if is_even(amount) and len(set(numbers(amount))) > 1:
        params.warn("the 'amount' of a mix has no colour: the mean of R, G and B is taken")
    return blend(params, names, named, amount)


def index(params: Params) -> float:
    """Of refraction."""
    name = "eta" if params.get("eta") else "index"
    given = params.get(name)
    if given is not None and given.kind == "texture":
        params.warn("textures of an index of refraction are taken as 1.5")
    return params.number(name, 1.5)


MATERIALS: dict[str, Callable[[Params, Textures], dict[str, Any]]]
MATERIALS = {
    "disney": disney,
    "glass": glass,
    "matte": matte,
    "metal": metal,
    "mirror": mirror,
    "plastic": plastic,
    "substrate": substrate,
    "translucent": translucent,
    "uber": uber,
}
