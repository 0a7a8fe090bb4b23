"""What a render says about lights that it cannot find, or cannot tell apart."""

import re

import numpy as np
import pytest
import tiny

import pymlt as mlt


def lit_by_a_point(bsdf: dict) -> mlt.Scene:
    """A point light inside the ball."""
    scene = tiny.scene()
    scene["ball"]["bsdf"] = bsdf
    scene["lamp"] = {"type": "point", "position": [0, 0.6, 0], "intensity": 10.0}
    return mlt.load_dict(scene)


@pytest.mark.parametrize("integrator", ["path", "direct", "pssmlt"])
def test_a_point_light_in_glass_is_a_warning_where_it_cannot_be_found(integrator):
    glass = mlt.start(lit_by_a_point({"type": "dielectric"}), integrator, spp=1).result()
    assert any("cannot find the light of emitter 'point'" in w for w in glass.stats["warnings"])
    assert glass.image.max() == 0
    for other in {"type": "null"}, {"type": "roughdielectric", "alpha": 0.3}:
        result = mlt.start(lit_by_a_point(other), integrator, spp=1).result()
        assert not any("cannot find" in w for w in result.stats["warnings"])
        assert result.image.max() > 0


@pytest.mark.parametrize("integrator", ["bdpt", "mlt", mlt.PSSMLT(estimator="bdpt")])
def test_it_is_none_where_it_is_found(integrator):
    result = mlt.start(lit_by_a_point({"type": "dielectric"}), integrator, spp=16).result()
    assert not any("cannot find" in warning for warning in result.stats["warnings"])
    assert result.image.max() > 0


def test_light_that_a_pane_mirrors_is_a_warning_although_the_lamp_lights_much_else():
    scene = tiny.scene()
    scene["lamp"] = {"type": "point", "position": [0, 2, 1], "intensity": 10.0}
    scene["ball"] = {
        "type": "rectangle",
        "to_world": mlt.Transform().translate(0, 1.5, 0).scale(2),
        "bsdf": {"type": "thindielectric"},
    }
    result = mlt.start(mlt.load_dict(scene), "path", spp=1).result()
    (warning,) = [w for w in result.stats["warnings"] if "cannot find" in w]
    share = float(re.search(r"about (\S+) % of all light", warning)[1])
    assert 2 < share < 10  # 4 % of a fifth or more at normal incidence, and more aslant
    scene["ball"]["to_world"] = mlt.Transform().translate(0, 1.5, 0).scale(0.01)
    result = mlt.start(mlt.load_dict(scene), "path", spp=1).result()
    assert not any("cannot find" in w for w in result.stats["warnings"])


def shifted(scene: dict, *shift) -> list[str]:
    scene["other"]["to_world"] = mlt.Transform().translate(*shift) @ scene["lamp"]["to_world"]
    return mlt.load_dict(scene).warnings


def test_two_lights_in_one_place_are_a_warning():
    scene = tiny.scene()
    assert mlt.load_dict(scene).warnings == []
    scene["other"] = dict(scene["lamp"])
    for shift in (0, 0, 0), (0.003, 0, 0), (0.5, 0, 0.5), (-1.5, 0, 0):
        (warning,) = shifted(scene, *shift)
        assert "lies in the same place as" in warning
    for shift in (0, 0.01, 0), (2.1, 0, 0):
        assert shifted(scene, *shift) == []


def test_a_light_in_the_plane_of_the_ceiling_is_a_warning():
    scene = tiny.scene()
    place = mlt.Transform().translate(0, 3, 0).rotate([1, 0.2, 0], 70)  # where rounding decides
    scene["lamp"]["to_world"] = place
    scene["ceiling"] = {"type": "rectangle", "to_world": place @ mlt.Transform().scale(2)}
    (warning,) = mlt.load_dict(scene).warnings
    assert "lies in the same place as" in warning
    scene["ceiling"]["to_world"] = place @ mlt.Transform().translate(0, 0, -0.01).scale(2)
    assert mlt.load_dict(scene).warnings == []


# ---- pictures without light ----------------------------------------------------------------------


def last_warning(scene: dict, integrator="path") -> str:
    result = mlt.start(mlt.load_dict(scene), integrator, spp=1).result()
    return result.stats["warnings"][-1]


def view(*origin) -> mlt.Transform:
    return mlt.Transform.look_at(origin=list(origin), target=[0, 0.5, 0], up=[0, 1, 0])


@pytest.mark.parametrize("integrator", ["path", "bdpt", "ptracer", "mlt", "mmlt", "pssmlt"])
def test_a_lamp_in_a_closed_box_says_that_no_light_was_found(integrator):
    scene = tiny.scene()
    scene["box"] = {
        "type": "cube",
        "to_world": mlt.Transform().translate(0, 3, 0).scale(1.5),
        "bsdf": {"type": "twosided", "b": {"type": "diffuse"}},
    }
    assert "no light was found" in last_warning(scene, integrator)


def test_a_lens_inside_a_shape_is_named():
    scene = tiny.scene()
    scene["stone"] = {"type": "sphere", "center": [0, 1, 4], "radius": 0.2}
    assert "the lens is inside the sphere 'stone'" in last_warning(scene)


def test_a_camera_that_looks_away_says_so():
    scene = tiny.scene()
    scene["sensor"]["to_world"] = mlt.Transform.look_at([0, 1, 4], [0, 2, 9], [0, 1, 0])
    assert "nothing is in view" in last_warning(scene)


def test_a_scene_without_shapes_says_so():
    scene = tiny.scene()
    kept = {name: scene[name] for name in ("type", "integrator", "sensor")}
    assert "has no shapes" in last_warning(kept | {"bulb": {"type": "point"}})


def test_a_lit_picture_says_nothing():
    result = mlt.start(mlt.load_dict(tiny.scene()), "path", spp=4).result()
    assert not any("have any light" in w for w in result.stats["warnings"])


# ---- ellipsoids ----------------------------------------------------------------------------------


def ellipsoid(emits: bool, **extra) -> dict:
    scene = tiny.scene()
    scene["ball"] |= {"center": [0, 0, 0], "radius": 1.0, "bsdf": {"type": "ref", "id": "clay"}}
    scene["ball"]["to_world"] = mlt.Transform().translate(0, 0.5, 0).scale([0.8, 0.4, 0.3])
    if emits:
        light = {"type": "area", "radiance": {"type": "rgb", "value": [5.0, 5.0, 5.0]}}
        scene["ball"]["emitter"] = light
    scene["ball"] |= extra
    return scene


def test_a_sphere_may_be_scaled_unevenly():
    scene = ellipsoid(False)
    still = mlt.load_dict(scene)
    group = {"type": "shapegroup", "ball": scene["ball"] | {"to_world": mlt.Transform()}}
    copy = {
        "type": "instance",
        "to_world": scene["ball"]["to_world"],
        "group": {"type": "ref", "id": "g"},
    }
    instance = mlt.load_dict({**scene, "g": group, "ball": copy})
    a, b = (mlt.render(s, "path", spp=16, seed=2) for s in (still, instance))
    assert np.allclose(a, b, rtol=1e-4, atol=1e-5)
    assert still.intersect([0, 0.5, 4], [0, 0, -1]).position == pytest.approx([0, 0.5, 0.3])


def test_its_methods_agree():
    scene = mlt.load_dict(ellipsoid(True), size=(8, 6))
    means = [
        [mlt.render(scene, name, spp=256, seed=seed).mean() for seed in range(16)]
        for name in ("path", "bdpt")
    ]
    a, b = np.array(means)
    error = np.hypot(a.std(ddof=1), b.std(ddof=1)) / 4
    assert abs(a.mean() - b.mean()) < 4 * error
    assert error < 0.01 * a.mean()
