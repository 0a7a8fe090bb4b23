"""Layers of what the camera sees first, which need no light."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .. import _core
from ..algorithms.integrator import as_integrator
from .job import Job
from .options import RenderOptions

if TYPE_CHECKING:
    import numpy as np


def first_seen(
    scene: _core.Scene, *, hide_emitters: bool = False, **settings: Any
) -> dict[str, np.ndarray]:
    """The layers that `aovs` and `alpha` ask for, and others, as a render of the scene has them.

    It is the cheapest render that there is. The other arguments are options of renders.
    """
    integrator = {"type": "path", "max_depth": 1, "hide_emitters": hide_emitters}
    options = RenderOptions(spp=1, **settings)
    return Job(scene, as_integrator(scene, integrator), options)._start().result().layers
