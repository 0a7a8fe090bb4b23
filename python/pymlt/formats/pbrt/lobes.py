"""Sums of lobes, which many of pbrt's materials are, as mixtures.

A mixture weighs its parts by numbers that add up to 1; a lobe of the weight w has 1/w times its
colours in return, which may well be above 1: the sum is what pbrt has, whatever the weights.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from ..imported import rgb
from .arithmetic import Value
from .spectra import scaled

#: The colours of BSDFs.
COLOURS = ["reflectance", "specular_reflectance", "specular_transmittance", "transmittance"]
FRESNEL = 0.3  #: of the light that meets a glossy lobe: a guess, for the choice among the lobes


class Lobe(NamedTuple):
    bsdf: dict[str, Any]
    strength: float  #: about how much light it scatters
    transmits: bool = False

    def times(self, factor: float) -> dict[str, Any]:
        """The BSDF, with other colours."""
        changed = {
            name: amplified(self.bsdf[name], factor) for name in COLOURS if name in self.bsdf
        }
        return self.bsdf | changed


def diffuse(colour: Value) -> Lobe:
    return Lobe({"type": "diffuse", "reflectance": colour}, strength(colour))


def diffuse_transmission(colour: Value) -> Lobe:
    transmitter = {"type": "difftrans", "transmittance": colour}
    return Lobe(transmitter, strength(colour), transmits=True)


def glossy(colour: Value, alpha: float, index: float) -> Lobe:
    """What a coating reflects, without the base below it."""
    reflected = {"diffuse_reflectance": 0.0, "specular_reflectance": colour, "int_ior": index}
    return Lobe(coating(alpha) | reflected, FRESNEL * strength(colour))


def coating(alpha: float) -> dict[str, Any]:
    """The smooth or the rough plug-in."""
    rough = {"type": "roughplastic", "distribution": "ggx", "alpha": alpha}
    return rough if alpha > 0 else {"type": "plastic"}


def interface(reflected: Value, transmitted: Value, surface: dict[str, Any]) -> Lobe:
    """Both what a dielectric, which is given without its colours, reflects and refracts."""
    colours = {"specular_reflectance": reflected, "specular_transmittance": transmitted}
    return Lobe(surface | colours, max(strength(reflected), strength(transmitted)), transmits=True)


def total(lobes: list[Lobe]) -> dict[str, Any]:
    """The sum of lobes, on both sides of a surface."""
    least = 1e-5 * sum(lobe.strength for lobe in lobes)
    shine = [lobe for lobe in lobes if lobe.strength > least]
    if not shine:
        return both_sides({"type": "diffuse", "reflectance": 0.0})
    opaque = not any(lobe.transmits for lobe in shine)
    if len(shine) == 1:
        return both_sides(shine[0].bsdf) if opaque else shine[0].bsdf
    sum_of_all = sum(lobe.strength for lobe in shine)
    # Rounded down, for more than 1 in all would be divided by their sum.
    weights = [math.floor(lobe.strength / sum_of_all * 1e6) / 1e6 for lobe in shine]
    parts = [lobe.times(1 / weight) for lobe, weight in zip(shine, weights, strict=True)]
    if not opaque:
        parts = [
            part if lobe.transmits else both_sides(part)
            for lobe, part in zip(shine, parts, strict=True)
        ]
    shares = " ".join(f"{weight:.6f}" for weight in weights)
    nested = {f"bsdf_{i}": part for i, part in enumerate(parts)}
    mixture = {"type": "mixturebsdf", "weights": shares} | nested
    return both_sides(mixture) if opaque else mixture


def both_sides(bsdf: dict[str, Any]) -> dict[str, Any]:
    return {"type": "twosided", "bsdf": bsdf}


def strength(colour: Value) -> float:
    """The largest component; of a texture, which is not known here, 1."""
    if not isinstance(colour, dict):
        return float(colour)
    if colour["type"] == "rgb":
        return max(colour["value"])
    return max(v for _, v in colour["value"]) if colour["type"] == "spectrum" else 1.0


def amplified(colour: Value, factor: float) -> Value:
    """A colour or a texture times a number, also where that is more than a reflectance may be."""
    if not isinstance(colour, dict):
        return {"type": "rawconstant", "value": rgb([factor * colour] * 3)}
    if colour["type"] == "rgb":
        return {"type": "rawconstant", "value": scaled(colour, factor)}
    if colour["type"] == "spectrum":
        waves, heights = zip(*colour["value"], strict=True)
        colour = {"type": "irregular", "wavelengths": list(waves), "values": list(heights)}
    return {"type": "scale", "scale": factor, "texture": colour}
