"""Blender's evaluated scene as a scene dict of pymlt."""

from .lights import is_light
from .scene import export, stepped_export

__all__ = ["export", "is_light", "stepped_export"]
