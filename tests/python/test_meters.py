"""Sensors of one value: `radiancemeter` along a ray, `distant` for what leaves the scene."""

import math

import numpy as np
import pytest

import pymlt as mlt

ALGORITHMS = ["path", "direct", "bdpt", "mlt", "mmlt", "pssmlt"]
ALBEDO, SUN = 0.6, 2.5


def sensor(kind, size=1, rfilter="box", **given):
    film = {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": rfilter}}
    return {"type": kind, "film": film} | given


def measured(meter, algorithm="path", spp=4096, **parts):
    scene = mlt.load_dict({"type": "scene", "sensor": meter} | parts)
    return mlt.render(scene, algorithm, spp=spp)[0, 0]


def plane(half=50):
    """A grey plane below a sun overhead; y is up."""
    placed = mlt.Transform.rotate([1, 0, 0], -90).scale(half)
    grey = {"type": "diffuse", "reflectance": ALBEDO}
    sun = {"type": "directional", "direction": [0, -1, 0], "irradiance": SUN}
    return {"plane": {"type": "rectangle", "to_world": placed, "bsdf": grey}, "sun": sun}


def lamp(center, radius=1.0):
    light = {"type": "area", "radiance": {"type": "rgb", "value": [3, 2, 1]}}
    return {"type": "sphere", "center": center, "radius": radius, "emitter": light}


PLACES = {
    "ray": {"origin": [1, 2, 3], "direction": [0, 2, 0]},
    "to_world": {"to_world": mlt.Transform.look_at([1, 2, 3], [1, 4, 3], [1, 0, 0])},
}


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize("place", PLACES)
def test_a_radiance_meter_has_the_radiance_of_the_lamp_before_it(place, algorithm):
    meter = sensor("radiancemeter", **PLACES[place])
    found = measured(meter, algorithm, spp=64, lamp=lamp([1.5, 6, 3]))
    assert found == pytest.approx([3, 2, 1], rel=1e-4)
    beside = measured(meter, "path", spp=64, lamp=lamp([2.1, 6, 3]))
    assert (beside == 0).all()


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize(
    "meter",
    [
        sensor("radiancemeter", origin=[1, 2, 0], direction=[0.5, -1, 0.2]),
        sensor("distant", direction=[0.3, -1, 0.2], target=[1, 0, 2]),
    ],
    ids=lambda meter: meter["type"],
)
def test_a_plane_below_a_sun_has_the_radiance_of_its_irradiance(meter, algorithm):
    found = measured(meter, algorithm, **plane())
    assert found == pytest.approx([ALBEDO * SUN / math.pi] * 3, rel=0.02)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_without_a_target_it_is_the_mean_over_the_bounding_sphere(algorithm):
    """A sphere of radius 1 that is lit from where the meter is, in one of radius sqrt(3).

    Over the disk that it covers, cos(theta) has the mean 2/3.
    """
    ball = {"type": "sphere", "bsdf": {"type": "diffuse", "reflectance": ALBEDO}}
    sun = {"type": "directional", "direction": [0, 0, 1], "irradiance": SUN}
    found = measured(sensor("distant", direction=[0, 0, 1]), algorithm, 16384, ball=ball, sun=sun)
    deviation = 0.043 if algorithm == "pssmlt" else 0.011  # of 12 seeds; of mmlt for the others
    expected = ALBEDO * SUN / math.pi * 2 / 3 / 3
    assert found == pytest.approx([expected] * 3, rel=4 * deviation)


@pytest.mark.parametrize("kind", ["radiancemeter", "distant"])
def test_an_even_light_is_measured_as_it_is(kind):
    """Also where there are no shapes."""
    found = measured(sensor(kind), spp=16, light={"type": "constant", "radiance": 0.7})
    assert found == pytest.approx([0.7] * 3)


def test_a_scene_far_away_is_measured_like_one_at_the_origin():
    far = np.array([1e7, -2e7, 3e7])
    above = np.add(far, [0, 4, 0])
    for meter in (
        sensor("radiancemeter", origin=far, direction=[0, 1, 0]),
        sensor("distant", direction=[0, 1, 0], target=above),
    ):
        assert measured(meter, spp=16, lamp=lamp(above)) == pytest.approx([3, 2, 1])


def test_light_tracing_refuses_a_single_ray():
    scene = mlt.load_dict({"type": "scene", "sensor": sensor("radiancemeter")} | plane())
    for algorithm in ("ptracer", {"type": "pssmlt", "estimator": "ptracer"}):
        with pytest.raises(mlt.UsageError, match="use path, bdpt or mlt"):
            mlt.render(scene, algorithm, spp=1)
    ball = {"type": "sphere", "bsdf": {"type": "diffuse", "reflectance": ALBEDO}}
    seen = sensor("distant", direction=[0, 0, 1])
    sun = {"type": "directional", "direction": [0, 0, 1], "irradiance": SUN}
    found = measured(seen, "ptracer", 16384, ball=ball, sun=sun)
    assert found == pytest.approx([ALBEDO * SUN / math.pi * 2 / 9] * 3, rel=0.03)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (sensor("radiancemeter", size=2), "its film needs the width and height 1"),
        (sensor("distant", size=2), "its film needs the width and height 1"),
        (sensor("distant", rfilter="gaussian"), "its film needs the filter 'box'"),
        (sensor("radiancemeter", origin=[0, 0, 0]), "'direction' is needed too"),
        (sensor("radiancemeter", origin=[0, 0, 0], direction=[0, 0, 0]), "has no length"),
        (sensor("distant", direction=[0, 0, 1], to_world=mlt.Transform()), "exclude each other"),
    ],
)
def test_what_cannot_be_measured_is_refused(given, said):
    with pytest.raises(mlt.SceneError, match=said):
        mlt.load_dict({"type": "scene", "sensor": given, "light": {"type": "constant"}})
