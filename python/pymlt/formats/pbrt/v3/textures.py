"""Textures of pbrt-v3, by name."""

from __future__ import annotations

from typing import Any

from ..images import BYTES
from ..params import Params
from ..textures import Textures


class TexturesOfV3(Textures):
    """What has been declared, and what parameters refer to."""

    factors = ("tex1", "tex2")

    def declare(self, name: str, kind: str, params: Params) -> None:
        for quality in ("aamode", "trilinear"):
            params.get(quality)
        super().declare(name, kind, params)

    def _encoding(self, params: Params) -> dict[str, Any]:
        """Images of bytes are encoded as sRGB unless `gamma` is false, others if it is true."""
        encoded = params.text("filename").lower().endswith(BYTES)
        if params.flag("gamma", encoded):
            return {} if encoded else {"gamma": -1.0}
        return {"raw": True} if encoded else {"gamma": 1.0}
