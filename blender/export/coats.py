"""The coat of the Principled BSDF, made of blends.

In Cycles a coat adds its reflection, and what is below loses what the coat reflects to the
direction of view. A blend cannot add, so its parts share the surface: along the normal each
reflects what it does in Cycles, and the base keeps its mean.
"""

from typing import Any, NamedTuple

from pymlt.formats.imported import rgb

from . import surfaces
from .surfaces import blend, index_of, is_number, normal_reflectance, scaled


class Coat(NamedTuple):
    """A clear layer above a surface."""

    weight: Any  #: a number or a texture
    roughness: Any
    ior: float
    tint: tuple[float, float, float]  #: what light along the normal keeps of itself

    def filtered(self, colour: dict) -> dict:
        """A colour below the coat: the tint to the mean of 1 / cos in the coat, for even light."""
        if self.tint == (1, 1, 1) or self.ior <= 1:
            return colour
        squared = self.ior**2
        depth = 2 * squared * (1 - (1 - 1 / squared) ** 0.5)
        return surfaces.tinted(colour, [max(value, 0) ** depth for value in self.tint])

    def over_plastic(self, colour: dict, roughness, ior: float) -> dict:
        """Two dielectrics of the reflectance of both, which share the surface."""
        above, below = normal_reflectance(self.ior), normal_reflectance(ior)
        both = index_of(above + below - above * below)
        kept = passed(self.ior) * passed(ior) / passed(both)
        bare, colour = surfaces.plastic(colour, roughness, ior), scaled(self.filtered(colour), kept)
        share = above / normal_reflectance(both) if both > 1 else 0
        first, second = (surfaces.plastic(colour, r, both) for r in (roughness, self.roughness))
        return blend(self.weight, bare, blend(share, first, second))

    def over(self, surface, colour: dict) -> dict:
        """A metal or glass, which `surface` makes of a colour, with a mirror on a share of it."""
        white = surfaces.metal(rgb([1, 1, 1]), self.roughness)
        coated = blend(normal_reflectance(self.ior), surface(self.filtered(colour)), white)
        return blend(self.weight, surface(colour), coated)

    def dimmed(self, light: dict) -> dict:
        """Light that is emitted below the coat; a texture of its weight does not count."""
        weight = self.weight if is_number(self.weight) else 0
        kept = self.filtered(rgb([passed(self.ior)] * 3))["value"]
        return surfaces.tinted(light, [1 - weight + weight * value for value in kept])


def passed(ior: float) -> float:
    """The mean share of even light that an interface does not reflect."""
    return 1 - surfaces.mean_reflectance(ior) if ior > 1 else 1.0
