"""pbrt-v4 (Pharr, Jakob & Humphreys 2023; https://pbrt.org/fileformat-v4)."""

from .reader import read_pbrt

__all__ = ["read_pbrt"]
