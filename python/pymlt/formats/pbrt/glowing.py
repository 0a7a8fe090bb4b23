"""The light of media of pbrt-v4: `Le` times `Lescale`, or that of temperatures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .grids import grid, volume
from .params import Params
from .spectra import luminance_one, red_green_blue, scaled

if TYPE_CHECKING:
    import numpy as np


def glow(params: Params) -> dict[str, Any]:
    """The emission of a medium in which it is the same everywhere; none if there is no `Le`."""
    if not params.get("Le"):
        return {}
    return {
        "emission": scaled(luminance_one(params.colour("Le", 0.0)), params.number("Lescale", 1))
    }


def glow_of_grid(params: Params, to_world: np.ndarray) -> dict[str, Any]:
    """The emission of a medium with a grid, which may have grids of `Lescale` and temperatures."""
    factors = params.array("Lescale", 1)
    varies = factors is not None and len(factors) > 1
    if params.get("temperature"):
        if varies:
            params.warn("a grid of 'Lescale' beside temperatures is taken as its first value")
        return heat(params, volume(params, to_world, grid(params, "temperature", 1)))
    if not params.get("Le") or not varies:
        return glow(params)
    radiance = red_green_blue(luminance_one(params.colour("Le", 0.0)))
    values = grid(params, "Lescale", 1)[..., None] * [radiance]
    return {"emission": volume(params, to_world, values)}


def heat(params: Params, temperatures: dict[str, Any]) -> dict[str, Any]:
    """A black body's light, by a volume of temperatures."""
    cutoff = params.number("temperaturecutoff", 0)  # the name in older files
    return {
        "temperature": temperatures,
        "temperature_offset": params.number("temperatureoffset", cutoff),
        "temperature_scale": params.number("temperaturescale", 1),
        "temperature_normalized": True,
        "emission_scale": params.number("Lescale", 1),
    }
