"""Blender's evaluated scene as a scene dict of pymlt."""

from .lights import is_light
from .scene import export, looked_through, stepped_export, unknown_textures
from .together import OPEN, Joined

__all__ = [
    "OPEN",
    "Joined",
    "export",
    "is_light",
    "looked_through",
    "stepped_export",
    "unknown_textures",
]
