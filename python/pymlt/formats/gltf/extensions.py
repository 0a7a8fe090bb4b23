"""What a material says by one of its extensions: factors and textures, whose types are checked."""

from __future__ import annotations

from typing import Any

from .checked import check_types, number, numbers, texture_info


class Extension:
    """An extension, which may be absent: then every value is its default."""

    def __init__(self, material: Any, name: str):
        given = (material.extensions or {}).get(name)
        check_types(given, dict[str, Any], name)
        self.is_given = given is not None
        self._given: dict[str, Any] = given or {}

    def number(self, name: str, default: float = 0.0) -> float:
        """One number. Raises SceneError for what is none."""
        return number(self._given.get(name, default), name)

    def colour(self, name: str, default: float = 1.0) -> list[float]:
        """Red, green and blue, by default the same. Raises SceneError for what is no colour."""
        return numbers(self._given.get(name, [default] * 3), 3, name)

    def texture(self, name: str) -> Any:
        """What the file says of a texture; None without one."""
        return texture_info(self._given.get(name), name)
