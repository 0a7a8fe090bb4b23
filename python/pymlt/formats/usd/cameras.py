"""Cameras (UsdGeomCamera), which look along -z, with y up."""

from __future__ import annotations

import math
from typing import Any

from pxr import Usd, UsdGeom

from ..imported import Imported
from ..views import film
from .moments import shutter

TENTH = 0.1  #: focal lengths and apertures are tenths of a unit of the scene


def camera(prim: Usd.Prim, time: Usd.TimeCode, made: Imported) -> dict[str, Any]:
    """A sensor without its place, with a film of its aspect ratio."""
    given = UsdGeom.Camera(prim)
    width, height, aside, above = (
        float(attribute.Get(time)) * TENTH
        for attribute in (
            given.GetHorizontalApertureAttr(),
            given.GetVerticalApertureAttr(),
            given.GetHorizontalApertureOffsetAttr(),
            given.GetVerticalApertureOffsetAttr(),
        )
    )
    found: dict[str, Any] = {"film": film(width / height)}
    start, end = shutter(given, time)
    if end > start:
        found |= {"shutter_open": start, "shutter_close": end}
    if given.GetClippingPlanesAttr().Get(time):
        made.warn("clippingPlanes of cameras are left out")
    if given.GetProjectionAttr().Get(time) == UsdGeom.Tokens.orthographic:
        if aside or above:
            made.warn("offsets of the aperture of orthographic cameras are left out")
        return {"type": "orthographic", "half_width": width / 2} | found
    return perspective(given, time, width) | found | shifted(aside / width, above / height)


def perspective(given: UsdGeom.Camera, time: Usd.TimeCode, width: float) -> dict[str, Any]:
    """The angle of view, and the lens if there is one."""
    focal = float(given.GetFocalLengthAttr().Get(time)) * TENTH
    fov = math.degrees(2 * math.atan(width / 2 / focal))
    found = {"type": "perspective", "fov": fov, "fov_axis": "x"}
    stop, distance = (
        float(attribute.Get(time))
        for attribute in (given.GetFStopAttr(), given.GetFocusDistanceAttr())
    )
    if not stop or not distance:
        return found
    lens = {"aperture_radius": focal / stop / 2, "focus_distance": distance}
    return found | {"type": "thinlens"} | lens


def shifted(aside: float, above: float) -> dict[str, float]:
    """An aperture that is not around the optical axis, by shares of its size."""
    shifts = {"principal_point_offset_x": aside, "principal_point_offset_y": -above}
    return {name: shift for name, shift in shifts.items() if shift}
