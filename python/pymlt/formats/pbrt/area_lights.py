"""Area lights of pbrt-v4: their radiance, or the power that gives it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from ..areas import triangle_areas
from ..ply import read_ply
from .arithmetic import Value, multiplied
from .images import pixels
from .params import Params
from .spectra import luminance_one, luminances
from .textures import Textures

if TYPE_CHECKING:
    import numpy as np


class AreaLight(NamedTuple):
    """The light of the shapes that follow."""

    radiance: Any  #: as a scene dict has it; for a light with a power, up to a factor
    power: float | None  #: of each shape, the radiance's own luminance, or its mean, being 1
    sides: int  #: among which a power is shared: 1 or 2

    def emitter(self, shape: dict[str, Any], params: Params) -> dict[str, Any]:
        """The light of one shape, which is placed in the world.

        pbrt makes a light of each triangle, or patch, of a mesh: the power is that of one of them.
        """
        import numpy as np

        if self.power is None:
            return {"type": "area", "radiance": self.radiance}
        areas = areas_of(shape, params)
        if len(areas) > 1:
            what = f"each of the {len(areas)} parts of a {params.type} has the power of its light"
            differ = not np.allclose(areas, areas.mean(), rtol=1e-3)
            params.warn(what + (", spread evenly, as their areas differ" * differ))
        if not areas.mean() > 0:
            raise params.where.error("a light with 'power' has no area")
        ratio = self.power / (np.pi * float(areas.mean()) * self.sides)
        return {"type": "area", "radiance": multiplied(self.radiance, ratio)}


def area_light(params: Params, textures: Textures) -> AreaLight:
    """What AreaLightSource says."""
    sides = shining_sides(params, "diffuse")
    scale, power = params.number("scale", 1), params.number("power", 0)
    radiance: Value = luminance_one(params.colour("L", 1.0))
    if filename := params.text("filename"):
        radiance = textures.bitmap(filename) | {"wrap_mode": "clamp"}
        scale /= mean_luminance(radiance, params) if power > 0 else 1
    params.finish()
    return AreaLight(multiplied(radiance, scale), power if power > 0 else None, sides)


def mean_luminance(bitmap: dict[str, Any], params: Params) -> float:
    found = float(luminances(pixels(bitmap)).mean())
    if not found > 0:
        raise params.where.error("an area light with a 'power' has a black image")
    return found


def shining_sides(params: Params, *types: str) -> int:
    """How many sides shine in pbrt: 1 or 2; what is not the same here is named."""
    both = params.flag("twosided")
    if both:
        params.warn("lights that shine on both sides shine on their outside only")
    if params.type not in types:
        params.warn(f"the area light {params.type!r} is taken as 'diffuse'")
    return 1 + both


def areas_of(shape: dict[str, Any], params: Params) -> np.ndarray:
    """In the world, of each part of a shape that is a light by itself in pbrt."""
    import numpy as np

    to_world = np.asarray(shape["to_world"])[:3, :3]
    scale = abs(np.linalg.det(to_world)) ** (2 / 3)  # of areas, by a similarity
    match shape["type"]:
        case "sphere":
            return np.array([4 * np.pi * shape["radius"] ** 2 * scale])
        case "cylinder":
            height = np.linalg.norm(np.subtract(shape["p1"], shape["p0"]))
            return np.array([2 * np.pi * shape["radius"] * height * scale])
        case "disk":
            return np.array([np.pi * np.linalg.norm(np.cross(*to_world[:, :2].T))])
        case "ply":
            vertices, faces = read_ply(shape)
        case _:
            vertices, faces = shape["vertices"], shape["faces"]
    areas = triangle_areas(vertices, faces, shape["to_world"])
    if params.type == "bilinearmesh":
        return areas.reshape(2, -1).sum(axis=0)
    return areas.sum(keepdims=True) if params.type == "sphere" else areas
