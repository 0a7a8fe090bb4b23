"""What a render says about lights that it cannot find, or cannot tell apart."""

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


def test_two_lights_in_one_place_are_a_warning():
    scene = tiny.scene()
    assert mlt.load_dict(scene).warnings == []
    scene["other"] = dict(scene["lamp"])
    (warning,) = mlt.load_dict(scene).warnings
    assert "lies in the same place as another one" in warning
    scene["other"]["to_world"] = mlt.Transform().translate(0, 0.01, 0) @ scene["lamp"]["to_world"]
    assert mlt.load_dict(scene).warnings == []


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
