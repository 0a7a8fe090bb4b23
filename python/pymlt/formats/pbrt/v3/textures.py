"""Textures of pbrt-v3, by name."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...imported import rgb
from ..params import Params
from ..spectra import numbers
from ..textures import Textures, Value, is_even

#: What pbrt-v3 reads, and what is usual besides.
BYTES = (".png", ".tga", ".bmp", ".jpg", ".jpeg")


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

    def _make_mix(self, params: Params) -> Value:
        """Between two constants; of textures the larger share is taken."""
        amount = self.number(params, "amount", 0.5)
        first, second = (self.colour(params, f"tex{i + 1}", float(i)) for i in range(2))
        if isinstance(amount, dict) or not is_even(first) or not is_even(second):
            params.warn("a mix of textures is left out; that of the larger share is taken")
            return first if isinstance(amount, dict) or amount < 0.5 else second
        if isinstance(first, float) and isinstance(second, float):
            return (1 - amount) * first + amount * second
        return rgb(np.multiply(1 - amount, numbers(first)) + np.multiply(amount, numbers(second)))
