"""A surface with what is around its BSDF."""

from __future__ import annotations

from typing import Any, NamedTuple


class Surface(NamedTuple):
    """What a material says of a surface."""

    bsdf: dict[str, Any]
    opacity: float | dict[str, Any] = 1.0
    normals: dict[str, Any] | None = None
    radiance: dict[str, Any] | None = None
    uv: str | None = None  #: the primvar of its texture coordinates, if it has textures
    of_vertices: bool = False  #: whether it uses the colours of vertices

    def whole(self) -> dict[str, Any]:
        """The BSDF with its normals and holes, on both sides of what lets no light through."""
        made = self.bsdf
        if self.normals is not None:
            made = {"type": "normalmap", "normalmap": self.normals, "bsdf": made}
        if not self.transmits():
            made = {"type": "twosided", "bsdf": made}
        if self.opacity != 1:
            made = {"type": "mask", "opacity": self.opacity, "bsdf": made}
        return made

    def transmits(self) -> bool:
        """Whether light may go through."""
        weights = (self.bsdf.get(f"{name}_weight", 0) for name in ("transmission", "subsurface"))
        return any(weight != 0 for weight in weights)

    def emitter(self) -> dict[str, Any] | None:
        """The area light of a surface that glows."""
        return self.radiance and {"type": "area", "radiance": self.radiance}
