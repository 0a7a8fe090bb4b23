"""Light that goes straight through surfaces: windows, leaves and what is not there."""

import numpy as np
import pytest
import tiny

import pymlt as mlt

FIND_LIGHTS_BY_CONNECTIONS = ["path", "direct", "bdpt", "ptracer"]


def lit_through(*panes: dict, **sensor) -> mlt.Scene:
    """A floor under a point light, with surfaces between them."""
    scene = tiny.scene()
    del scene["ball"]
    scene["sensor"] |= sensor
    scene["lamp"] = {"type": "point", "position": [0, 3, 0], "intensity": 10.0}
    for i, bsdf in enumerate(panes):
        placed = mlt.Transform().translate(0, 2 + 0.3 * i, 0).rotate([1, 0, 0], 90).scale(9)
        scene[f"pane{i}"] = {"type": "rectangle", "to_world": placed, "bsdf": bsdf}
    return mlt.load_dict(scene)


def render(scene, integrator, spp=16):
    depth = {} if integrator == "direct" else {"max_depth": 2}
    return mlt.render(scene, {"type": integrator} | depth, spp=spp, seed=1)


def leaf(opacity) -> dict:
    return {
        "type": "mask",
        "opacity": opacity,
        "bsdf": {"type": "diffuse", "reflectance": 0.0},
    }


@pytest.mark.parametrize("integrator", FIND_LIGHTS_BY_CONNECTIONS)
def test_connections_go_through_as_much_as_passes(integrator):
    images = [
        render(lit_through(*panes), integrator, 4096 if integrator == "ptracer" else 64).mean(
            (0, 1)
        )
        for panes in (
            [],
            [{"type": "null"}, {"type": "null"}],
            [leaf(0.25), leaf(0.5)],
            [leaf({"type": "rgb", "value": [0.2, 0.5, 0.8]})],
        )
    ]
    free, invisible, leaves, coloured = images
    np.testing.assert_allclose(invisible / free, 1, rtol=0.02)
    np.testing.assert_allclose(leaves / free, 0.75 * 0.5, rtol=0.02)
    np.testing.assert_allclose(coloured / free, [0.8, 0.5, 0.2], rtol=0.02)


def test_a_pane_passes_what_it_does_not_reflect():
    """Below the lamp, at normal incidence: 1 - R = (1 - F) / (1 + F) for the whole pane."""
    pane = {"type": "thindielectric", "int_ior": 1.5, "ext_ior": 1.0}
    reflectance = ((1.5 - 1) / (1.5 + 1)) ** 2
    down = mlt.Transform().look_at(origin=[0, 1.5, 0], target=[0, 0, 0], up=[0, 0, 1])
    scenes = [lit_through(*panes, to_world=down, fov=1.0) for panes in ([], [pane])]
    free, through = (render(scene, "path").mean() for scene in scenes)
    assert through / free == pytest.approx((1 - reflectance) / (1 + reflectance), rel=1e-3)


def test_a_surface_that_is_passed_is_no_vertex():
    """In front of the camera: neither in the depth of paths nor in the layers."""
    scene = tiny.scene()
    plain = mlt.load_dict(scene)
    scene["veil"] = {
        "type": "sphere",
        "center": [0, 1, 4],
        "radius": 0.5,
        "bsdf": {"type": "null"},
    }
    veiled = mlt.load_dict(scene)
    for integrator in "path", "bdpt", "mlt":
        images = [render(s, integrator, spp=256) for s in (plain, veiled)]
        assert images[1].mean() == pytest.approx(images[0].mean(), rel=0.05), integrator
    depths = [
        mlt.start(s, "path", spp=1, aovs="depth").result().layers["depth"] for s in (plain, veiled)
    ]
    np.testing.assert_allclose(depths[0], depths[1], atol=0.01)


def test_a_glowing_surface_may_be_passed():
    """An invisible lamp before a wall: what is behind it is seen through it."""
    scene = tiny.scene()
    del scene["ball"]
    scene["veil"] = {
        "type": "sphere",
        "center": [0, 0.6, 0],
        "radius": 0.5,
        "bsdf": {"type": "null"},
        "emitter": {"type": "area", "radiance": {"type": "rgb", "value": [1.0, 0.0, 0.0]}},
    }
    lit = mlt.load_dict(scene)
    means = [render(lit, i, spp=1024).mean((0, 1)) for i in ("path", "bdpt", "mlt")]
    for mean in means[1:]:
        np.testing.assert_allclose(mean, means[0], rtol=0.03)
    del scene["veil"]
    plain = render(mlt.load_dict(scene), "path", spp=1024)
    np.testing.assert_allclose(means[0][1], plain[..., 1].mean(), rtol=0.01)


def test_leaves_of_instances_let_light_through():
    """The same leaf in the scene and in an instance, as a mesh and as a disk."""
    for kind in "rectangle", "disk":
        means = []
        for instanced in False, True:
            scene = tiny.scene()
            del scene["ball"]
            scene["lamp"] = {"type": "point", "position": [0, 3, 0], "intensity": 10.0}
            placed = mlt.Transform().translate(0, 2, 0).rotate([1, 0, 0], 90)
            leaves = {"type": kind, "to_world": placed, "bsdf": leaf(0.4)}
            if instanced:
                scene["leaves"] = {"type": "shapegroup", "leaf": leaves}
                scene["tree"] = {"type": "instance", "group": {"type": "ref", "id": "leaves"}}
            else:
                scene["leaf"] = leaves
            loaded = mlt.load_dict(scene)
            means += [render(loaded, i, spp=1024).mean() for i in ("path", "bdpt")]
        np.testing.assert_allclose(means, means[0], rtol=0.01)
