"""Names and values of Mitsuba's `traverse`; the expected ones are those of Mitsuba 3.9."""

import numpy as np
import pytest
import tiny

import pymlt as mlt

T = mlt.Transform
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
UP = np.tile([0.0, 0.0, 1.0], (3, 1))
SHEAR = np.array([[2, 0, 1, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1.0]])


def scene(**more) -> dict:
    """The usual small scene, with a film of 64 x 32 pixels and a bit of everything."""
    made = tiny.scene()
    made["sensor"] |= {"film": {"type": "hdrfilm", "width": 64, "height": 32}}
    plain, glossy = {"type": "diffuse", "reflectance": 0.25}, {"type": "roughconductor"}
    blend = {"type": "blendbsdf", "weight": 0.5, "a": plain, "b": glossy | {"alpha": 0.4}}
    sides = {"type": "twosided", "b": glossy | {"alpha": 0.2}}
    mist = {"type": "homogeneous", "albedo": 0.5, "phase": {"type": "hg", "g": 0.3}}
    return (
        made
        | {
            "disk": {"type": "disk", "bsdf": {"type": "mask", "opacity": 0.5, "b": blend}},
            "cube": {"type": "cube", "bsdf": sides, "interior": mist},
            "mesh": {
                "type": "mesh",
                "vertices": CORNERS,
                "faces": [[0, 1, 2]],
                "normals": UP,
                "uv": CORNERS[:, :2],
                "to_world": SHEAR,
            },
        }
        | more
    )


@pytest.fixture(scope="module")
def params():
    return mlt.traverse(mlt.load_dict(scene()))


SAME = {
    "clay.reflectance.value": "clay.reflectance",
    "lamp.emitter.radiance.value": "lamp.emitter.radiance",
    "cube.bsdf.brdf_0.alpha.value": "cube.bsdf.bsdf.alpha",
    "cube.interior_medium.albedo.value.value": "cube.interior.albedo",
    "cube.interior_medium.phase_function.g": "cube.interior.phase.g",
    "disk.bsdf.opacity.value": "disk.bsdf.opacity",
    "disk.bsdf.nested_bsdf.weight.value": "disk.bsdf.bsdf.weight",
    "disk.bsdf.nested_bsdf.bsdf_0.reflectance.value": "disk.bsdf.bsdf.bsdf.reflectance",
    "disk.bsdf.nested_bsdf.bsdf_1.alpha.value": "disk.bsdf.bsdf.bsdf_1.alpha",
}


@pytest.mark.parametrize("name", SAME)
def test_plug_ins_are_called_as_in_mitsuba(name, params):
    own = SAME[name]
    assert name in params
    assert name not in list(params)
    assert params[name] == params[own]
    changed = mlt.traverse(params.scene)
    changed[name] = 0.125
    assert changed.update().hash == params.scene.updated({own: 0.125}).hash
    assert changed[own] == changed[name] == 0.125


def test_sizes_of_films_are_pairs():
    params = mlt.traverse(mlt.load_dict(scene()))
    pairs = {"size": [64, 32], "crop_size": [64, 32], "crop_offset": [0, 0]}
    assert {name: params[f"sensor.film.{name}"] for name in pairs} == pairs
    params.update({"sensor.film.size": np.array([40, 30]), "sensor.film.crop_size": (20, 10)})
    assert (params["sensor.film.width"], params["sensor.film.height"]) == (40, 30)
    assert (params.scene.width, params.scene.height) == (20, 10)
    for wrong in (5, [1, 2, 3], "large"):
        with pytest.raises(mlt.UsageError, match="but should be two numbers of pixels"):
            params["sensor.film.size"] = wrong


VIEWS = {  # the horizontal angle in Mitsuba
    "x": ({"fov": 40, "fov_axis": "x"}, 40.0),
    "y": ({"fov": 40, "fov_axis": "y"}, 72.10477447509766),
    "diagonal": ({"fov": 40, "fov_axis": "diagonal"}, 36.064788818359375),
    "smaller": ({"fov": 40, "fov_axis": "smaller"}, 72.10477447509766),
    "larger": ({"fov": 40, "fov_axis": "larger"}, 40.0),
}


@pytest.mark.parametrize("name", VIEWS)
def test_the_angle_of_view_is_horizontal(name):
    given, expected = VIEWS[name]
    made = scene()
    made["sensor"] |= given
    params = mlt.traverse(mlt.load_dict(made))
    assert params["sensor.x_fov"] == pytest.approx(expected, rel=1e-6)
    before = np.asarray(mlt.render(params, "path", spp=1, seed=1))
    params["sensor.x_fov"] = params["sensor.x_fov"]
    params.update()
    assert (params["sensor.fov_axis"], params["sensor.x_fov"]) == ("x", params["sensor.fov"])
    np.testing.assert_allclose(mlt.render(params, "path", spp=1, seed=1), before, rtol=0.02)


def test_the_angle_of_view_may_be_that_of_a_focal_length():
    made = scene()
    del made["sensor"]["fov"]
    made["sensor"]["film"] = {"type": "hdrfilm", "width": 768, "height": 576}
    angle = mlt.traverse(mlt.load_dict(made))["sensor.x_fov"]
    assert angle == pytest.approx(38.18484115600586, rel=1e-6)


def test_the_angle_of_view_is_that_of_the_whole_film_not_of_its_crop():
    made = scene()
    made["sensor"] |= {"fov": 40, "fov_axis": "y"}
    made["sensor"]["film"] |= {"crop_width": 16, "crop_height": 32}
    params = mlt.traverse(mlt.load_dict(made))
    assert params["sensor.x_fov"] == pytest.approx(72.10477447509766, rel=1e-6)
    params["sensor.film.size"] = [32, 32]
    assert params["sensor.x_fov"] == pytest.approx(40)


def test_vertices_are_flat_and_in_the_world():
    params = mlt.traverse(mlt.load_dict(scene()))
    expected = CORNERS @ SHEAR[:3, :3].T + SHEAR[:3, 3]
    np.testing.assert_allclose(params["mesh.vertex_positions"], expected.ravel(), atol=1e-6)
    np.testing.assert_allclose(params["mesh.vertex_normals"], UP.ravel(), atol=1e-6)
    np.testing.assert_allclose(params["mesh.vertex_texcoords"], CORNERS[:, :2].ravel())
    moved = expected + np.array([0, 0, 1.5])
    params["mesh.vertex_positions"] = moved.ravel()
    params["mesh.vertex_normals"] = np.tile([1.0, 0, 0], 3)
    params["mesh.vertex_texcoords"] = np.array([0, 0, 0.5, 0, 0, 0.5])
    params["mesh.faces"] = np.array([2, 1, 0])
    params.update()
    np.testing.assert_allclose(params["mesh.vertex_positions"], moved.ravel(), atol=1e-6)
    np.testing.assert_allclose(params["mesh.vertex_normals"], np.tile([1, 0, 0], 3), atol=1e-6)
    np.testing.assert_allclose(params["mesh.uv"], 0.5 * CORNERS[:, :2])
    assert params["mesh.faces"].tolist() == [[2, 1, 0]]
    inverse = np.linalg.inv(SHEAR)
    local = moved @ inverse[:3, :3].T + inverse[:3, 3]
    np.testing.assert_allclose(params["mesh.vertices"], local, atol=1e-6)


def test_vertices_of_a_mesh_that_moves_have_no_place():
    made = scene()
    made["sensor"] |= {"shutter_close": 1.0}
    made["mesh"]["to_world"] = {"type": "animation", "0": T(), "1": T().translate(1, 0, 0)}
    params = mlt.traverse(mlt.load_dict(made))
    with pytest.raises(mlt.UsageError, match=r"mesh\.vertex_positions: the mesh moves; mesh\.vert"):
        params["mesh.vertex_positions"]
    np.testing.assert_array_equal(params["mesh.vertices"], CORNERS)


def test_the_shutter_has_a_time():
    made = scene()
    made["sensor"] |= {"shutter_open": 0.25, "shutter_close": 1.0}
    params = mlt.traverse(mlt.load_dict(made))
    assert params["sensor.shutter_open_time"] == 0.75
    params.update({"sensor.shutter_open_time": 0.5})
    assert params["sensor.shutter_close"] == 0.75


UNKNOWN = {
    "sensor.fow": "did you mean 'sensor.fov'?",
    "clay.reflectence.value": "did you mean 'clay.reflectance'?",
    "cube.bsdf.alpha": "did you mean 'cube.bsdf.bsdf.alpha'?",
    "PerspectiveCamera.x_fov": "did you mean 'sensor.fov'?",
    "clay.gloss": "clay has: reflectance",
    "sensor.film.gain_in_decibels": "sensor.film has: width, height, ",
    "nobody.knows": "scene.parameters() names them all",
}


@pytest.mark.parametrize("name", UNKNOWN)
def test_an_unknown_name_is_an_error_with_what_was_probably_meant(name, params):
    said = f"the scene has no parameter '{name}'; {UNKNOWN[name]}"
    with pytest.raises(mlt.UsageError) as caught:
        params[name]
    assert str(caught.value).startswith(said)
    with pytest.raises(mlt.UsageError) as caught:
        params[name] = 1
    assert str(caught.value).startswith(said)


def test_an_index_of_refraction_is_int_ior():
    made = scene(ball={"type": "sphere", "bsdf": {"type": "dielectric"}})
    with pytest.raises(mlt.UsageError, match=r"did you mean 'ball\.bsdf\.int_ior'\?"):
        mlt.traverse(mlt.load_dict(made))["ball.bsdf.eta"]


def test_unknown_names_are_missing_as_in_other_mappings(params):
    assert "clay.gloss" not in params
    assert params.get("clay.gloss", 7) == 7
    with pytest.raises(KeyError):
        params["clay.gloss"]
