"""What glows before the camera of a transparent film.

`hide_emitters` leaves out all light that is seen directly, since the world is to be left out.
What glows is opaque, so its light is rendered by itself and added.
"""

import numpy as np

import pymlt as mlt

from .export import is_light

SAMPLES = 64  #: per pixel; only edges need them


def seen_directly(described: dict, seed: int, at=lambda world: world) -> np.ndarray | float:
    """The light of surfaces that glow, (height, width, 3); 0 if there are none.

    `at` chooses the time of a scene that has several frames.
    """
    kept = {name: plugin for name, plugin in described.items() if not is_light(plugin)}
    if not any("emitter" in plugin for plugin in kept.values() if isinstance(plugin, dict)):
        return 0.0
    return mlt.render(at(mlt.load_dict(kept)), mlt.Path(max_depth=1), spp=SAMPLES, seed=seed)
