"""`irradiancemeter`, a sensor that is nested in a shape and has the irradiance on its surface."""

import math

import numpy as np
import pytest

import pymlt as mlt

ALGORITHMS = ["path", "direct", "bdpt", "ptracer", "pssmlt", "mmlt", "rjmlt", "mlt"]
ALBEDO, SUN = 0.6, 2.5
FILM = {"type": "hdrfilm", "width": 1, "height": 1, "rfilter": {"type": "box"}}
METER = {"type": "irradiancemeter", "film": FILM}
UP = mlt.Transform.rotate([1, 0, 0], -90)  # turns +z to +y
BLACK = {"type": "diffuse", "reflectance": 0.0}


def plate(side=1.0, turn=UP, meter=METER, **given):
    """A square of this half side around the origin that faces up, with a meter."""
    shape = {"type": "rectangle", "to_world": turn.scale(side), "bsdf": BLACK, "meter": meter}
    return shape | given


def measured(algorithm="path", spp=1024, **parts):
    return mlt.render(mlt.load_dict({"type": "scene"} | parts), algorithm, spp=spp)[0, 0]


def even(radiance):
    return {"type": "constant", "radiance": radiance}


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_below_an_even_light_it_is_pi_times_the_radiance(algorithm):
    light = even({"type": "rgb", "value": [3, 2, 1]})
    found = measured(algorithm, plate=plate(), light=light)
    assert found == pytest.approx([3 * math.pi, 2 * math.pi, math.pi], rel=0.02)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_below_a_lamp_it_falls_with_the_cosine_and_the_distance(algorithm):
    """A sphere lights a point as all its light in its middle would."""
    radius, place = 2.5, np.array([2, 3, 1])
    emitter = {"type": "area", "radiance": {"type": "rgb", "value": [3, 2, 1]}}
    lamp = {"type": "sphere", "center": place, "radius": radius, "emitter": emitter}
    found = measured(algorithm, 16384, plate=plate(0.001), lamp=lamp)
    distance = math.hypot(*place)
    expected = math.pi * radius**2 / distance**2 * (place[1] / distance)
    # of 8 seeds; of path for the others
    deviation = {"pssmlt": 0.051, "mmlt": 0.0075, "rjmlt": 0.0075}.get(algorithm, 0.001)
    assert found / [3, 2, 1] == pytest.approx([expected] * 3, rel=4 * deviation)


@pytest.mark.parametrize("algorithm", ["path", "bdpt", "mlt"])
def test_light_of_a_lamp_without_size_is_scattered_to_it(algorithm):
    """Below, a wide plane in the sun: seen from the meter it fills the hemisphere."""
    grey = {"type": "diffuse", "reflectance": ALBEDO}
    plane = {"type": "rectangle", "to_world": UP.scale(50), "bsdf": grey}
    sun = {"type": "directional", "direction": [1, -1, 0], "irradiance": SUN}
    turn = mlt.Transform.translate([0, 0.5, 0]).rotate([1, 0, 0], 90)
    found = measured(algorithm, 16384, plate=plate(0.01, turn), plane=plane, sun=sun)
    assert found == pytest.approx([ALBEDO * SUN * math.sqrt(0.5)] * 3, rel=0.03)


SHAPES = {
    "sphere": {"type": "sphere", "radius": 2.0},
    "cylinder": {"type": "cylinder", "p1": [0, 0, 3]},
    "cube": {"type": "cube"},
}


@pytest.mark.parametrize("shape", SHAPES)
def test_it_is_the_mean_over_the_surface(shape):
    whole = measured(body=SHAPES[shape] | {"bsdf": BLACK, "meter": METER}, light=even(0.7))
    assert whole == pytest.approx([0.7 * math.pi] * 3)
    if shape != "cylinder":  # which is open at its ends
        flipped = SHAPES[shape] | {"bsdf": BLACK, "meter": METER, "flip_normals": True}
        assert (measured(body=flipped, light=even(0.7)) == 0).all()


def test_on_a_sphere_in_the_sun_it_is_a_quarter():
    sun = {"type": "directional", "direction": [0, -1, 0], "irradiance": SUN}
    ball = {"type": "sphere", "radius": 2.0, "bsdf": BLACK, "meter": METER}
    for algorithm in ("bdpt", "ptracer", "mlt"):
        assert measured(algorithm, 16384, ball=ball, sun=sun) == pytest.approx(
            [SUN / 4] * 3, rel=0.03
        )


def test_walks_from_it_do_not_find_a_lamp_of_no_size_and_say_so():
    lamp = {"type": "point", "position": [0, 2, 0], "intensity": 4.0}
    scene = mlt.load_dict({"type": "scene", "plate": plate(0.001), "lamp": lamp})
    for algorithm in ("path", "direct", "pssmlt"):
        result = mlt.start(scene, algorithm, spp=4).result()
        assert any("falls straight on the sensor's shape" in w for w in result.stats["warnings"])
    for algorithm in ("bdpt", "ptracer", "mmlt", "mlt"):
        found = mlt.render(scene, algorithm, spp=1024)[0, 0]
        assert found == pytest.approx([1] * 3, rel=1e-3)
    with pytest.raises(mlt.UsageError, match="leave direct_samples out"):
        mlt.render(scene, mlt.MLT(direct_samples=4), spp=1)


def test_in_a_fog_that_absorbs_it_is_weaker():
    fog = {"type": "homogeneous", "sigma_t": 0.5, "albedo": 0.0}
    meter = METER | {"medium": fog}
    lamp = {"type": "point", "position": [0, 2, 0], "intensity": 4.0, "medium": fog}
    found = measured("bdpt", plate=plate(0.001, meter=meter), lamp=lamp)
    assert found == pytest.approx([math.exp(-1)] * 3, rel=1e-3)


def test_it_is_read_from_xml_and_chosen_by_its_number():
    xml = """<scene version="3.0.0">
      <sensor type="perspective"><film type="hdrfilm">
        <integer name="width" value="2"/><integer name="height" value="3"/></film></sensor>
      <shape type="rectangle"><bsdf type="diffuse"/>
        <sensor type="irradiancemeter"><film type="hdrfilm">
          <integer name="width" value="1"/><integer name="height" value="1"/>
          <rfilter type="box"/></film></sensor></shape>
      <emitter type="constant"/></scene>"""
    assert mlt.render(mlt.load_string(xml), spp=1).shape[:2] == (3, 2)
    scene = mlt.load_string(xml, sensor=1)
    assert mlt.render(scene, "path", spp=4)[0, 0] == pytest.approx([math.pi] * 3)


def test_its_shape_may_shine_and_be_far_away():
    far = mlt.Transform.translate([1e7, 2e7, 0]) @ UP
    light = {"type": "area", "radiance": 5.0}
    assert measured(plate=plate(turn=far, light=light), sky=even(1.0)) == pytest.approx(
        [math.pi] * 3
    )


@pytest.mark.parametrize(
    ("parts", "said"),
    [
        ({"meter": METER}, "needs a shape; put it inside one"),
        ({"plate": plate(meter=METER | {"film": FILM | {"width": 2}})}, "the width and height 1"),
        ({"plate": plate(meter={"type": "perspective"})}, "put it directly into the scene"),
        (
            {"ball": {"type": "sphere", "to_world": mlt.Transform.scale([1, 2, 1]), "m": METER}},
            "stands still",
        ),
        (
            {
                "meter": METER | {"id": "m"},
                "a": plate(meter={"type": "ref", "id": "m"}),
                "b": plate(meter={"type": "ref", "id": "m"}),
            },
            "is in a second shape",
        ),
        ({"meter": {"type": "fluencemeter"}}, "irradiancemeter measures on a shape"),
    ],
)
def test_what_cannot_be_measured_is_refused(parts, said):
    with pytest.raises(mlt.SceneError, match=said):
        mlt.load_dict({"type": "scene", "light": even(1.0)} | parts)
