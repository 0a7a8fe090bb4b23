"""How a stage is to be rendered (UsdRenderSettings): by which camera, at which size."""

from __future__ import annotations

import math
from typing import Any

from pxr import Sdf, Usd, UsdRender

from ..imported import Imported


class Settings:
    """The settings that a stage names, if it names some."""

    def __init__(self, stage: Usd.Stage):
        found = UsdRender.Settings.GetStageRenderSettings(stage)
        self._size: dict[str, int] = {}
        self._camera = None
        self._name = ""
        if found:
            targets = found.GetCameraRel().GetForwardedTargets()
            self._camera = targets[0] if targets else None
            if found.GetResolutionAttr().HasAuthoredValue():
                width, height = found.GetResolutionAttr().Get()
                self._size = {"width": int(width), "height": int(height)}

    def sized(self, sensor: dict[str, Any]) -> dict[str, Any]:
        """The sensor with a film of the size of the settings.

        A film of another aspect ratio shows more on two sides than the aperture of the camera has.
        """
        if not self._size:
            return sensor
        film = sensor["film"] | self._size
        aspect = sensor["film"]["width"] / sensor["film"]["height"]
        wider = film["width"] / film["height"] / aspect
        changed: dict[str, Any] = {"film": film}
        if wider > 1 and "half_width" in sensor:
            changed["half_width"] = sensor["half_width"] * wider
        elif wider > 1:
            half = math.tan(math.radians(sensor["fov"]) / 2) / aspect
            changed |= {"fov": 2 * math.degrees(math.atan(half)), "fov_axis": "y"}
        return sensor | changed

    def note(self, source: Sdf.Path | None, name: str) -> None:
        """What the part of a prim is called in the scene."""
        if source is not None and source == self._camera:
            self._name = name

    def order(self, made: Imported) -> None:
        """Puts the camera of the settings before all others, so that it renders."""
        if self._name:
            first = {"type": "scene", self._name: made.scene[self._name]}
            made.scene = first | made.scene
