"""glTF 2.0 (Khronos 2021), read by pygltflib."""

from .reader import read_gltf

__all__ = ["read_gltf"]
