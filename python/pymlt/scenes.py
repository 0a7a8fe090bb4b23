"""Built-in scenes: functions that return a Mitsuba dict for `load_dict` or `render`.

image = mlt.render(mlt.scenes.cornell_box(), spp=64)
"""

from __future__ import annotations

import inspect
import sys

from .transforms import Transform

T = Transform  # short, because chains of transforms are long


def names() -> list[str]:
    """The names of the built-in scenes."""
    module = sys.modules[__name__]
    return [
        name
        for name, function in inspect.getmembers(module, inspect.isfunction)
        if function.__module__ == __name__ and name != "names" and not name.startswith("_")
    ]


def cornell_box() -> dict:
    """The Cornell box (Goral et al. 1984) with the measures and colours of Mitsuba 3's own."""
    white = {"type": "ref", "id": "white"}

    def diffuse(r, g, b):
        return {"type": "diffuse", "reflectance": {"type": "rgb", "value": [r, g, b]}}

    def wall(to_world, bsdf="white"):
        return {"type": "rectangle", "to_world": to_world, "bsdf": {"type": "ref", "id": bsdf}}

    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 8},
        "sensor": {
            "type": "perspective",
            "fov": 39.3077,
            "fov_axis": "smaller",
            "to_world": T.look_at(origin=[0, 0, 3.9], target=[0, 0, 0], up=[0, 1, 0]),
            "film": {
                "type": "hdrfilm",
                "width": 256,
                "height": 256,
                "component_format": "float32",
                "rfilter": {"type": "gaussian"},
            },
            "sampler": {"type": "independent", "sample_count": 64},
        },
        "white": diffuse(0.885809, 0.698859, 0.666422),
        "green": diffuse(0.105421, 0.37798, 0.076425),
        "red": diffuse(0.570068, 0.0430135, 0.0443706),
        "light": {
            "type": "rectangle",
            "to_world": T().translate(0, 0.99, 0.01).rotate([1, 0, 0], 90).scale(0.23, 0.19, 0.19),
            "bsdf": white,
            "emitter": {
                "type": "area",
                "radiance": {"type": "rgb", "value": [18.387, 13.9873, 6.75357]},
            },
        },
        "floor": wall(T().translate(0, -1, 0).rotate([1, 0, 0], -90)),
        "ceiling": wall(T().translate(0, 1, 0).rotate([1, 0, 0], 90)),
        "back": wall(T().translate(0, 0, -1)),
        "green_wall": wall(T().translate(1, 0, 0).rotate([0, 1, 0], -90), "green"),
        "red_wall": wall(T().translate(-1, 0, 0).rotate([0, 1, 0], 90), "red"),
        "small_box": {
            "type": "cube",
            "to_world": T().translate(0.335, -0.7, 0.38).rotate([0, 1, 0], -17).scale(0.3),
            "bsdf": white,
        },
        "large_box": {
            "type": "cube",
            "to_world": T()
            .translate(-0.33, -0.4, -0.28)
            .rotate([0, 1, 0], 18.25)
            .scale(0.3, 0.61, 0.3),
            "bsdf": white,
        },
    }
