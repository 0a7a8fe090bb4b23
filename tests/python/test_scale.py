"""A scene's unit of length does not matter: scaled by a power of two, its image has the same bits.

Powers of two scale floating-point numbers exactly, so any difference comes from a threshold, a
density or a choice that depends on the unit.
"""

import numpy as np
import pytest

import pymlt as mlt

T = mlt.Transform
START = {"luminance_samples": 2000}
INTEGRATORS = {
    "path": mlt.Path(),
    "direct": mlt.Direct(),
    "ptracer": mlt.PTracer(),
    "bdpt": mlt.BDPT(),
    "pssmlt": mlt.PSSMLT(**START),
    "mmlt": mlt.MMLT(**START),
    "rjmlt": mlt.RJMLT(**START),
    "erpt": mlt.ERPT(**START),
    "mlt": mlt.MLT(adaptive=False, independent="bdpt", **START),
    "mlt, adaptive and in two stages": mlt.MLT(two_stage=True, independent="bdpt", **START),
}


def rgb(*value):
    return {"type": "rgb", "value": value}


def diffuse(*value):
    return {"type": "diffuse", "reflectance": rgb(*value)}


class Room:
    """Things in [-1, 1]^3, all lengths times `unit`."""

    def __init__(self, unit: float):
        self.unit = unit

    def at(self, *xyz):
        return [self.unit * x for x in xyz]

    def placed(self, transform):
        return T.scale(self.unit) @ transform

    def camera(self, kind: str, **more):
        to_world = T.look_at(origin=self.at(0.2, 0.3, 3.6), target=self.at(0, 0, 0), up=[0, 1, 0])
        film = {"type": "hdrfilm", "width": 16, "height": 12, "rfilter": {"type": "box"}}
        return {"type": kind, "to_world": to_world, "film": film, **more}

    def wall(self, axis, angle, **bsdf_or_light):
        placed = T.rotate(axis, angle) @ T.translate((0, 0, -1))
        return {"type": "rectangle", "to_world": self.placed(placed), **bsdf_or_light}

    def ball(self, center, radius, **bsdf_or_light):
        return {"type": "sphere", "center": self.at(*center), "radius": self.unit * radius,
                **bsdf_or_light}  # fmt: skip

    def lamp(self, *radiance):
        placed = T.translate((0, 0.98, 0)) @ T.rotate([1, 0, 0], 90) @ T.scale(0.4)
        return {"type": "rectangle", "to_world": self.placed(placed),
                "emitter": {"type": "area", "radiance": rgb(*radiance)}}  # fmt: skip

    def walls(self):
        return {
            "back": self.wall([1, 0, 0], 0, bsdf=diffuse(0.7, 0.7, 0.7)),
            "floor": self.wall([1, 0, 0], -90, bsdf=diffuse(0.6, 0.6, 0.5)),
            "left": self.wall([0, 1, 0], 90, bsdf=diffuse(0.6, 0.1, 0.05)),
        }


def things(unit: float) -> dict:
    """Many kinds of surfaces and lights, before a thin lens."""
    room = Room(unit)
    lens = {"fov": 40, "aperture_radius": 0.1 * unit, "focus_distance": 3.5 * unit}
    checks = {"type": "checkerboard", "color0": 0.0, "color1": 1.0}
    green = diffuse(0.1, 0.5, 0.1)
    bumpy = {"type": "bumpmap", "arbitrary": checks, "scale": 0.01 * unit, "bsdf": green}
    copper = {"type": "roughconductor", "material": "Cu", "alpha": 0.1}
    leaf = T.translate((0.4, 0.2, 0.5)) @ T.rotate([0, 1, 0], 30) @ T.scale(0.3)
    group = {"type": "shapegroup", "cube": {"type": "cube", "to_world": room.placed(T.scale(0.2)),
             "bsdf": {"type": "roughplastic", "alpha": 0.1}}}  # fmt: skip
    aside = T.translate(room.at(-0.6, -0.8, 0.3)) @ T.rotate([0, 1, 0], 20)
    spot = T.look_at(origin=room.at(0, 0.9, 0.5), target=room.at(0.3, -1, 0), up=[0, 0, 1])
    return {
        "type": "scene",
        "sensor": room.camera("thinlens", **lens),
        **room.walls(),
        "right": room.wall([0, 1, 0], -90, bsdf=bumpy),
        "lamp": room.lamp(6, 5, 4),
        "glass": room.ball((0.35, -0.6, 0.2), 0.4, bsdf={"type": "dielectric"}),
        "leaf": {"type": "rectangle", "to_world": room.placed(leaf),
                 "bsdf": {"type": "mask", "opacity": 0.6, "bsdf": diffuse(0.4, 0.7, 0.2)}},
        "metal": {"type": "cylinder", "p0": room.at(-0.5, -0.3, -0.5), "p1": room.at(-0.2, 0, -0.3),
                  "radius": 0.2 * unit, "bsdf": copper},
        "group": group,
        "cube": {"type": "instance", "to_world": aside,
                 "shapegroup": {"type": "ref", "id": "group"}},
        "bulb": room.ball((-0.6, 0.5, 0.3), 0.1,
                          emitter={"type": "area", "radiance": rgb(4, 3, 2)}),
        "point": {"type": "point", "position": room.at(0.5, 0.5, 0.5),
                  "intensity": rgb(0.2 * unit**2, 0.2 * unit**2, 0.3 * unit**2)},
        "spot": {"type": "spot", "to_world": spot, "intensity": rgb(unit**2, unit**2, unit**2)},
        "sun": {"type": "directional", "direction": [-0.3, -0.7, -1],
                "irradiance": rgb(1, 0.9, 0.8)},
        "sky": {"type": "constant", "radiance": rgb(0.1, 0.2, 0.3)},
    }  # fmt: skip


def media(unit: float) -> dict:
    """Fog around the lens, and smoke and milk in it."""
    room = Room(unit)
    fog = {"type": "homogeneous", "sigma_t": rgb(0.25 / unit, 0.35 / unit, 0.5 / unit),
           "albedo": rgb(0.9, 0.8, 0.6), "phase": {"type": "hg", "g": 0.5}}  # fmt: skip
    milk = {"type": "homogeneous", "sigma_t": 4 / unit, "albedo": 0.9}
    in_box = room.placed(T.translate((-0.9, -0.9, -0.3)) @ T.scale(0.8))
    data = np.random.default_rng(1).uniform(0, 4 / unit, (4, 4, 4)).astype(np.float32)
    smoke = {"type": "heterogeneous", "albedo": 0.7,
             "sigma_t": {"type": "gridvolume", "data": data, "to_world": in_box}}  # fmt: skip
    box = T.translate((-0.5, -0.5, 0.1)) @ T.scale(0.4)
    outside = {"type": "ref", "id": "fog"}
    return {
        "type": "scene",
        "fog": fog,
        "sensor": room.camera("perspective", fov=40, medium=outside),
        **room.walls(),
        "lamp": room.lamp(12, 10, 8),
        "milk": room.ball((0.35, -0.6, 0.2), 0.4, bsdf={"type": "dielectric"}, interior=milk,
                          exterior=outside),
        "smoke": {"type": "cube", "to_world": room.placed(box), "bsdf": {"type": "null"},
                  "interior": smoke, "exterior": outside},
    }  # fmt: skip


@pytest.mark.parametrize("integrator", INTEGRATORS.values(), ids=INTEGRATORS.keys())
@pytest.mark.parametrize("scene", [things, media])
def test_the_unit_of_length_does_not_matter(scene, integrator):
    def image(unit):
        return mlt.render(scene(unit), integrator, spp=4, seed=1, threads=1)

    usual = image(1.0)
    assert usual.std() > 0.01
    for unit in (2.0**-20, 2.0**20):
        np.testing.assert_array_equal(image(unit), usual)
