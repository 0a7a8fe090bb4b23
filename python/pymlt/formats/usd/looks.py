"""What prims look like: by their material, or by their own colour."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from pxr import Usd, UsdGeom, UsdShade

from ..imported import Imported, rgb
from .materials import surface
from .primvars import flattened
from .textures import VERTEX_COLOURS

GREY = 0.18  #: of what has no colour, as UsdPreviewSurface has it


class Look(NamedTuple):
    """A material on a shape."""

    bsdf: dict[str, Any]
    emitter: dict[str, Any] | None = None
    uv: str | None = None  #: the primvar that holds its texture coordinates, if it has textures
    of_vertices: bool = False  #: whether it needs the colours of vertices

    def parts(self) -> dict[str, Any]:
        """The members of a shape that looks so."""
        return {"bsdf": self.bsdf} | ({"emitter": self.emitter} if self.emitter else {})


class Looks:
    """The looks of a file, each of which is made once."""

    def __init__(self, made: Imported, time: Usd.TimeCode):
        self._made = made
        self._time = time
        self._known: dict[Any, Look] = {}

    def of(self, prim: Usd.Prim) -> Look:
        """How a prim, or a subset of a mesh, looks."""
        binding = UsdShade.MaterialBindingAPI(prim)
        material, _ = binding.ComputeBoundMaterial(UsdShade.Tokens.full)
        if not material:
            return painted(prim, self._time, self._made)
        if material.GetPath() not in self._known:
            self._known[material.GetPath()] = self._look(material)
        return self._known[material.GetPath()]

    def _look(self, material: UsdShade.Material) -> Look:
        """A material as a reference to its BSDF."""
        found = surface(material, self._time, self._made)
        if found is None:
            return Look(matte(GREY))
        known = self._made.add(material.GetPrim().GetName(), found.whole())
        emitter, bsdf = found.emitter(), {"type": "ref", "id": known}
        return Look(bsdf, emitter, found.uv, found.of_vertices)


def painted(prim: Usd.Prim, time: Usd.TimeCode, made: Imported) -> Look:
    """The look of a prim without a material: its displayColor, seen from both sides."""
    if prim.IsA(UsdGeom.Subset):
        prim = prim.GetParent()
    api = UsdGeom.PrimvarsAPI(prim)
    found = api.FindPrimvarWithInheritance("displayColor")
    opacity = api.FindPrimvarWithInheritance("displayOpacity")
    if opacity and opacity.HasValue() and not np.all(flattened(opacity, time) == 1):
        made.warn("displayOpacity is left out: what has no material is opaque")
    colours = flattened(found, time) if found and found.HasValue() else None
    varying = colours is not None and found.GetInterpolation() != UsdGeom.Tokens.constant
    of_vertices = varying and prim.IsA(UsdGeom.Mesh)
    if varying and not of_vertices:
        made.warn("colours that vary over spheres, cubes and the like are left out: their mean is")
    if colours is None or not colours.size:
        colour: Any = GREY
    elif of_vertices:
        colour = VERTEX_COLOURS
    else:
        colour = rgb(np.mean(colours, axis=0))
    return Look(matte(colour), of_vertices=of_vertices)


def matte(colour: Any) -> dict[str, Any]:
    """A diffuse surface with two sides."""
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": colour}}
