"""Scenes far from the origin, such as those in survey coordinates, render as at the origin; what is
too small or too large to be right is refused."""

import numpy as np
import pytest

import pymlt as mlt

T = mlt.Transform
FAR = np.array([5e5, 30.0, 5e6])


def at(offset, *p) -> list[float]:
    return np.add(offset, p).tolist()


def grey(value):
    return {"type": "rgb", "value": [value] * 3}


def film(width: int, height: int) -> dict:
    return {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"}}


def obj(offset) -> bytes:
    """A tetrahedron at this place."""
    corners = np.array([[0, 0, 0], [0.8, 0, 0], [0, 0.8, 0], [0, 0, 0.8]]) + offset
    faces = [(1, 3, 2), (1, 2, 4), (2, 3, 4), (3, 1, 4)]
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in corners]
    return "\n".join(lines + [f"f {a} {b} {c}" for a, b, c in faces]).encode()


def room(offset, group_offset=(0, 0, 0)) -> dict:
    """One of every kind of thing that has a place."""

    def to(*p):
        return at(offset, *p)

    fog = np.full((2, 2, 2), 0.5)
    fog[0] = 2
    smoke = {
        "type": "heterogeneous",
        "sigma_t": {"type": "gridvolume", "data": fog,
                    "to_world": T().translate(to(-2, 0, -2)).scale(2)},
        "albedo": 0.8,
    }  # fmt: skip
    ball = {"type": "sphere", "center": at(group_offset, 0, 0.3, 0), "radius": 0.3}
    start = T().translate(to(1.5, 0, 1)).scale(0.25)
    end = T().translate(to(1.5, 0.4, 1)).rotate([0, 1, 0], 40).scale(0.25)
    return {
        "type": "scene",
        "sensor": {"type": "thinlens", "fov": 45, "aperture_radius": 0.05, "focus_distance": 5.0,
                   "to_world": T.look_at(to(0, 2, 5), to(0, 0.5, 0), (0, 1, 0)),
                   "shutter_close": 1.0, "film": film(24, 18)},
        "floor": {"type": "rectangle",
                  "to_world": T().translate(to(0, 0, 0)).scale(3).rotate([1, 0, 0], -90),
                  "bsdf": {"type": "diffuse", "reflectance": grey(0.8)}},
        "glass": {"type": "sphere", "center": to(0, 0.8, 0), "radius": 0.7,
                  "bsdf": {"type": "dielectric"}},
        "mesh": {"type": "obj", "data": obj(to(-1.7, 0, 1))},
        "rod": {"type": "cylinder", "p0": to(1, 0, -1), "p1": to(1.6, 1, -1), "radius": 0.2},
        "group": {"type": "shapegroup", "ball": ball},
        "copy": {"type": "instance",
                 "to_world": T().translate(to(*np.subtract([1.8, 0, 0], group_offset))),
                 "group": {"type": "ref", "id": "group"}},
        "moving": {"type": "cube", "to_world": {"type": "animation", 0: start, 1: end}},
        "smoke": {"type": "cube", "to_world": T().translate(to(-1, 1, -1)).scale(0.9),
                  "bsdf": {"type": "null"}, "interior": smoke},
        "lamp": {"type": "rectangle",
                 "to_world": T().translate(to(0, 4, 0)).rotate([1, 0, 0], 90).scale(0.5),
                 "emitter": {"type": "area", "radiance": grey(10)}},
        "bulb": {"type": "point", "position": to(2, 2, 2), "intensity": grey(4)},
        "spot": {"type": "spot", "to_world": T.look_at(to(-2, 3, 2), to(-1, 0, 1), (0, 1, 0)),
                 "intensity": grey(20)},
    }  # fmt: skip


@pytest.mark.parametrize("integrator", ["path", "bdpt", "mlt"])
@pytest.mark.parametrize("group_offset", [(0, 0, 0), FAR])
def test_the_image_far_away_is_that_at_the_origin(integrator, group_offset):
    def image(offset, group):
        scene = mlt.load_dict(room(offset, group))
        return mlt.render(scene, integrator, spp=16, seed=3, threads=1)

    near, far = image((0, 0, 0), (0, 0, 0)), image(FAR, group_offset)
    if integrator == "mlt":  # a chain that goes another way once never comes back
        assert far.mean() == pytest.approx(near.mean(), rel=0.15)
        return
    # The same random numbers: but for rounding at edges the same paths.
    different = ~np.isclose(near, far, rtol=1e-2, atol=1e-4).all(axis=2)
    assert different.mean() < 0.1
    assert far.mean() == pytest.approx(near.mean(), rel=0.02)


def test_python_sees_the_coordinates_of_the_description():
    scene = mlt.load_dict(room(FAR))
    seen = scene.intersect(at(FAR, -0.5, 5, 2), [0, -1, 0])
    assert seen.position == pytest.approx(at(FAR, -0.5, 0, 2), abs=1e-5)
    again = scene.intersect(seen, [0.001, 1, 0])
    assert again is None or np.abs(again.position - FAR).max() < 5
    path = scene.sample_path(seed=1)
    assert (np.abs(path.vertices["position"] - FAR).max(axis=1) < 6).all()
    assert path[-1].position == pytest.approx(at(FAR, 0, 2, 5), abs=0.1)
    starts, directions = scene.camera_rays([[12.0, 9.0], [3.0, 4.0]])
    assert starts == pytest.approx(np.tile(at(FAR, 0, 2, 5), (2, 1)))
    found = scene.intersect(starts, directions)
    travelled = np.linalg.norm(found["position"] - starts, axis=1)
    assert travelled == pytest.approx(found["distance"], rel=1e-6)
    result = mlt.start(scene, "path", spp=1, aovs="position").result()
    positions = result.layers["position"][-1, 8:16]
    assert np.abs(positions - FAR).max() < 6
    assert np.subtract(scene.info()["center"], FAR) == pytest.approx([0, 2, 1], abs=2)


def test_an_edit_is_in_the_coordinates_of_the_description():
    scene = mlt.load_dict(room(FAR))
    parameters = mlt.traverse(scene)
    parameters["bulb.position"] = at(FAR, 0, 3, 0)
    edited = parameters.update()
    described = room(FAR)
    described["bulb"]["position"] = at(FAR, 0, 3, 0)
    images = [mlt.render(s, "path", spp=4) for s in (edited, mlt.load_dict(described))]
    assert (images[0] == images[1]).all()


def cube(size: float) -> dict:
    """A white box around a lamp, in another unit of length."""
    return {
        "type": "scene",
        "sensor": {"type": "perspective", "fov": 40,
                   "to_world": T.look_at([0, 0, 3.5 * size], [0, 0, 0], [0, 1, 0]),
                   "film": film(12, 9)},
        "floor": {"type": "rectangle",
                  "to_world": T().translate([0, -size, 0]).scale(size).rotate([1, 0, 0], -90)},
        "lamp": {"type": "sphere", "radius": size / 4,
                 "emitter": {"type": "area", "radiance": 5.0}},
    }  # fmt: skip


@pytest.mark.parametrize("integrator", ["path", "bdpt"])
def test_a_unit_of_length_that_cannot_be_right_is_refused(integrator):
    def mean(size):
        return mlt.render(mlt.load_dict(cube(size)), integrator, spp=64).mean()

    right = mean(1.0)
    for size in (1e-12, 1e-6, 1e6, 1e12):
        assert mean(size) == pytest.approx(right, rel=0.02)
    for size in (1e-15, 1e-14, 2e13, 1e14):
        with pytest.raises(mlt.SceneError, match="choose another unit of length"):
            mlt.load_dict(cube(size))
