"""`near_clip` and `far_clip`: what lies before or behind them is not seen, and blocks nothing."""

import pytest

import pymlt as mlt

CHAINS = ["mlt", "mmlt", "pssmlt"]
ALGORITHMS = ["path", "direct", "bdpt", *CHAINS]
SENSORS = {
    "perspective": {"type": "perspective", "fov": 40},
    "thinlens": {"type": "thinlens", "fov": 40, "aperture_radius": 0.2, "focus_distance": 3},
    "orthographic": {"type": "orthographic"},
}


def wall(depth):
    """A wall across the view, that far from the camera at the origin, which looks along z."""
    placed = mlt.Transform().translate([0, 0, depth]).scale(100)
    grey = {"type": "diffuse", "reflectance": 0.5}
    return {"type": "rectangle", "to_world": placed, "bsdf": {"type": "twosided", "bsdf": grey}}


def scene(sensor, depths, **planes):
    """Walls at these depths in an even light of radiance 1: one that is seen has 0.5."""
    walls = {f"wall_{i}": wall(depth) for i, depth in enumerate(depths)}
    film = {"type": "hdrfilm", "width": 6, "height": 6, "rfilter": {"type": "box"}}
    seen = SENSORS[sensor] | planes | {"film": film}
    return mlt.load_dict({"type": "scene", "sensor": seen, "light": {"type": "constant"}} | walls)


@pytest.mark.parametrize("sensor", SENSORS)
@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize(
    ("depth", "planes", "brightness"),
    [
        (1.9, {"near_clip": 2.0}, 1),
        (2.1, {"near_clip": 2.0}, 0.5),
        (5.1, {"far_clip": 5.0}, 1),
        (4.9, {"far_clip": 5.0}, 0.5),
        (1.9, {"near_clip": 2.0, "far_clip": 5.0}, 1),
        (5.1, {"near_clip": 2.0, "far_clip": 5.0}, 1),
        (3.0, {"near_clip": 2.0, "far_clip": 5.0}, 0.5),
        (1.9, {}, 0.5),
    ],
)
def test_a_wall_is_seen_between_the_planes_alone(sensor, algorithm, depth, planes, brightness):
    image = mlt.render(scene(sensor, [depth], **planes), algorithm, spp=64)
    assert image.mean() == pytest.approx(brightness, abs=0.05 if algorithm in CHAINS else 0.01)


def test_light_tracing_counts_only_what_stands_between_the_planes():
    """A small lamp, seen from 3 units away."""
    lamp = {
        "type": "sphere",
        "center": [0, 0, 3],
        "radius": 0.5,
        "emitter": {"type": "area", "radiance": 1.0},
    }
    film = {"type": "hdrfilm", "width": 4, "height": 4, "rfilter": {"type": "box"}}
    seen = {"type": "perspective", "fov": 40, "film": film}
    means = {}
    for near, far in [(0.1, 9), (3.1, 9), (0.1, 2.4)]:
        sensor = seen | {"near_clip": near, "far_clip": far}
        made = mlt.load_dict({"type": "scene", "sensor": sensor, "lamp": lamp})
        means[near, far] = mlt.render(made, "ptracer", spp=256).mean()
    assert means[0.1, 9] > 0.1
    assert means[3.1, 9] == means[0.1, 2.4] == 0  # the far half of the lamp faces away


@pytest.mark.parametrize(
    ("planes", "message"),
    [
        ({"near_clip": 3.0, "far_clip": 2.0}, "far_clip.*greater than near_clip"),
        ({"near_clip": -1.0}, "near_clip"),
    ],
)
def test_planes_that_make_no_sense_are_refused(planes, message):
    with pytest.raises(mlt.SceneError, match=message):
        scene("perspective", [1], **planes)
