"""Motion blur of pbrt: transforms at the start and at the end of a time, as an animation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

#: Which of the two transforms the names of ActiveTransform mean.
ACTIVE = {"All": (0, 1), "EndTime": (1,), "StartTime": (0,)}


def moves(matrices: list[np.ndarray]) -> bool:
    import numpy as np

    return not np.array_equal(*matrices)


def animation(
    to_world: np.ndarray, matrices: list[np.ndarray], times: tuple[float, float]
) -> dict[str, Any]:
    """The motion of what `to_world` places with the first of two matrices."""
    import numpy as np

    from_start = matrices[1] @ np.linalg.inv(matrices[0])
    start, end = times
    # No negative zeros, so that XML says the same.
    return {"type": "animation", start: to_world + 0.0, end: from_start @ to_world + 0.0}


def after(to_world: Any, local: np.ndarray) -> Any:
    """A transform, or each of an animation, after another one."""
    if not isinstance(to_world, dict):
        return to_world @ local
    return {time: matrix if time == "type" else matrix @ local for time, matrix in to_world.items()}
