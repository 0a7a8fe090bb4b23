"""Participating media of pbrt-v4 (Pharr, Jakob & Humphreys 2023, ch. 11)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

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
    make = MEDIA.get(params.type)
    if make is None:
        params.warn(f"the medium {params.type!r} has no counterpart")
        return None
    made = make(params, to_world)
    if params.type == "nanovdb":
        made["sigma_t"]["filename"] = str((folder / params.text("filename")).resolve())
    if g := params.number("g", 0):
        made["phase"] = {"type": "hg", "g": g}
    params.finish()
    return made


def homogeneous(params: Params, to_world: np.ndarray) -> dict[str, Any]:
    scale = params.number("scale", 1)
    if preset := params.text("preset"):
        if preset in PRESETS:
            return {"type": "homogeneous", "material": PRESETS[preset], "scale": scale}
        params.warn(f"the medium preset {preset!r} is not known; it is taken as milk")
    sigma = {name: params.colour(name, MILK[name]) for name in MILK}
    return {"type": "homogeneous", "scale": scale} | sigma


def uniform_grid(params: Params, to_world: np.ndarray) -> dict[str, Any]:
    """Coefficients everywhere alike, times a density."""
    extinction, albedo = _coefficients(params)
    density = _grid(params, "density", 1)
    grey = extinction.min() == extinction.max()
    values = density * extinction[0] if grey else density[..., None] * extinction
    return _heterogeneous(params, _volume(params, to_world, values), albedo)


def nanovdb(params: Params, to_world: np.ndarray) -> dict[str, Any]:
    """The same with a density from a file, of which a grid of temperatures does not glow."""
    extinction, albedo = _coefficients(params)
    factor = {"type": "rgb", "value": extinction.tolist()}
    volume = {"type": "nanovdb", "grid": "density", "to_world": to_world, "scale": factor}
    return _heterogeneous(params, volume, albedo)


def rgb_grid(params: Params, to_world: np.ndarray) -> dict[str, Any]:
    """Two grids: their sum, and a grid of their quotient."""
    import numpy as np

    absorbed, scattered = (
        _grid(params, name, 3) if params.get(name) else np.ones((1, 1, 1, 3)) for name in MILK
    )
    extinction = absorbed + scattered
    albedo = np.divide(scattered, extinction, where=extinction > 0, out=np.zeros_like(extinction))
    volume = _volume(params, to_world, extinction)
    return _heterogeneous(params, volume, _volume(params, to_world, albedo, "edge"))


def _coefficients(params: Params) -> tuple[np.ndarray, list[float]]:
    """The extinction and the albedo of what is everywhere alike."""
    import numpy as np

    absorbed, scattered = (np.array(numbers(params.colour(name, 1.0))) for name in MILK)
    extinction = absorbed + scattered
    albedo = np.divide(scattered, extinction, where=extinction > 0, out=np.zeros(3))
    return extinction, albedo.tolist()


def _heterogeneous(params: Params, volume: dict[str, Any], albedo: Any) -> dict[str, Any]:
    scale = params.number("scale", 1)
    return {"type": "heterogeneous", "sigma_t": volume, "albedo": albedo, "scale": scale}


def _grid(params: Params, name: str, channels: int) -> np.ndarray:
    """(depth, height, width[, 3])."""
    size = [int(params.number(n, 1)) for n in ("nz", "ny", "nx")]
    values = params.array(name, channels)
    if values is None:
        raise params.where.error(f"a {params.type} needs {name!r}")
    if min(size) < 1 or len(values) != size[0] * size[1] * size[2]:
        depth, height, width = size
        raise params.where.error(
            f"{name!r} has {len(values)} values, but nx, ny and nz say {width} x {height} x {depth}"
        )
    return values.reshape(*size, *([3] if channels == 3 else []))


def _volume(
    params: Params, to_world: np.ndarray, values: np.ndarray, border: str = "constant"
) -> dict[str, Any]:
    """A grid from p0 to p1. Outside of it pbrt's values are 0, between which and the outermost ones
    it interpolates, too: so a layer of zeros follows, or with "edge" of the outermost values.
    """
    import numpy as np

    corners = [params.array(name, 3) for name in ("p0", "p1")]
    low = np.zeros(3) if corners[0] is None else corners[0][0]
    high = np.ones(3) if corners[1] is None else corners[1][0]
    cell = (high - low) / values.shape[2::-1]
    placed = np.eye(4)
    placed[:3, :3] = np.diag(high - low + 2 * cell)
    placed[:3, 3] = low - cell
    layer = [(1, 1)] * 3 + [(0, 0)] * (values.ndim - 3)
    data = np.pad(values, layer, mode=border).astype(np.float32)  # type: ignore[call-overload]
    return {"type": "gridvolume", "data": data, "to_world": to_world @ placed}


MEDIA = {"homogeneous": homogeneous, "uniformgrid": uniform_grid, "rgbgrid": rgb_grid}
MEDIA |= {"nanovdb": nanovdb}
