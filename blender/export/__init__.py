"""Blender's evaluated scene as a scene dict of pymlt."""

from .scene import export, stepped_export

__all__ = ["export", "stepped_export"]
