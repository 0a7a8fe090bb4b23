"""Textures of pbrt-v3, by name."""

from __future__ import annotations

from typing import Any

from ...imported import rgb
from ..params import Params
from ..spectra import numbers
from ..textures import Textures, Value, is_even


class TexturesOfV3(Textures):
    """What has been declared, and what parameters refer to."""

    factors = ("tex1", "tex2")

    def declare(self, name: str, params: Params) -> None:
        for quality in ("aamode", "trilinear"):
            params.get(quality)
        super().declare(name, params)

    def _encoding(self, params: Params) -> dict[str, Any]:
        """PNG and TGA are encoded as sRGB unless `gamma` is false, others if it is true."""
        name = params.text("filename").lower()
        encoded = name.endswith((".png", ".tga"))
        if params.flag("gamma", encoded):
            return {} if encoded else {"gamma": -1.0}
        return {"raw": True} if encoded else {"gamma": 1.0}

    def _make_mix(self, params: Params) -> Value:
        """Between two constants; of textures the larger share is taken."""
        amount = self.number(params, "amount", 0.5)
        parts = [self.colour(params, f"tex{i + 1}", float(i)) for i in range(2)]
        if isinstance(amount, dict) or not all(is_even(part) for part in parts):
            params.warn("a mix of textures is left out; that of the larger share is taken")
            return parts[0 if isinstance(amount, dict) or amount < 0.5 else 1]
        first, second = (numbers(part) for part in parts)
        return rgb([(1 - amount) * a + amount * b for a, b in zip(first, second, strict=True)])
