"""Many rays at once agree with single rays and with the layers of a render."""

import numpy as np
import pytest
import tiny

import pymlt as mlt


@pytest.fixture(scope="module")
def scene():
    return mlt.load_dict(tiny.scene())


def pixel_middles(scene) -> np.ndarray:
    y, x = np.mgrid[0 : scene.height, 0 : scene.width] + 0.5
    return np.stack([x.ravel(), y.ravel()], 1)


def test_many_rays_are_what_single_rays_are(scene):
    starts, directions = scene.camera_rays(pixel_middles(scene))
    found = scene.intersect(starts, directions)
    assert set(found) == {
        *("distance", "position", "geo_normal", "sh_normal", "uv", "shape_index", "prim_index")
    }
    hits = 0
    for i, (start, direction) in enumerate(zip(starts, directions, strict=True)):
        vertex = scene.intersect(start, direction)
        if vertex is None:
            assert found["distance"][i] == np.inf
            assert found["shape_index"][i] == found["prim_index"][i] == -1
            assert np.isnan(found["position"][i]).all()
            continue
        hits += 1
        np.testing.assert_array_equal(found["position"][i], vertex.position)
        np.testing.assert_array_equal(found["geo_normal"][i], vertex.normal)
        np.testing.assert_array_equal(found["sh_normal"][i], vertex.shading_normal)
        np.testing.assert_allclose(
            found["distance"][i], np.linalg.norm(vertex.position - start), rtol=1e-12
        )
    assert 0 < hits < len(starts)


def test_indices_are_those_of_the_layers(scene):
    found = scene.intersect(*scene.camera_rays(pixel_middles(scene)))
    layers = mlt.start(scene, "path", spp=1, aovs=["shape_index", "prim_index"]).result().layers
    for name in ("shape_index", "prim_index"):
        np.testing.assert_array_equal(layers[name].ravel(), found[name])


def test_lengths_of_directions_do_not_matter(scene):
    starts, directions = scene.camera_rays(pixel_middles(scene))
    one, two = scene.intersect(starts, directions), scene.intersect(starts, 2 * directions)
    np.testing.assert_array_equal(one["shape_index"], two["shape_index"])


def test_no_rays_are_no_hits(scene):
    assert scene.intersect(np.zeros((0, 3)), np.zeros((0, 3)))["position"].shape == (0, 3)


@pytest.mark.parametrize(
    ("starts", "directions", "message"),
    [
        (np.zeros((2, 2)), np.ones((2, 3)), r"start should be an array of the shape \(n, 3\)"),
        (np.zeros((2, 3)), np.ones((3, 3)), "there are 2 starts, but 3 directions"),
        (np.zeros((2, 3)), np.zeros((2, 3)), "direction 0 has no length"),
        (np.full((1, 3), np.nan), np.ones((1, 3)), "ray 0 is not finite"),
    ],
)
def test_mistakes_are_named(scene, starts, directions, message):
    with pytest.raises(mlt.UsageError, match=message):
        scene.intersect(starts, directions)
