"""Closures of Blender's shaders, each as a BSDF of pymlt."""

import math

from pymlt.formats.imported import rgb

SMOOTH = 1e-3  #: alpha below which a surface counts as a mirror


def is_number(value) -> bool:
    return not isinstance(value, dict)


def twosided(surface: dict) -> dict:
    return {"type": "twosided", "bsdf": surface}


def diffuse(colour) -> dict:
    return {"type": "diffuse", "reflectance": colour}


def mean_reflectance(ior: float) -> float:
    """Schlick's R_0 + (1 - R_0) (1 - cos)^5, integrated over the directions of even light."""
    r = ((ior - 1) / (ior + 1)) ** 2
    return r + (1 - r) / 21 if ior > 1 else 0.0


def metal(colour, roughness) -> dict:
    """Schlick's reflectance, which is `colour` for light along the normal."""
    return {"type": "principled", "metallic": 1.0, "base_color": colour, "roughness": roughness}


def glass(colour, roughness, ior: float) -> dict:
    """A refracting interface; light that enters and leaves is filtered by `colour`."""
    ior = max(ior, 1.001)
    if is_number(roughness) and roughness**2 < SMOOTH:
        made = {"int_ior": ior, "ext_ior": 1.0, "specular_transmittance": root(colour)}
        return {"type": "dielectric", **made}
    made = {"specular_ior": ior, "specular_roughness": roughness}
    return {
        "type": "openpbr",
        "transmission_weight": 1.0,
        "transmission_color": root(colour),
        **made,
    }


def root(colour: dict) -> dict:
    """The root of a colour, which a path through a thing meets twice (Burley 2015, sec. 4)."""
    if colour["type"] != "rgb":
        return colour
    return colour | {"value": [math.sqrt(max(value, 0)) for value in colour["value"]]}


def scaled(colour: dict, factor: float) -> dict:
    """A colour or a texture times a number."""
    return tinted(colour, [factor] * 3)


def tinted(colour: dict, tint) -> dict:
    """A colour or a texture times a colour."""
    if colour["type"] == "rgb":
        return rgb(a * b for a, b in zip(tint, colour["value"], strict=True))
    return {"type": "scale", "scale": rgb(tint), "texture": colour}


def blend(weight, first: dict, second: dict) -> dict:
    """A mix of which `weight` is the share of the second."""
    if is_number(weight) and weight <= 0:
        return first
    if is_number(weight) and weight >= 1:
        return second
    return {"type": "blendbsdf", "weight": weight, "first": first, "second": second}
