"""Materials (UsdShade): which of their networks is read, and what it says of a surface."""

from __future__ import annotations

from pxr import Usd, UsdShade

from ..imported import Imported
from .networks import Node
from .open_pbr import open_pbr_surface
from .preview import preview_surface
from .surface import Surface
from .textures import Textures

#: The surface shaders that are read.
SHADERS = {
    "ND_open_pbr_surface_surfaceshader": open_pbr_surface,
    "UsdPreviewSurface": preview_surface,
}
CONTEXTS = ("mtlx", "")  #: for whom a material has networks: MaterialX first, then everybody


def surface(material: UsdShade.Material, time: Usd.TimeCode, made: Imported) -> Surface | None:
    """What a material says; None, with a warning, if it has no network that is read."""
    nodes = [Node(shader, "surface", time) for shader in shaders(material)]
    known = [node for node in nodes if node.id in SHADERS]
    if not known:
        names = ", ".join(repr(node.id) for node in nodes) or "nothing"
        made.warn(f"materials made of {names} are left out: they become grey")
        return None
    if nodes[0].id != known[0].id:
        made.warn(f"{known[0].id} is taken of materials that have {nodes[0].id!r} beside it")
    if material.GetDisplacementOutput().HasConnectedSource():
        made.warn("displacement is left out")
    textures = Textures(known[0], made)
    found = SHADERS[known[0].id](textures, made)
    return found._replace(uv=textures.uv, of_vertices=textures.of_vertices)


def shaders(material: UsdShade.Material) -> list[UsdShade.Shader]:
    """The surface shaders of a material, each once."""
    found = [material.ComputeSurfaceSource(context)[0] for context in CONTEXTS]
    once = {shader.GetPath(): shader for shader in found if shader}
    return list(once.values())
