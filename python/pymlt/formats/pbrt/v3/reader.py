"""A pbrt-v3 file as a scene dict: where it differs from one of pbrt-v4."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ...imported import Imported
from ..params import Params
from ..reader import Reader
from ..tokens import Parameter, Token
from . import views
from .lights import area_light, light
from .materials import PARAMETERS, bsdf
from .media import medium
from .parameters import translated
from .textures import TexturesOfV3


class ReaderOfV3(Reader):
    """One file while it is read."""

    version = 3
    textures = TexturesOfV3
    views = views
    area_light = staticmethod(area_light)
    bsdf = staticmethod(bsdf)
    exposure_time = staticmethod(views.exposure_time)
    light = staticmethod(light)
    medium = staticmethod(medium)
    sensitivity = staticmethod(views.sensitivity)

    def __init__(self, path: Path, made: Imported):
        super().__init__(path, made)
        self._views["PixelFilter"] = {"type": "box"}

    def _given(self, directive: Token, kind: str, given: dict[str, Parameter]) -> Params:
        return super()._given(directive, kind, translated(given))

    def _on_material(self, directive: Token) -> None:
        params = self._params(directive)
        self._state.made_of = params
        self._state.material = self._material(params)

    def _on_named_material(self, directive: Token) -> None:
        super()._on_named_material(directive)
        self._state.made_of = None

    def _surface(self, params: Params) -> dict[str, Any]:
        """A shape may change parameters of its material, unless that has a name."""
        given = self._state.made_of
        if given is None and self._state.material:
            return super()._surface(params)
        changed = params.part(PARAMETERS.split())
        if not changed:
            return super()._surface(params)
        matte = Params(params.where, "matte", {}, self._made)
        return self._material((given or matte).changed(changed))
