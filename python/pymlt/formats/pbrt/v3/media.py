"""Participating media of pbrt-v3 (Pharr, Jakob & Humphreys 2016, ch. 11)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import media
from ..params import Params
from ..tokens import Parameter

if TYPE_CHECKING:
    import numpy as np

MILK = {name: Parameter("rgb", values) for name, values in media.MILK.items()}


def medium(params: Params, folder: Path, to_world: np.ndarray) -> dict[str, Any] | None:
    """A grid of densities has the coefficients of milk if none are given, as all media have."""
    if params.type == "heterogeneous":
        params = params.taken_as("uniformgrid", MILK)
    return media.medium(params, folder, to_world)
