"""Lengths with units, as numbers of the unit that the input expects."""

from __future__ import annotations

from typing import Any

METRES = {
    "nanometer": 1e-9,
    "micron": 1e-6,
    "millimeter": 1e-3,
    "centimeter": 1e-2,
    "inch": 0.0254,
    "foot": 0.3048,
    "yard": 0.9144,
    "meter": 1.0,
    "kilometer": 1e3,
    "mile": 1609.344,
}
DEGREES = {"degree": 1.0, "radian": 57.29577951308232}
#: What a number without a unit counts; others are metres, as lengths of scenes are.
EXPECTED = {
    ("open_pbr_surface", "thin_film_thickness"): "micron",
    ("standard_surface", "thin_film_thickness"): "nanometer",
    ("gltf_pbr", "iridescence_thickness"): "nanometer",
}


def converted_unit(values: list[float], port: Any) -> list[float]:
    """The values of an input, whose unit may be given; angles become degrees."""
    unit = port.getUnit()
    if unit in DEGREES:
        return [value * DEGREES[unit] for value in values]
    if unit not in METRES:
        return values
    owner = port.getParent()
    expected = EXPECTED.get((owner.getCategory(), port.getName()), "meter")
    return [value * (METRES[unit] / METRES[expected]) for value in values]
