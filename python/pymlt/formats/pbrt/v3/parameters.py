"""Parameters of pbrt-v3, as those of pbrt-v4 that say the same."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...limits import TEXT, read_file
from ..spectra import COLDEST, WAVELENGTHS, planck
from ..tokens import Parameter, Token

WIEN = 2.8977721e6  #: nm K: the wavelength where a black body is brightest, times its temperature
#: From XYZ to linear Rec. 709 (pbrt-v3, XYZToRGB).
RGB_OF_XYZ = np.array(
    [
        [3.240479, -1.537150, -0.498535],
        [-0.969256, 1.875991, 0.041556],
        [0.055648, -0.204043, 1.057311],
    ]
)


def translated(given: dict[str, Parameter], where: Token, folder: Path) -> dict[str, Parameter]:
    """Colours of the types that only pbrt-v3 has, and spectra of files."""
    return {name: _translated(parameter, where, folder) for name, parameter in given.items()}


def _translated(given: Parameter, where: Token, folder: Path) -> Parameter:
    if given.kind == "color":
        return given._replace(kind="rgb")
    if given.kind == "xyz":
        colours = np.reshape(given.values, (-1, 3)) @ RGB_OF_XYZ.T
        return Parameter("rgb", colours.clip(min=0).ravel().tolist())
    if given.kind == "blackbody":
        return Parameter("spectrum", brightest_one(*given.values[:2]))
    if given.kind == "spectrum" and isinstance(given.values[0], str):
        path = folder / given.values[0]
        return Parameter("spectrum", _spectrum_of(path, where)) if path.is_file() else given
    return given


def brightest_one(kelvin: float, scale: float = 1.0) -> list[float]:
    """A black body whose brightest wavelength has the value 1, times a scale."""
    if kelvin < COLDEST:
        raise ValueError(f"a black body of {kelvin:g} K does not shine")
    most = planck(WIEN / kelvin, kelvin)
    pairs = [(float(wave), scale * planck(wave, kelvin) / most) for wave in WAVELENGTHS]
    return [number for pair in pairs for number in pair]


def _spectrum_of(path: Path, where: Token) -> list[float]:
    """The wavelengths and values of a file, each pair on a line, without what follows a #."""
    lines = read_file(path, TEXT).decode("utf-8-sig", "replace").splitlines()
    words = [word for line in lines for word in line.partition("#")[0].split()]
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if not values or len(values) % 2:
        raise where.error(f"{path.name} should hold pairs of a wavelength and a value")
    return values
