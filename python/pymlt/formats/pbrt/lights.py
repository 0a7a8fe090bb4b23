"""Lights of pbrt-v4 (Pharr, Jakob & Humphreys 2023, ch. 12)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from .params import Params
from .photometry import brightening
from .spectra import luminance_one, scaled

if TYPE_CHECKING:
    import numpy as np


def light(params: Params, folder: Path, to_world: np.ndarray) -> dict[str, Any] | None:
    """A light that is no shape; None, with a warning, for those without a counterpart."""
    scale = params.number("scale", 1)
    if params.type == "projection":
        from .projection import projection

        return projection(params, folder, to_world, scale)
    if params.type == "goniometric":
        from .goniometric import goniometric

        return goniometric(params, folder, to_world, scale)
    if params.type == "infinite" and (filename := params.text("filename")):
        from .environment import environment

        return environment(params, folder / filename, to_world, scale)
    name = "L" if params.type in ("distant", "infinite") else "I"
    strength = scaled(luminance_one(params.colour(name, 1.0)), scale * brightening(params))
    if params.type == "infinite":
        return {"type": "constant", "radiance": strength}
    return placed(params, to_world, strength)


def placed(params: Params, to_world: np.ndarray, power: Any) -> dict[str, Any] | None:
    """A light of no size: `power` is its irradiance or intensity."""
    import numpy as np

    start, end = (_point(params, n, d) for n, d in (("from", (0, 0, 0)), ("to", (0, 0, 1))))
    position = to_world[:3, :3] @ start + to_world[:3, 3]
    axis = to_world[:3, :3] @ (end - start)
    if params.type == "distant":
        return {"type": "directional", "irradiance": power, "direction": axis.tolist()}
    if params.type in ("point", "goniometric"):  # of pbrt-v3, without an image
        return {"type": "point", "intensity": power, "position": position.tolist()}
    if params.type == "spot":
        from ...scenes.transforms import Transform

        params.warn("the edge of a spot light falls off linearly with the angle")
        cone = params.number("coneangle", 30)
        up = np.eye(3)[np.argmin(abs(axis))]
        return {
            "type": "spot",
            "intensity": power,
            "cutoff_angle": cone,
            "beam_width": max(0.0, cone - params.number("conedeltaangle", 5)),
            "to_world": Transform.look_at(position, position + axis, up).matrix,
        }
    params.warn(f"the light {params.type!r} has no counterpart")
    return None


def _point(params: Params, name: str, default: tuple[float, ...]) -> np.ndarray:
    import numpy as np

    found = params.array(name, 3)
    return np.array(default, dtype=float) if found is None else found[0]
