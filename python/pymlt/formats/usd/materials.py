"""Materials (UsdShade): which of their networks is read, and what it says of a surface."""

from __future__ import annotations

from pxr import Usd, UsdShade

from ..imported import Imported
from .materialx import materialx_surface
from .networks import Node
from .open_pbr import open_pbr_surface
from .preview import preview_surface
from .surface import Surface
from .textures import Textures

#: The surface shaders that are read.
SHADERS = {
    "ND_open_pbr_surface_surfaceshader": open_pbr_surface,
    "ND_standard_surface_surfaceshader": materialx_surface,
    "ND_standard_surface_surfaceshader_100": materialx_surface,
    "ND_gltf_pbr_surfaceshader": materialx_surface,
    "UsdPreviewSurface": preview_surface,
}
CONTEXTS = ("mtlx", "")  #: for whom a material has networks: MaterialX first, then everybody


def surface(material: UsdShade.Material, time: Usd.TimeCode, made: Imported) -> Surface | None:
    """What a material says; None, with a warning, if no network of it can be read."""
    nodes = [Node(shader, "surface", time) for shader in shaders(material)]
    known = [node for node in nodes if node.id in SHADERS]
    if not known:
        names = ", ".join(repr(node.id) for node in nodes) or "nothing"
        made.warn(f"materials made of {names} are left out: they become grey")
        return None
    if material.GetDisplacementOutput().HasConnectedSource():
        made.warn("displacement is left out")
    for node in known:
        textures = Textures(node, made)
        found = SHADERS[node.id](textures, made)
        if found is not None:
            if nodes[0].id != node.id:
                made.warn(f"{node.id} is taken of materials that have {nodes[0].id!r} beside it")
            return found._replace(uv=textures.uv, of_vertices=textures.of_vertices)
    return None


def shaders(material: UsdShade.Material) -> list[UsdShade.Shader]:
    """The surface shaders of a material, each once."""
    found = [material.ComputeSurfaceSource(context)[0] for context in CONTEXTS]
    once = {shader.GetPath(): shader for shader in found if shader}
    return list(once.values())
