"""Cameras, films, filters, samplers, integrators and shapes of pbrt-v3 files."""

import math

import numpy as np
import pytest
from pbrt_v3_files import SKY, VIEW, WALL, assert_close, read, written

import pymlt as mlt


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_the_film_multiplies_the_image_and_the_shutter_does_not():
    view = VIEW.replace('"image"', '"image" "float scale" 2.5')
    view = view.replace("[ 2 ]", '[ 2 ] "float shutteropen" 0 "float shutterclose" .25')
    made = read(view, SKY)
    assert made.warnings == []
    assert_close(mlt.render(mlt.load_dict(made.scene), spp=1).mean((0, 1)), 2.5)


def test_without_a_filter_it_is_a_box():
    assert mlt.load(written(VIEW, SKY)).info()["filter"] == "box"


FILTERS = {
    'PixelFilter "box" "float xwidth" 1 "float ywidth" 1': {"type": "box", "radius": 1},
    'PixelFilter "triangle"': {"type": "tent", "radius": 2},
    'PixelFilter "gaussian" "float alpha" 8': {"type": "gaussian", "stddev": 0.25},
    'PixelFilter "mitchell" "float B" .5 "float C" .25': {"type": "mitchell", "b": 0.5, "c": 0.25},
    'PixelFilter "sinc" "float tau" 4': {"type": "lanczos", "lobes": 4},
}


@pytest.mark.parametrize("text", FILTERS)
def test_filters_are_those_of_pbrt(text):
    made = read(text, VIEW, SKY).scene
    assert made["camera"]["film"]["rfilter"] == FILTERS[text]
    mlt.load_dict(made)
    if "gaussian" not in text:
        of_v4 = read('Film "rgb" Camera "perspective" ', text.replace("width", "radius"), "\n", SKY)
        assert of_v4.scene["camera"]["film"]["rfilter"] == FILTERS[text]


@pytest.mark.parametrize("kind", ["image", "rgb"])
def test_the_crop_window_is_a_part_of_the_image(kind):
    film = '"integer xresolution" 40 "integer yresolution" 20 "float cropwindow" [ .25 .75 0 .5 ]'
    made = read(f'Camera "perspective"\nFilm "{kind}" {film}', SKY)
    image = mlt.render(mlt.load_dict(made.scene), spp=1)
    assert image.shape[:2] == (10, 20)
    assert made.scene["camera"]["film"]["crop_offset_x"] == 10


@pytest.mark.parametrize("film", ["image", "rgb"])
def test_a_screen_window_is_an_angle(film):
    """A window of half the size shows the half of the tangent."""
    window = 'Camera "perspective" "float fov" 90 "float screenwindow" [ -%g .5 -.25 .25 ]'
    found = read(window % 0.5, f'Film "{film}"', SKY).scene["camera"]["fov"]
    assert found == pytest.approx(2 * math.degrees(math.atan(0.25)))
    said = read(window % 0.75, f'Film "{film}"', SKY).warnings
    assert said == ["a 'screenwindow' is taken as if it were around the middle of the image"]


@pytest.mark.parametrize("film", ["image", "rgb"])
@pytest.mark.parametrize(("window", "lit"), [("", 0.25), ("[ -1 3 -1 1 ]", 0.5)])
def test_an_orthographic_camera_shows_its_window(film, window, lit):
    """The shorter side is 2 if nothing is said: here one end is at x = 2, or at 3."""
    size = '"integer xresolution" 40 "integer yresolution" 20'
    given = window and f'"float screenwindow" {window}'
    view = f'LookAt 0 0 -5  0 0 0  0 1 0 Camera "orthographic" {given} Film "{film}" {size}'
    lamp = ' WorldBegin AreaLightSource "diffuse" "rgb L" [ 1 1 1 ] ReverseOrientation\n'
    wall = 'Shape "trianglemesh" "point3 P" [ 1 -9 0  9 -9 0  9 9 0  1 9 0 ] '
    made = read(view, lamp, wall, '"integer indices" [ 0 1 2 0 2 3 ]')
    image = mlt.render(mlt.load_dict(made.scene), spp=16)[..., 0]
    assert image.shape == (20, 40)
    assert image.mean() == pytest.approx(lit, abs=0.01)
    assert image[:, -5:].min() > 0.9


def test_half_of_the_angle_of_view_may_be_given():
    made = read('Camera "perspective" "float halffov" 20\nFilm "image"')
    assert made.scene["camera"]["fov"] == 40


@pytest.mark.parametrize("film", ["image", "rgb"])
def test_there_is_a_coordinate_system_of_the_world(film):
    placed = 'Translate 1 2 3 CoordSysTransform "world" Shape "cylinder"'
    made = read(f'Film "{film}" WorldBegin ', SKY, placed)
    np.testing.assert_array_equal(made.scene["cylinder"]["to_world"], np.eye(4))


INTEGRATORS = {"path": "path", "volpath": "path", "bdpt": "bdpt", "mlt": "pssmlt"}


@pytest.mark.parametrize("name", INTEGRATORS)
def test_integrators_have_one_edge_more_than_bounces(name):
    made = read(VIEW.replace("path", name), SKY)
    assert made.scene["integrator"] == {"type": INTEGRATORS[name], "max_depth": 21}
    assert made.warnings == []


@pytest.mark.parametrize("name", ["directlighting", "whitted"])
def test_integrators_of_direct_light_become_direct(name):
    made = read(VIEW.replace("path", name), SKY, 'Material "matte"', WALL)
    assert made.scene["integrator"] == {"type": "direct"}
    assert f"the integrator '{name}' becomes 'direct'" in " ".join(made.warnings)


def test_a_stratified_sampler_has_a_grid_of_samples():
    sampler = 'Sampler "stratified" "integer xsamples" 3 "integer ysamples" [ 5 ]\n'
    assert mlt.load(written(sampler, VIEW, SKY)).info()["sample_count"] == 15
    assert mlt.load(written('Sampler "02sequence"\n', VIEW, SKY)).info()["sample_count"] == 16


def test_subdivision_surfaces_have_levels():
    corners = '"point P" [ 1 0 0 0 1 0 0 0 1 -1 0 0 0 -1 0 0 0 -1 ]'
    faces = '"integer indices" [ 0 1 2 1 3 2 3 4 2 4 0 2 1 0 5 3 1 5 4 3 5 0 4 5 ] '
    made = read(VIEW, SKY, f'Shape "loopsubdiv" {corners} {faces} "integer nlevels" 2')
    assert len(made.scene["loopsubdiv"]["faces"]) == 8 * 4**2
    assert made.warnings == []


@pytest.mark.parametrize("kind", ["cone", "curve", "heightfield", "hyperboloid", "nurbs"])
def test_shapes_without_a_counterpart_are_named(kind):
    assert read(VIEW, SKY, f'Shape "{kind}"').warnings == [f"the shape '{kind}' has no counterpart"]


def test_meshes_have_tangents_that_are_left_out():
    mesh = WALL + '"vector S" [ 1 0 0 1 0 0 1 0 0 1 0 0 ] "normal N" [ 0 0 1 0 0 1 0 0 1 0 0 1 ]'
    assert read(VIEW, SKY, mesh).warnings == ["Shape 'trianglemesh': 'S' is left out"]


def test_a_red_ball_below_a_lamp_is_what_its_formula_says():
    """A ball's top, at the distance 4 from the middle of a small lamp of radiance 2000."""
    lamp = 'AttributeBegin AreaLightSource "area" "color L" [ 2000 2000 2000 ]\nTranslate 0 0 5\n'
    lamp += 'Shape "sphere" "float radius" [ .2 ]\nAttributeEnd\n'
    view = VIEW.replace("LookAt 0 0 5  0 0 0  0 1 0", "LookAt 4 0 4  0 0 1  0 0 1").replace(
        "[ 2 ]", "[ .5 ]"
    )
    scene = written(view, lamp, 'Material "matte" "color Kd" [ .8 .1 .1 ] Shape "sphere" WorldEnd')
    irradiance = math.pi * 2000 * (0.2 / 4) ** 2
    found = mlt.render(mlt.load(scene), mlt.Path(max_depth=2), spp=256).mean((0, 1))
    assert_close(found, *np.array([0.8, 0.1, 0.1]) * irradiance / math.pi, rel=0.03)


@pytest.mark.parametrize("kind", ["environment", "spherical"])
def test_a_spherical_camera_looks_where_that_of_pbrt_looks(kind):
    """The directions of pbrt's SphericalCamera for shares u and v of the image."""
    film = "image" if kind == "environment" else "rgb"
    mapping = '"string mapping" "equirectangular"' if kind == "spherical" else ""
    made = read(f'Camera "{kind}" {mapping} Film "{film}"', SKY)
    assert made.warnings == []
    camera = made.scene["camera"]
    assert camera["type"] == "spherical"
    for u, v in [(0.1, 0.3), (0.5, 0.5), (0.8, 0.9)]:
        theta, phi = math.pi * v, 2 * math.pi * u
        of_pbrt = [math.cos(phi), 1 / math.tan(theta), math.sin(phi)]
        ours = [-math.sin(phi - math.pi), 1 / math.tan(theta), math.cos(phi - math.pi)]
        assert np.array(camera["to_world"])[:3, :3] @ ours == pytest.approx(of_pbrt)
    mlt.load_dict(made.scene)


def test_another_mapping_of_a_spherical_camera_is_a_warning():
    said = read('Camera "spherical" Film "rgb"', SKY).warnings
    assert said == ["the mapping 'equalarea' is taken as 'equirectangular'"]
