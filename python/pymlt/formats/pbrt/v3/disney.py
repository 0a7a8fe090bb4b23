"""The material "disney" of pbrt-v3 (Burley 2015), which `principled` is, too."""

from __future__ import annotations

from typing import Any

from ..lobes import both_sides
from ..params import Params
from ..textures import Textures

#: Parameters of any value, with their defaults, and what they are called here.
NUMBERS = {"anisotropic": 0.0, "roughness": 0.5, "sheen": 0.0, "sheentint": 0.5}
NUMBERS |= {"speculartint": 0.0, "spectrans": 0.0}
SOLID = {"clearcoat": 0.0, "clearcoatgloss": 1.0, "metallic": 0.0}
THIN = {"difftrans": 1.0, "flatness": 0.0}
NAMES = {"clearcoatgloss": "clearcoat_gloss", "difftrans": "diff_trans"}
NAMES |= {"sheentint": "sheen_tint", "spectrans": "spec_trans", "speculartint": "spec_tint"}


def disney(params: Params, textures: Textures) -> dict[str, Any]:
    """A sheet that is thin has other parameters than a solid."""
    thin = params.flag("thin")
    surface: dict[str, Any] = {"type": "principledthin" if thin else "principled"}
    surface["base_color"] = textures.colour(params, "color", 0.5)
    surface["eta"] = params.number("eta", 1.5)
    for name, default in (NUMBERS | (THIN if thin else SOLID)).items():
        surface[NAMES.get(name, name)] = textures.number(params, name, default)
    if thin or surface["spec_trans"] != 0:
        return surface
    del surface["spec_trans"]
    return both_sides(surface)
