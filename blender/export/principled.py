"""The Principled and the Metallic BSDF as `openpbr`, which has their parameters."""

import math

from pymlt.formats.imported import rgb

from . import surfaces
from .surfaces import is_number, mean_reflectance, tinted
from .textures import Textures

#: The socket of each parameter, a colour or a number, or a texture of these.
TEXTURED = {
    "base_color": "Base Color",
    "base_metalness": "Metallic",
    "base_diffuse_roughness": "Diffuse Roughness",
    "specular_color": "Specular Tint",
    "specular_roughness": "Roughness",
    "specular_roughness_anisotropy": "Anisotropic",
    "transmission_weight": "Transmission Weight",
    "transmission_color": "Base Color",
    "subsurface_weight": "Subsurface Weight",
    "subsurface_color": "Base Color",
    "coat_weight": "Coat Weight",
    "coat_color": "Coat Tint",
    "coat_roughness": "Coat Roughness",
    "fuzz_weight": "Sheen Weight",
    "fuzz_color": "Sheen Tint",
    "fuzz_roughness": "Sheen Roughness",
}
CONSTANT = {
    "subsurface_radius": "Subsurface Scale",
    "subsurface_radius_scale": "Subsurface Radius",
    "subsurface_scatter_anisotropy": "Subsurface Anisotropy",
    "coat_ior": "Coat IOR",
    "thin_film_thickness": "Thin Film Thickness",
    "thin_film_ior": "Thin Film IOR",
}
METALLIC = {
    "base_color": "Base Color",
    "specular_color": "Edge Tint",
    "specular_roughness": "Roughness",
    "specular_roughness_anisotropy": "Anisotropy",
}


def principled(node, textures: Textures) -> dict:
    """The BSDF of a Principled node without its normals and its opacity."""
    made = adapted(read(node, textures, TEXTURED))
    ior, level = (textures.constant(node.inputs[name]) for name in ("IOR", "Specular IOR Level"))
    if not made.get("transmission_weight"):
        ior = scaled_ior(ior, level)
    coat = made.get("coat_weight", 0)
    if coat and not lets_light_in(made):  # in Cycles it reflects as if there were no coat
        weight = coat if is_number(coat) else 1
        ior /= 1 - weight + weight / made["coat_ior"]
    if made.get("subsurface_weight"):
        made["subsurface_radius"] /= 4 * math.pi  # to the mean free path
        made["subsurface_color"] = without_interface(made["subsurface_color"], ior)
        made["subsurface_radius_scale"] = rgb(made["subsurface_radius_scale"])
    if is_smooth_glass(made):
        return surfaces.glass(made["base_color"], 0, ior)
    return {"type": "openpbr", "specular_ior": ior, **made}


def metallic(node, textures: Textures) -> dict:
    """The BSDF of a Metallic node without its normals."""
    return {"type": "openpbr", "base_metalness": 1.0} | adapted(read(node, textures, METALLIC))


def read(node, textures: Textures, textured: dict[str, str]) -> dict:
    """What the sockets of a node say, without what belongs to a weight of 0."""
    sockets, found = node.inputs, {}
    for name, socket in (textured | CONSTANT).items():
        weight = f"{name.partition('_')[0]}_weight"
        if socket in sockets and (name == weight or found.get(weight, 1) != 0):
            is_colour = sockets[socket].type == "RGBA"
            value = textures.colour if is_colour else textures.number
            found[name] = (textures.constant if name in CONSTANT else value)(sockets[socket])
    return found


def adapted(found: dict) -> dict:
    """The parameters of `openpbr` that mean something else in Blender."""
    if found.get("base_metalness") == 1:
        found |= {"transmission_weight": 0.0, "subsurface_weight": 0.0}
    if found.get("transmission_weight"):
        found["transmission_color"] = surfaces.root(found["transmission_color"])
    if found.get("coat_weight"):
        found["coat_darkening"] = 0.0
    if film := found.get("thin_film_thickness"):
        found |= {"thin_film_weight": 1.0, "thin_film_thickness": film / 1000}
    stretched = found["specular_roughness_anisotropy"]
    if is_number(stretched) and stretched > 0:  # both have alphas of this ratio and product
        ratio = 1 - 0.9 * stretched
        found["specular_roughness_anisotropy"] = 1 - ratio
        if is_number(found["specular_roughness"]):
            wider = ((1 + ratio**2) / (2 * ratio)) ** 0.25
            found["specular_roughness"] = min(found["specular_roughness"] * wider, 1.0)
    return found


def is_smooth_glass(made: dict) -> bool:
    """Whether an interface that refracts is all that there is."""
    roughness = made["specular_roughness"]
    others = ("base_metalness", "coat_weight", "fuzz_weight", "thin_film_weight")
    is_clear = made.get("transmission_weight") == 1 and made["specular_color"] == rgb([1, 1, 1])
    is_smooth = is_number(roughness) and roughness**2 < surfaces.SMOOTH
    return is_clear and is_smooth and not any(made.get(name) for name in others)


def lets_light_in(made: dict) -> bool:
    weights = (made.get(f"{name}_weight") for name in ("transmission", "subsurface"))
    return made.get("type") == "dielectric" or any(weights)


def scaled_ior(ior: float, level: float) -> float:
    """The index of which the reflectance along the normal is 2 `level` times that of `ior`."""
    root = min((ior - 1) / (ior + 1) * (2 * max(level, 0)) ** 0.5, 0.99)
    return (1 + root) / (1 - root)


def without_interface(colour: dict, ior: float) -> dict:
    """The colour below an interface that reflects light back inside, which Cycles leaves out.

    Saunderson 1942 the other way round; a texture stays as it is.
    """
    kept = (1 - mean_reflectance(ior)) / ior**2  # of even light from below
    if colour["type"] != "rgb" or not 0 < kept < 1:
        return colour
    return rgb(value / (kept + (1 - kept) * value) for value in colour["value"])


def dimmed(light: dict, made: dict) -> dict:
    """Light that is emitted below the coat; textures of its weight and its tint do not count."""
    weight = made.get("coat_weight", 0)
    if not is_number(weight) or weight <= 0:
        return light
    kept, tint = 1 - mean_reflectance(made["coat_ior"]), made["coat_color"].get("value", [1] * 3)
    return tinted(light, [1 - weight + weight * kept * value for value in tint])
