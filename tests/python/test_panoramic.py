"""Cameras whose image is no plane: `spherical`, all around, and `fisheye`, in a circle."""

import numpy as np
import pytest

import pymlt as mlt

EXACT = ["path", "direct"]  #: for light that is the same everywhere
ALGORITHMS = [*EXACT, "bdpt", "mlt", "mmlt", "pssmlt"]
LIGHT = {"type": "constant"}


def sensor(kind, width=16, height=8, rfilter="box", **given):
    film = {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": rfilter}}
    return {"type": kind, "film": film} | given


def scene(camera, **parts):
    return mlt.load_dict({"type": "scene", "sensor": camera} | parts)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
@pytest.mark.parametrize("rfilter", ["box", "gaussian"])
def test_an_even_light_is_even_up_to_the_edges(algorithm, rfilter):
    image = mlt.render(scene(sensor("spherical", rfilter=rfilter), light=LIGHT), algorithm, spp=256)
    exact = rfilter == "box" and algorithm in EXACT
    assert np.abs(image - 1).max() < (1e-5 if exact else 0.3)
    assert image.mean() == pytest.approx(1, abs=0.01)


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_a_fisheye_is_black_outside_of_its_circle(algorithm):
    camera = sensor("fisheye", 40, 20, fov=360)
    image = mlt.render(scene(camera, light=LIGHT), algorithm, spp=64)[..., 1]
    y, x = np.mgrid[:20, :40] + 0.5
    distance = np.hypot(x - 20, y - 10)
    assert (image[distance > 10.8] == 0).all()
    inside = image[distance < 9.2]
    if algorithm in EXACT:
        assert np.abs(inside - 1).max() < 1e-5
    assert inside.mean() == pytest.approx(1, abs=0.02)


@pytest.mark.parametrize("turned", [0, 70])
def test_a_spherical_image_is_an_environment_map(turned):
    """The map's pixels are seen where they are, however it and the camera are turned together."""
    rng = np.random.default_rng(1)
    blocks = rng.uniform(0.2, 1, (4, 8, 3)).astype(np.float32)
    picture = blocks.repeat(16, 0).repeat(16, 1)
    to_world = mlt.Transform.rotate([1, 2, 3], turned)
    light = {"type": "envmap", "bitmap": picture, "to_world": to_world}
    camera = sensor("spherical", 128, 64, to_world=to_world)
    image = mlt.render(scene(camera, light=light), "path", spp=16)
    for y in range(8, 64, 16):
        for x in range(8, 128, 16):
            assert image[y, x] == pytest.approx(blocks[y // 16, x // 16], rel=1e-4)


def test_a_lamp_is_seen_by_its_direction_alone():
    """Also behind a fisheye of 360 degrees, where its image is a ring."""
    lamp = {"type": "sphere", "radius": 0.1, "emitter": {"type": "area", "radiance": 4.0}}

    def brightest(kind, center, **given):
        camera = sensor(kind, 64, 32, **given)
        image = mlt.render(scene(camera, lamp=lamp | {"center": center}), "path", spp=16)
        return tuple(int(i) for i in np.unravel_index(image[..., 1].argmax(), image.shape[:2]))

    right, up = [-1, 0.02, 0.02], [0.02, 1, 0.02]
    assert brightest("spherical", right)[1] in (47, 48)
    assert brightest("fisheye", right, fov=360)[1] in (39, 40)
    assert brightest("spherical", up)[0] in (0, 1)
    assert brightest("fisheye", up, fov=360)[0] in (7, 8)


def test_clipping_planes_are_refused_by_name():
    for kind in ("spherical", "fisheye"):
        with pytest.raises(mlt.SceneError, match="near_clip"):
            scene(sensor(kind, near_clip=0.1), light=LIGHT)
