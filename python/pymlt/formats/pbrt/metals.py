"""Metals of pbrt: complex indices of refraction by name, of files, or as values."""

from __future__ import annotations

import re
from typing import Any

from ..imported import rgb
from .arithmetic import is_even
from .params import Params
from .textures import Textures

PARTS = ("eta", "k")
#: Both parts in linear Rec. 709, for conductors of which only one part is that of a metal.
METALS = {
    "Ag": ([0.155276, 0.116728, 0.138388], [4.82835, 3.12222, 2.1469]),
    "Al": ([1.6575, 0.880405, 0.521244], [9.22381, 6.2695, 4.837]),
    "Au": ([0.143036, 0.375307, 1.44205], [3.983, 2.38556, 1.60336]),
    "Cu": ([0.201005, 0.92375, 1.10222], [3.91326, 2.45305, 2.14209]),
    "MgO": ([2.08958, 1.65072, 1.59488], [0.0, 0.0, 0.0]),
    "TiO2": ([3.45661, 2.80174, 2.90517], [0.000105265, 0.0, 0.000652887]),
}


def complex_index(params: Params, textures: Textures, prefix: str = "") -> dict[str, Any]:
    """The metal that both parts are of, or each of them; copper has what is not given."""
    metals = [_metal(params, f"{prefix}{part}", part) for part in PARTS]
    if metals[0] and metals[0] == metals[1]:
        return {"material": metals[0]}
    found = {}
    for i, (part, metal) in enumerate(zip(PARTS, metals, strict=True)):
        value = rgb(METALS[metal or "Cu"][i])
        if not metal:
            name, copper = f"{prefix}{part}", value
            value = textures.colour(params, name, 1.0)
            if not is_even(value):
                params.warn(f"a texture as {name!r} is left out; it is that of copper")
                value = copper
        found[part] = value
    return found


def _metal(params: Params, name: str, part: str) -> str:
    """By whose name a part is given, or that it is of by default; "" for values."""
    given = params.get(name)
    if given is None:
        return "Cu"
    match = re.fullmatch(f"metal-(.*)-{part}", str(given.values[0]))
    if match is None or given.kind != "spectrum":
        return ""
    if match[1] == "CuZn":
        params.warn("brass (CuZn) is not known; it is taken as copper")
        return "Cu"
    return match[1] if match[1] in METALS else ""
