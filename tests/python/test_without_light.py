"""Scenes without light: what surfaces are needs none."""

import numpy as np
import pytest

import pymlt as mlt

CAMERA = {
    "type": "perspective",
    "fov": 30,
    "to_world": mlt.Transform.look_at([0, 0, 4], [0, 0, 0], [0, 1, 0]),
    "film": {"type": "hdrfilm", "width": 9, "height": 9, "rfilter": {"type": "box"}},
}
BALL = {
    "type": "sphere",
    "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.2, 0.4, 0.6]}},
}
DARK = {"type": "scene", "camera": CAMERA, "ball": BALL}
NORMALS = {"type": "aov", "aovs": "nn:sh_normal,depth"}


@pytest.fixture
def dark():
    return mlt.load_dict(DARK)


def test_a_scene_without_light_is_black_and_warns(dark):
    assert "no emitter" in "".join(dark.warnings)
    assert mlt.render(dark, spp=1).max() == 0
    assert mlt.render(dark, "mlt", spp=1).max() == 0


def test_layers_are_rendered_beside_the_black_image(dark):
    job = mlt.start(dark, spp=1, aovs="albedo")
    job.wait()
    layer = job.result().layers["albedo"]
    np.testing.assert_allclose(layer[4, 4], [0.2, 0.4, 0.6], rtol=1e-6)
    assert layer[0, 0].max() == 0


@pytest.mark.parametrize("spectral", [False, True])
def test_depth_is_an_image(spectral):
    image = mlt.render(DARK, "depth", spp=64, spectral=spectral)
    np.testing.assert_allclose(image[4, 4], 3, rtol=1e-2)
    assert image[0, 0].max() == 0


@pytest.mark.parametrize("spectral", [False, True])
def test_aov_alone_shows_its_first_layer_and_has_them_all(spectral):
    """Normals have negative parts; the ball is seen from the front, so that its z is above 0."""
    job = mlt.start(DARK, NORMALS, spp=64, spectral=spectral)
    job.wait()
    normals, layers = job.image, job.result().layers
    assert {"nn", "depth"} <= set(layers)
    np.testing.assert_allclose(normals[4, 4], [0, 0, 1], atol=0.05)
    assert normals[4, 2, 0] < -0.3 < 0.3 < normals[4, 6, 0]
    assert normals[6, 4, 1] < -0.3 < 0.3 < normals[2, 4, 1]
    np.testing.assert_allclose(normals, layers["nn"], atol=0.2)


def test_aov_around_an_integrator_adds_its_layers_to_it():
    lit = DARK | {"sky": {"type": "constant"}}
    job = mlt.start(lit, NORMALS | {"inside": {"type": "path"}}, spp=16)
    job.wait()
    assert {"nn", "depth"} <= set(job.result().layers)
    np.testing.assert_allclose(job.image[4, 4], [0.2, 0.4, 0.6], rtol=0.05)


def test_a_file_whose_integrator_is_aov_needs_no_light(tmp_path):
    file = tmp_path / "dark.xml"
    file.write_text(
        """<scene version="3.0.0"><integrator type="aov">
        <string name="aovs" value="dd:depth"/></integrator>
        <sensor type="perspective"><float name="fov" value="30"/><transform name="to_world">
        <lookat origin="0,0,4" target="0,0,0" up="0,1,0"/></transform><film type="hdrfilm">
        <integer name="width" value="9"/><integer name="height" value="9"/></film></sensor>
        <shape type="sphere"/></scene>"""
    )
    scene = mlt.load_file(file)
    assert not scene.warnings
    job = mlt.start(scene, spp=16)
    job.wait()
    np.testing.assert_allclose(job.result().layers["dd"][4, 4], 3, rtol=2e-2)
    np.testing.assert_allclose(job.image[4, 4], 3, rtol=2e-2)


def test_a_layer_that_is_not_known_is_an_error():
    with pytest.raises(mlt.SceneError, match=r"aovs.*not a layer"):
        mlt.render(DARK, {"type": "aov", "aovs": "colour"}, spp=1)
