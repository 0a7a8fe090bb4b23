"""Parameters of pbrt-v3, as those of pbrt-v4 that say the same."""

from __future__ import annotations

import numpy as np

from ..spectra import COLDEST, WAVELENGTHS, planck
from ..tokens import Parameter

WIEN = 2.8977721e6  #: nm K: the wavelength where a black body is brightest, times its temperature
#: From XYZ to linear Rec. 709 (pbrt-v3, XYZToRGB).
RGB_OF_XYZ = np.array(
    [
        [3.240479, -1.537150, -0.498535],
        [-0.969256, 1.875991, 0.041556],
        [0.055648, -0.204043, 1.057311],
    ]
)


def translated(given: dict[str, Parameter]) -> dict[str, Parameter]:
    """Colours of the types that only pbrt-v3 has."""
    return {name: _translated(parameter) for name, parameter in given.items()}


def _translated(given: Parameter) -> Parameter:
    if given.kind == "color":
        return given._replace(kind="rgb")
    if given.kind == "xyz":
        colours = np.reshape(given.values, (-1, 3)) @ RGB_OF_XYZ.T
        return Parameter("rgb", colours.clip(min=0).ravel().tolist())
    if given.kind == "blackbody":
        return Parameter("spectrum", brightest_one(*given.values[:2]))
    return given


def brightest_one(kelvin: float, scale: float = 1.0) -> list[float]:
    """A black body whose brightest wavelength has the value 1, times a scale."""
    if kelvin < COLDEST:
        raise ValueError(f"a black body of {kelvin:g} K does not shine")
    most = planck(WIEN / kelvin, kelvin)
    pairs = [(float(wave), scale * planck(wave, kelvin) / most) for wave in WAVELENGTHS]
    return [number for pair in pairs for number in pair]
