"""Materials of MaterialX 1.39 and older files (.mtlx), read by the package of that project."""

from .reader import read_materials, read_materialx

__all__ = ["read_materials", "read_materialx"]
