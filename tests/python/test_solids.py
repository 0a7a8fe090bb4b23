"""Solids that overlap: the same images as of surfaces that end where others begin."""

import numpy as np
import pytest

import pymlt as mlt
from pymlt.formats.solids import give_priorities

GLASS = ((-0.55, -1.0, -0.4), (-0.1, 0.1, 0.4))
WATER = ((-0.35, -0.8, -0.3), (0.5, -0.1, 0.3))


def quad(axis, at, low, high):
    """A rectangle whose normal is along the axis; low and high are of the two axes after it."""
    u, v = (axis + 1) % 3, (axis + 2) % 3
    corners = np.zeros((4, 3))
    corners[:, axis] = at
    corners[:, u] = [low[0], high[0], high[0], low[0]]
    corners[:, v] = [low[1], low[1], high[1], high[1]]
    return corners


def mesh(quads):
    """A mesh of (corners, sign of the normal)."""
    vertices = np.concatenate([corners if sign > 0 else corners[::-1] for corners, sign in quads])
    first = 4 * np.arange(len(quads))[:, None]
    faces = np.concatenate([first + np.array(corners) for corners in ((0, 1, 2), (0, 2, 3))])
    return {"type": "mesh", "vertices": vertices, "faces": faces, "face_normals": True}


def box(low, high, but=()):
    """The six sides of a box, without those of (axis, sign) in `but`."""
    sides = []
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for sign, at in ((-1, low[axis]), (1, high[axis])):
            if (axis, sign) not in but:
                sides.append((quad(axis, at, (low[u], low[v]), (high[u], high[v])), sign))
    return sides


def glass(inside, outside=1.0):
    return {"type": "dielectric", "int_ior": inside, "ext_ior": outside}


def room(solids):
    return {
        "type": "scene",
        "camera": {
            "type": "perspective",
            "fov": 40,
            "to_world": mlt.Transform().look_at([0.6, 0.7, 3.2], [0, -0.5, 0], [0, 1, 0]).matrix,
            "film": {"type": "hdrfilm", "width": 16, "height": 16, "filter": {"type": "box"}},
        },
        "floor": {
            "type": "rectangle",
            "to_world": mlt.Transform()
            .translate(0, -1.01, 0)
            .rotate([1, 0, 0], -90)
            .scale(4)
            .matrix,
            "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.7, 0.5, 0.3]}},
        },
        "sky": {"type": "constant", "radiance": 0.5},
        "lamp": {
            "type": "sphere",
            "center": [2, 2.5, 1],
            "radius": 0.6,
            "emitter": {"type": "area", "radiance": 6.0},
        },
        **solids,
    }


def overlapping(water=WATER):
    return room(
        {
            "glass": mesh(box(*GLASS)) | {"priority": 2, "bsdf": glass(1.5)},
            "water": mesh(box(*water)) | {"priority": 1, "bsdf": glass(1.33)},
        }
    )


def exact():
    """The wall of the glass towards the water is cut along the water's outline."""
    x, (y0, y1), (z0, z1) = GLASS[1][0], (WATER[0][1], WATER[1][1]), (WATER[0][2], WATER[1][2])
    (gy0, gz0), (gy1, gz1) = GLASS[0][1:], GLASS[1][1:]
    frame = [
        quad(0, x, (gy0, gz0), (y0, gz1)),
        quad(0, x, (y1, gz0), (gy1, gz1)),
        quad(0, x, (y0, gz0), (y1, z0)),
        quad(0, x, (y0, z1), (y1, gz1)),
    ]
    outer = box(*GLASS, but=[(0, 1)]) + [(corners, 1) for corners in frame]
    water = box((x, *WATER[0][1:]), WATER[1], but=[(0, -1)])
    between = [(quad(0, x, (y0, z0), (y1, z1)), 1)]
    return room(
        {
            "glass": mesh(outer) | {"bsdf": glass(1.5)},
            "water": mesh(water) | {"bsdf": glass(1.33)},
            "between": mesh(between) | {"bsdf": glass(1.5, 1.33)},
        }
    )


def images(scene, integrator, seeds, spp):
    return np.stack([mlt.render(scene, integrator, spp=spp, seed=s) for s in seeds])


def blocks(images):
    """The means over all channels of blocks of 4 x 4 pixels."""
    return images.mean(3).reshape(-1, 4, 4, 4, 4).mean((2, 4))


@pytest.mark.parametrize("integrator", ["path", "bdpt", "mlt"])
def test_overlapping_solids_look_as_exact_interfaces_do(integrator):
    seeds = range(8)
    a, b = (
        blocks(images(scene, {"type": integrator, "max_depth": 12}, seeds, 200))
        for scene in (overlapping(), exact())
    )
    spread = np.sqrt((a.var(0, ddof=1) + b.var(0, ddof=1)) / len(seeds))
    t = np.abs(a.mean(0) - b.mean(0)) / np.maximum(spread, 1e-6)  # some see the sky alone
    assert t.max() < 6  # of 16 blocks; t with 14 degrees of freedom: p < 4e-5 for each
    assert np.abs(a.mean() / b.mean() - 1) < 0.02


def up_to(height):
    """The water, up to this height, before the glass: where both are hit, it may be met first."""
    scene = overlapping((WATER[0], (WATER[1][0], height, WATER[1][2])))
    return {"type": "scene", "water": scene.pop("water")} | scene


def test_of_faces_in_one_plane_one_is_there():
    top = GLASS[1][1]
    flush, lower = (blocks(images(up_to(y), "path", [1], 1024)) for y in (top, top - 1e-4))
    assert np.abs(flush / lower - 1).max() < 0.02


def test_solids_that_touch_look_as_those_that_overlap():
    touching = (GLASS[1][0], *WATER[0][1:]), WATER[1]
    a, b = (blocks(images(overlapping(w), "path", [1], 1024)) for w in (touching, WATER))
    assert np.abs(a / b - 1).max() < 0.02


def test_without_priorities_the_same_shapes_look_otherwise():
    wrong = overlapping()
    for name in ("glass", "water"):
        wrong[name] = {key: value for key, value in wrong[name].items() if key != "priority"}
    a, b = (blocks(images(s, "path", [1], 1024)) for s in (wrong, exact()))
    assert np.abs(a / b - 1).max() > 0.04


def test_of_equal_priorities_the_smaller_solid_wins():
    equal = overlapping()
    for name in ("glass", "water"):
        equal[name] = equal[name] | {"priority": 0}
    small = overlapping()
    volume = {name: np.prod(np.subtract(*box[::-1])) for name, box in (("g", GLASS), ("w", WATER))}
    assert volume["g"] > volume["w"]
    small["glass"], small["water"] = (
        small["glass"] | {"priority": 1},
        small["water"] | {"priority": 2},
    )
    a, b = (np.asarray(mlt.render(s, "path", spp=16, seed=3)) for s in (equal, small))
    assert np.array_equal(a, b)


def test_shapes_of_a_group_have_no_priority():
    scene = room({"group": {"type": "shapegroup", "ball": {"type": "sphere", "priority": 1}}})
    scene["copy"] = {"type": "instance", "group": {"type": "ref", "id": "group"}}
    with pytest.raises(mlt.SceneError, match="shapegroup, cannot have a priority"):
        mlt.load_dict(scene)


def test_what_is_not_closed_has_no_priority():
    scene = overlapping()
    scene["water"] = mesh(box(*WATER, but=[(1, 1)])) | {"priority": 1, "bsdf": glass(1.33)}
    with pytest.raises(mlt.SceneError, match="has a priority, but no inside"):
        mlt.load_dict(scene)


def test_open_surfaces_of_glass_are_no_solids():
    scene = overlapping()
    scene["pane"] = {"type": "disk", "bsdf": glass(1.2)}
    scene["pane"]["to_world"] = mlt.Transform().translate(0, 0, 0.35).scale(2).matrix
    assert np.isfinite(mlt.render(scene, "path", spp=4)).all()


def glass_cube(**more):
    return mesh(box((0, 0, 0), (1, 1, 1))) | {"bsdf": glass(1.5)} | more


def test_closed_solids_of_other_programs_have_priorities():
    open_box = mesh(box((0, 0, 0), (1, 1, 1), but=[(2, 1)])) | {"bsdf": {"type": "ref", "id": "m"}}
    scene = {
        "type": "scene",
        "m": glass(1.3),
        "cube": glass_cube(),
        "ball": {"type": "sphere", "bsdf": {"type": "openpbr", "transmission_weight": 1.0}},
        "bubble": {
            "type": "sphere",
            "bsdf": {"type": "openpbr", "transmission_weight": 1.0, "geometry_thin_walled": True},
        },
        "wall": {"type": "sphere", "bsdf": {"type": "diffuse"}},
        "open": open_box,
        "filled": glass_cube(interior={"type": "homogeneous"}),
        "moving": glass_cube(to_world={"type": "animation", "0": np.eye(4), "1": np.eye(4)}),
        "exact": glass_cube(exterior={"type": "homogeneous"}),
    }
    give_priorities(scene)
    assert [name for name, part in scene.items() if "priority" in part] == [
        "cube",
        "ball",
        "filled",
    ]


def test_a_single_solid_has_no_priority():
    scene = {"type": "scene", "cube": glass_cube()}
    give_priorities(scene)
    assert "priority" not in scene["cube"]
