"""Colours and spectra of pbrt as those of a scene dict."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ..imported import Imported, rgb
from .tokens import Parameter, Token

if TYPE_CHECKING:
    import numpy as np

GLASSES = {"glass-BK7": 1.5046, "glass-BAF10": 1.67, "glass-F11": 1.62066, "glass-SF11": 1.7847}
GLASSES |= {"glass-FK51A": 1.48656, "glass-LASF9": 1.8502, "glass-SF5": 1.67270}
#: B1 to B3, and C1 to C3 in um^2, as Schott's catalogue has them (SF5: the glass with lead; the
#: others are now made without, as N-BAF10 and so on).
SELLMEIER = {
    "glass-BAF10": "1.5851495 .143559385 1.08521269 .00926681282 .0424489805 105.613573",
    "glass-FK51A": ".971247817 .216901417 .904651666 .00472301995 .0153575612 168.68133",
    "glass-LASF9": "2.00029547 .298926886 1.80691843 .0121426017 .0538736236 156.530829",
    "glass-SF5": "1.46141885 .247713019 .949995832 .0111826126 .0508594669 112.041888",
}
#: Indices of refraction that depend on the wavelength, as scene dicts have them.
DISPERSIVE = {name: f"sellmeier {terms}" for name, terms in SELLMEIER.items()}
DISPERSIVE |= {"glass-BK7": "bk7", "glass-SF11": "sf11"}
REC_709 = (0.212671, 0.715160, 0.072169)  #: the luminances of red, green and blue
COLDEST = 100  #: kelvin, of black bodies; colder ones have no light that a number can hold
TUNGSTEN = 2856  #: kelvin, of CIE standard illuminant A
WAVELENGTHS = range(360, 831, 5)  #: nm


def colour(given: Parameter, where: Token, made: Imported) -> Any:
    """The value of a parameter of type rgb, spectrum, float or blackbody."""
    if given.kind in ("rgb", "color"):
        return rgb(given.values)
    if given.kind == "float":
        return given.values[0]
    if given.kind == "blackbody":
        return blackbody(given.values[0])
    if isinstance(given.values[0], float):
        pairs = list(zip(given.values[::2], given.values[1::2], strict=True))
        return {"type": "spectrum", "value": pairs}
    name = given.values[0]
    if name == "stdillum-A":
        return blackbody(TUNGSTEN)
    if name.startswith("stdillum"):
        return 1.0
    if name in GLASSES:
        return GLASSES[name]
    made.warn(f"the spectrum {name!r} is not known; it is taken as 1", where.place)
    return 1.0


def luminance_one(value: Any) -> Any:
    """A spectrum whose luminance is that of an even one of 1.

    pbrt divides by the luminance of the illuminant alone, so colours stay what they are.
    """
    if not isinstance(value, dict) or value["type"] != "spectrum":
        return value
    waves, heights = zip(*value["value"], strict=True)
    weights = [luminous(wave) for wave in WAVELENGTHS]
    found = sum(
        w * _between(waves, heights, at) for w, at in zip(weights, WAVELENGTHS, strict=True)
    )
    return scaled(value, sum(weights) / found) if found else value


def luminances(colours: np.ndarray) -> np.ndarray:
    """Of linear Rec. 709 colours, (..., 3)."""
    found: np.ndarray = colours @ REC_709
    return found


def _between(waves: Any, heights: Any, at: float) -> float:
    """A spectrum of straight lines; zero beyond its ends."""
    import numpy as np

    return float(np.interp(at, waves, heights, left=0, right=0))


def scaled(value: Any, factor: float) -> Any:
    """A colour times a number."""
    if not isinstance(value, dict):
        return value * factor
    if value["type"] == "rgb":
        return rgb([factor * v for v in value["value"]])
    return value | {"value": [(wave, factor * v) for wave, v in value["value"]]}


def numbers(value: Any) -> list[float]:
    """A colour as three numbers; a spectrum as its luminance."""
    if isinstance(value, dict) and value["type"] == "spectrum":
        even = luminance_one(value)
        value = value["value"][0][1] / even["value"][0][1] if value["value"][0][1] else 1.0
    if isinstance(value, dict):
        value = value["value"]
    return [float(v) for v in value] if isinstance(value, list | tuple) else [float(value)] * 3


def blackbody(kelvin: float) -> dict[str, Any]:
    """Planck's spectrum with the luminance of an even spectrum of 1, as pbrt-v4 has it."""
    if kelvin < COLDEST:
        raise ValueError(f"a black body of {kelvin:g} K does not shine")
    values = [planck(wave, kelvin) for wave in WAVELENGTHS]
    weights = [luminous(wave) for wave in WAVELENGTHS]
    mean = sum(v * w for v, w in zip(values, weights, strict=True)) / sum(weights)
    pairs = [(float(wave), v / mean) for wave, v in zip(WAVELENGTHS, values, strict=True)]
    return {"type": "spectrum", "value": pairs}


def planck(nanometres: float, kelvin: float) -> float:
    """Up to a factor."""
    wave = nanometres * 1e-9
    return (500 / nanometres) ** 5 / math.expm1(0.014387769 / (wave * kelvin))


#: CIE 1931's x, y and z as sums of lobes (height, centre, width below and above it), in nm: the fit
#: of Wyman, Sloan & Shirley 2013, eq. 4.
X = (1.056, 599.8, 37.9, 31.0), (0.362, 442.0, 16.0, 26.7), (-0.065, 501.1, 20.4, 26.2)
Y = (0.821, 568.8, 46.9, 40.5), (0.286, 530.9, 16.3, 31.1)
Z = (1.217, 437.0, 11.8, 36.0), (0.681, 459.0, 26.0, 13.8)
#: Red, green and blue of linear Rec. 709 from X, Y and Z.
FROM_XYZ = [3.240479, -1.537150, -0.498535], [-0.969256, 1.875991, 0.041556]
FROM_XYZ += ([0.055648, -0.204043, 1.057311],)


def matching(lobes: Iterable[tuple[float, float, float, float]], nanometres: float) -> float:
    """One of the CIE's functions X, Y and Z."""

    def lobe(height: float, centre: float, below: float, above: float) -> float:
        width = below if nanometres < centre else above
        return height * math.exp(-0.5 * ((nanometres - centre) / width) ** 2)

    return sum(lobe(*given) for given in lobes)


def luminous(nanometres: float) -> float:
    """The CIE 1931 function y."""
    return matching(Y, nanometres)


def red_green_blue(value: Any) -> list[float]:
    """A colour as three numbers; a spectrum as the colour of its light, cut off at 0."""
    if not isinstance(value, dict) or value["type"] != "spectrum":
        return numbers(value)
    waves, heights = zip(*value["value"], strict=True)
    even = sum(luminous(at) for at in WAVELENGTHS)
    xyz = [
        sum(matching(lobes, at) * _between(waves, heights, at) for at in WAVELENGTHS) / even
        for lobes in (X, Y, Z)
    ]
    rows = (sum(m * v for m, v in zip(row, xyz, strict=True)) for row in FROM_XYZ)
    return [max(0.0, v) for v in rows]
