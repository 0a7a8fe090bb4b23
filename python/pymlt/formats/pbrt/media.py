"""Participating media of pbrt-v4 (Pharr, Jakob & Humphreys 2023, ch. 11)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .glowing import glow, glow_of_grid, heat
from .grids import grid, volume
from .params import Params
from .spectra import numbers

if TYPE_CHECKING:
    import numpy as np

MILK = {"sigma_a": [0.0011, 0.0024, 0.014], "sigma_s": [2.55, 3.21, 3.77]}  # per millimetre
PRESETS = {"Apple": "apple", "Chicken1": "chicken1", "Chicken2": "chicken2", "Cream": "cream"}
PRESETS |= {"Ketchup": "ketchup", "Marble": "marble", "Potato": "potato", "Skimmilk": "skimmilk"}
PRESETS |= {"Skin1": "skin1", "Skin2": "skin2", "Spectralon": "spectralon"}
PRESETS |= {"Wholemilk": "wholemilk"}


@dataclass(frozen=True)
class Interface:
    """The ids of the media on both sides of a surface; "" is empty space."""

    interior: str = ""
    exterior: str = ""

    def sides(self) -> dict[str, Any]:
        """The parameters of a shape that is a boundary; none if both sides are alike."""
        if self.interior == self.exterior:
            return {}
        given = {"interior": self.interior, "exterior": self.exterior}
        return {side: {"type": "ref", "id": id} for side, id in given.items() if id}

    def around(self) -> dict[str, Any]:
        """The parameter of a light or camera."""
        return {"medium": {"type": "ref", "id": self.exterior}} if self.exterior else {}


def medium(params: Params, folder: Path, to_world: np.ndarray) -> dict[str, Any] | None:
    """A medium; None, with a warning, for those without a counterpart."""
    if params.type == "nanovdb":
        made = nanovdb(params, to_world, (folder / params.text("filename")).resolve())
    elif make := MEDIA.get(params.type):
        made = make(params, to_world)
    else:
        params.warn(f"the medium {params.type!r} has no counterpart")
        return None
    if g := params.number("g", 0):
        made["phase"] = {"type": "hg", "g": g}
    params.finish()
    return made


def homogeneous(params: Params, to_world: np.ndarray) -> dict[str, Any]:
    scale = params.number("scale", 1)
    if preset := params.text("preset"):
        if preset in PRESETS:
            milk = {"type": "homogeneous", "material": PRESETS[preset], "scale": scale}
            return milk | glow(params)
        params.warn(f"the medium preset {preset!r} is not known; it is taken as milk")
    sigma = {name: params.colour(name, MILK[name]) for name in MILK}
    return {"type": "homogeneous", "scale": scale} | sigma | glow(params)


def uniform_grid(params: Params, to_world: np.ndarray) -> dict[str, Any]:
    """Coefficients everywhere alike, times a density."""
    extinction, albedo = _coefficients(params)
    density = grid(params, "density", 1)
    grey = extinction.min() == extinction.max()
    values = density * extinction[0] if grey else density[..., None] * extinction
    made = _heterogeneous(params, volume(params, to_world, values), albedo)
    return made | glow_of_grid(params, to_world)


def nanovdb(params: Params, to_world: np.ndarray, path: Path) -> dict[str, Any]:
    """The same with a density from a file, which may have a grid of temperatures, too."""
    extinction, albedo = _coefficients(params)
    factor = {"type": "rgb", "value": extinction.tolist()}
    file = {"type": "nanovdb", "filename": str(path), "to_world": to_world}
    made = _heterogeneous(params, file | {"grid": "density", "scale": factor}, albedo)
    if path.is_file() and b"temperature\0" in path.read_bytes():
        made |= heat(params, file | {"grid": "temperature"})
    return made


def rgb_grid(params: Params, to_world: np.ndarray) -> dict[str, Any]:
    """Two grids: their sum, and a grid of their quotient."""
    import numpy as np

    absorbed, scattered = (
        grid(params, name, 3) if params.get(name) else np.ones((1, 1, 1, 3)) for name in MILK
    )
    extinction = absorbed + scattered
    albedo = np.divide(scattered, extinction, where=extinction > 0, out=np.zeros_like(extinction))
    share = volume(params, to_world, albedo, "edge")
    made = _heterogeneous(params, volume(params, to_world, extinction), share)
    if params.get("Le"):
        made["emission"] = volume(params, to_world, grid(params, "Le", 3))
        made["emission_scale"] = params.number("Lescale", 1)
    return made


def _coefficients(params: Params) -> tuple[np.ndarray, list[float]]:
    """The extinction and the albedo of what is everywhere alike."""
    import numpy as np

    absorbed, scattered = (np.array(numbers(params.colour(name, 1.0))) for name in MILK)
    extinction = absorbed + scattered
    albedo = np.divide(scattered, extinction, where=extinction > 0, out=np.zeros(3))
    return extinction, albedo.tolist()


def _heterogeneous(params: Params, extinction: dict[str, Any], albedo: Any) -> dict[str, Any]:
    scale = params.number("scale", 1)
    return {"type": "heterogeneous", "sigma_t": extinction, "albedo": albedo, "scale": scale}


MEDIA = {"homogeneous": homogeneous, "uniformgrid": uniform_grid, "rgbgrid": rgb_grid}
