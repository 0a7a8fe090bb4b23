"""The grids of values that pbrt-v4's files hold for media."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .params import Params

if TYPE_CHECKING:
    import numpy as np


def grid(params: Params, name: str, channels: int) -> np.ndarray:
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


def volume(
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
