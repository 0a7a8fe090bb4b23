"""Motion: everything is looked at in the same few moments, those in which the shutter is open."""

from __future__ import annotations

from typing import Any

import numpy as np
from pxr import Usd, UsdGeom

from ... import _core

COUNT = 5  #: of moments of an open shutter: between two of them, half a turn is too much


class Moments:
    """A frame, and the times relative to it at which transforms are asked for."""

    def __init__(self, stage: Usd.Stage):
        authored = stage.HasAuthoredTimeCodeRange()
        self._frame = stage.GetStartTimeCode() if authored else 0.0
        #: Time code of all that is looked at once: the start of the stage's range, if it has one.
        self.time = Usd.TimeCode(self._frame) if authored else Usd.TimeCode.EarliestTime()
        self.shutter = self._shutter(stage)
        start, end = self.shutter
        self.offsets = np.linspace(start, end, COUNT).tolist() if end > start else [0.0]

    def _shutter(self, stage: Usd.Stage) -> tuple[float, float]:
        """From when to when the shutter of a camera is open, of several the widest."""
        opened, closed = [0.0], [0.0]
        for prim in stage.Traverse():
            if prim.IsA(UsdGeom.Camera):
                start, end = shutter(UsdGeom.Camera(prim), self.time)
                if end > start:
                    opened.append(start)
                    closed.append(end)
        return min(opened), max(closed)

    def of(self, prim: Usd.Prim) -> tuple[np.ndarray, bool]:
        """The transforms of a prim, (moments, 4, 4), and whether they place it in the world.

        Raises SceneError for infinite ones.
        """
        xform = UsdGeom.Xformable(prim)
        if not xform:
            return np.eye(4)[None], False
        if len(self.offsets) == 1 or not xform.TransformMightBeTimeVarying():
            times = [self.time]
        else:
            times = [Usd.TimeCode(self._frame + offset) for offset in self.offsets]
        found = matrices(map(xform.GetLocalTransformation, times))
        if not np.isfinite(found).all():
            raise _core.SceneError(f"{prim.GetPath()}: its transform has numbers that are none")
        return found, xform.GetResetXformStack()

    def to_world(self, placed: np.ndarray) -> Any:
        """One matrix for what rests, else an animation."""
        if (placed == placed[0]).all():
            return placed[0]
        # No negative zeros, so that XML says the same.
        keys = zip(self.offsets, placed + 0.0, strict=True)
        return {"type": "animation"} | dict(keys)


def shutter(camera: UsdGeom.Camera, time: Usd.TimeCode) -> tuple[float, float]:
    """When the shutter of a camera opens and closes, relative to the frame."""
    return (
        float(camera.GetShutterOpenAttr().Get(time) or 0),
        float(camera.GetShutterCloseAttr().Get(time) or 0),
    )


def matrices(given: Any) -> np.ndarray:
    """Matrices of USD, which act on rows, as ours, which act on columns: (count, 4, 4)."""
    rows = [np.array(matrix) for matrix in given]
    return np.array(rows, dtype=float).reshape(-1, 4, 4).transpose(0, 2, 1)
