"""pbrt-v3 files: lights, textures, media and views, by closed formulas."""

import math
from pathlib import Path

import numpy as np
import pytest
from test_pbrt_v3 import RED, SKY, VIEW, WALL, assert_close, read, seen, written

import pymlt as mlt
from pymlt.formats.pbrt.spectra import WAVELENGTHS, planck

WHITE = 'Material "matte" "rgb Kd" [ 1 1 1 ]\n'


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


# ---- lights ------------------------------------------------------------------------------------


def test_a_point_light_has_its_intensity_times_its_scale():
    lamp = (
        'LightSource "point" "color I" [ 6 3 1 ] "color scale" [ 2 2 0 ] "point from" [ 0 0 2 ]\n'
    )
    assert_close(seen(lamp, WHITE, WALL), *np.array([12, 6, 0]) / 2**2 / math.pi)


def test_a_distant_light_has_its_irradiance():
    sun = 'LightSource "distant" "rgb L" [ 2 1 0 ] "float scale" 3 "point from" [ 0 0 1 ] '
    assert_close(seen(sun + '"point to" [ 0 0 0 ]\n', WHITE, WALL), 6 / math.pi, 3 / math.pi, 0)


SPOT = 'LightSource "spot" "rgb I" [ 8 8 8 ] "point from" [ 0 0 2 ] "point to" [ %s 0 %s ]'


def test_a_spot_light_has_its_intensity_up_to_its_edge():
    """Turned by an angle about which the middle of the wall is seen from the light."""
    for degrees, lit in ((0, True), (22, True), (33, False)):
        at = math.radians(degrees)
        to = (f"{math.sin(at):.6f}", f"{2 - math.cos(at):.6f}")
        expected = 8 / 2**2 / math.pi * lit
        assert_close(seen(SPOT % to, WHITE, WALL, warnings=1), expected)


@pytest.mark.parametrize(("cone", "delta"), [(30, 5), (60, 40), (20, 20)])
def test_a_spot_light_has_the_power_of_pbrt(cone, delta):
    made = read(VIEW, f'LightSource "spot" "float coneangle" {cone} "float conedeltaangle" {delta}')
    spot = made.scene["spot-light"]
    angles = np.radians(np.linspace(0, 90, 100_001))
    c = np.cos(angles)
    inner, outer = (math.cos(math.radians(x)) for x in (cone - delta, cone))
    pbrt = ((c - outer) / (inner - outer)).clip(0, 1) ** 4
    beam, cutoff = np.radians([spot["beam_width"], spot["cutoff_angle"]])
    ours = ((cutoff - angles) / (cutoff - beam)).clip(0, 1)
    powers = [np.trapezoid(x * np.sin(angles), angles) for x in (ours, pbrt)]
    assert powers[0] == pytest.approx(powers[1], rel=1e-3)
    assert cone - delta == pytest.approx(spot["beam_width"])


@pytest.mark.parametrize("kind", ["area", "diffuse"])
def test_area_lights_have_their_radiance_times_their_scale(kind):
    lamp = f'AreaLightSource "{kind}" "color L" [ 2000 3 1 ] "color scale" [ 1 1 .5 ]'
    assert_close(seen(lamp, '"integer nsamples" 8\n', WALL), 2000, 3, 0.5)


@pytest.mark.parametrize("kelvin", [3000, 6500])
def test_the_brightest_wavelength_of_a_black_body_has_its_second_number(kelvin):
    made = read(VIEW, f'LightSource "infinite" "blackbody L" [ {kelvin} 2.5 ]')
    waves, heights = np.transpose(made.scene["infinite-light"]["radiance"]["value"])
    assert list(waves) == list(WAVELENGTHS)
    wide = np.arange(300, 1500)
    brightest = max(planck(wave, kelvin) for wave in wide)
    expected = [2.5 * planck(wave, kelvin) / brightest for wave in waves]
    assert heights == pytest.approx(expected, rel=1e-4)


def test_lights_without_a_counterpart_are_named():
    for kind in ("goniometric", "projection"):
        said = read(VIEW, SKY, f'LightSource "{kind}" "string mapname" "a.exr"').warnings
        assert said == [f"the light '{kind}' has no counterpart"]


ROWS = 16


def direction(u: float, v: float) -> np.ndarray:
    """Where pbrt-v3 looks up a map at (u, v)."""
    theta, phi = math.pi * v, 2 * math.pi * u
    return np.array(
        [math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta)]
    )


def looking(at: np.ndarray, sky: str) -> np.ndarray:
    up = "0 0 1" if abs(at[2]) < 0.9 else "1 0 0"
    view = VIEW.replace("LookAt 0 0 5  0 0 0  0 1 0", "LookAt 0 0 0 {} {} {} {}".format(*at, up))
    made = read(view, sky)
    assert made.warnings == []
    return mlt.render(mlt.load_dict(made.scene), spp=4).mean(axis=(0, 1))


@pytest.mark.parametrize("turn", [np.eye(3), np.roll(np.eye(3), 1, axis=0), np.diag([1.0, -1, 1])])
@pytest.mark.parametrize(("row", "column"), [(3, 2), (7, 13), (12, 30)])
def test_a_map_is_of_latitude_and_longitude_around_z(row, column, turn):
    pixels = np.zeros((ROWS, 2 * ROWS, 3), np.float32)
    pixels[row, column] = [4, 2, 1]
    mlt.write_image("a.exr", pixels)
    matrix = np.eye(4)
    matrix[:3, :3] = turn
    transform = f"Transform [ {' '.join(map(str, matrix.T.ravel()))} ]\n"
    sky = transform + 'LightSource "infinite" "string mapname" "a.exr" "color L" [ .5 1 1 ] '
    sky += '"color scale" [ 3 3 3 ]'
    at = direction((column + 0.5) / (2 * ROWS), (row + 0.5) / ROWS)
    assert_close(looking(turn @ at, sky), 6, 6, 3, rel=0.12)
    beside = direction((column + 2.5) / (2 * ROWS), (row + 0.5) / ROWS)
    assert_close(looking(turn @ beside, sky), 0)


def test_a_map_of_bytes_is_not_decoded():
    """Its value .5 is .214 in linear light."""
    decoded = ((0.5 + 0.055) / 1.055) ** 2.4
    mlt.write_image("a.png", np.full((ROWS, 2 * ROWS, 3), decoded, np.float32))
    found = looking(RED, 'LightSource "infinite" "string mapname" "a.png"')
    assert_close(found, 0.5)


# ---- textures ----------------------------------------------------------------------------------


def texture(kind: str, parameters: str, surface: str = 'Material "matte" "texture Kd" "t"') -> str:
    return f'Texture "t" "color" "{kind}" {parameters}\n{surface}'


@pytest.mark.parametrize(
    ("name", "gamma", "linear"),
    [
        ("a.png", "", False),
        ("a.png", '"bool gamma" "false"', True),
        ("a.exr", "", True),
        ("a.exr", '"bool gamma" "true"', False),
    ],
)
def test_images_are_decoded_where_gamma_says_so(name, gamma, linear):
    """The value .5 that is stored is .214 in linear light, if it is encoded as sRGB."""
    stored = 0.5 if name.endswith("exr") else ((0.5 + 0.055) / 1.055) ** 2.4
    mlt.write_image(name, np.full((2, 2, 3), stored, np.float32))
    found = seen(SKY, texture("imagemap", f'"string filename" "{name}" {gamma}'), WALL)
    assert_close(found, 0.5 if linear else ((0.5 + 0.055) / 1.055) ** 2.4, rel=0.02)


def test_images_have_a_scale():
    mlt.write_image("a.exr", np.full((2, 2, 3), 0.25, np.float32))
    quality = '"bool trilinear" "true" "float maxanisotropy" 2'
    text = texture("imagemap", f'"string filename" "a.exr" "float scale" 3 {quality}')
    assert_close(seen(SKY, text, WALL), 0.75)


def test_a_scale_is_a_product_of_two_textures():
    assert_close(
        seen(SKY, texture("scale", '"color tex1" [ .8 .4 1 ] "color tex2" [ .5 .5 .1 ]'), WALL),
        0.4,
        0.2,
        0.1,
    )


def test_constants_are_mixed():
    colours = '"color tex1" [ 1 0 0 ] "color tex2" [ 0 1 0 ]'
    assert_close(seen(SKY, texture("mix", f'{colours} "float amount" .2'), WALL), 0.8, 0.2, 0)
    assert_close(seen(SKY, texture("mix", ""), WALL), 0.5)
    numbers = 'Texture "t" "float" "mix" "float tex1" .2 "float tex2" .4 "float amount" .25\n'
    made = read(
        VIEW, numbers, 'Material "metal" "bool remaproughness" "false" "texture roughness" "t"'
    )
    assert made.scene["metal-material"]["bsdf"]["alpha"] == pytest.approx(0.25)


def test_a_texture_of_numbers_may_have_the_name_of_one_of_colours():
    both = 'Texture "t" "color" "constant" "color value" [ .8 .4 .2 ]\n'
    both += 'Texture "t" "float" "constant" "float value" .3\n'
    text = both + 'Material "uber" "texture Kd" "t" "texture roughness" "t" '
    made = read(VIEW, text + '"bool remaproughness" "false"').scene["uber-material"]["bsdf"]
    assert made["bsdf_1"]["alpha"] == 0.3
    assert_close(seen(SKY, both + 'Material "matte" "texture Kd" "t"', WALL), 0.8, 0.4, 0.2)


def test_a_checkerboard_has_the_colours_of_its_squares():
    mesh = WALL + '"float uv" [ .1 .1 .4 .1 .4 .4 .1 .4 ]'
    board = texture("checkerboard", '"color tex1" [ .7 0 0 ] "color tex2" [ 0 .7 0 ]')
    assert_close(seen(SKY, board, mesh), 0.7, 0, 0)


# ---- media -------------------------------------------------------------------------------------

INSIDE = """
MakeNamedMedium "smoke" "string type" "%s" %s
AttributeBegin
MediumInterface "smoke" ""
Material ""
Scale 4 4 1
Shape "trianglemesh"
    "point P" [ -1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 1 1 ]
    "integer indices" [ 0 2 1 1 2 3  4 5 6 5 7 6  0 4 2 4 6 2
                        1 3 5 5 3 7  0 1 4 1 5 4  2 6 3 6 7 3 ]
AttributeEnd
"""


def test_a_homogeneous_medium_absorbs():
    smoke = INSIDE % ("homogeneous", '"color sigma_a" [ .1 .2 .3 ] "color sigma_s" [ 0 0 0 ]')
    assert_close(seen(SKY, smoke), *np.exp(-2 * np.array([0.1, 0.2, 0.3])))


def test_a_grid_of_densities_absorbs():
    box = '"point p0" [ -9000 -9000 -9000 ] "point p1" [ 9000 9000 9000 ]'
    grid = '"integer nz" 1 "float density" [ 2 ] ' + box
    smoke = '"color sigma_a" [ .1 .2 .3 ] "color sigma_s" [ 0 0 0 ]' + grid
    found = seen(SKY, INSIDE % ("heterogeneous", smoke))
    assert_close(found, *np.exp(-4 * np.array([0.1, 0.2, 0.3])))


def test_a_grid_is_of_milk_by_default():
    made = read(VIEW, INSIDE % ("heterogeneous", '"float density" [ 2 ]')).scene["smoke-medium"]
    scattered, absorbed = np.array([2.55, 3.21, 3.77]), np.array([0.0011, 0.0024, 0.014])
    assert made["albedo"] == pytest.approx(scattered / (scattered + absorbed))
    assert made["sigma_t"]["data"].max((0, 1, 2)) == pytest.approx(2 * (scattered + absorbed))


# ---- views -------------------------------------------------------------------------------------


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


def test_the_crop_window_is_a_part_of_the_image():
    film = '"integer xresolution" 40 "integer yresolution" 20 "float cropwindow" [ .25 .75 0 .5 ]'
    made = read(f'Camera "perspective"\nFilm "image" {film}', SKY)
    image = mlt.render(mlt.load_dict(made.scene), spp=1)
    assert image.shape[:2] == (10, 20)
    assert made.scene["camera"]["film"]["crop_offset_x"] == 10


def test_a_screen_window_is_an_angle():
    """A window of half the size shows the half of the tangent."""
    window = '"float fov" 90 "float screenwindow" [ -.5 .5 -.5 .5 ]'
    made = read(f'Camera "perspective" {window}\nFilm "image"', SKY)
    assert made.scene["camera"]["fov"] == pytest.approx(2 * math.degrees(math.atan(0.5)))
    assert (
        read('Camera "perspective" "float halffov" 20\nFilm "image"').scene["camera"]["fov"] == 40
    )


@pytest.mark.parametrize("film", ["image", "rgb"])
def test_there_is_a_coordinate_system_of_the_world(film):
    placed = 'Translate 1 2 3 CoordSysTransform "world" Shape "sphere"'
    made = read(f'Film "{film}" WorldBegin ', SKY, placed)
    np.testing.assert_array_equal(made.scene["sphere"]["to_world"], np.eye(4))


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


def test_spectra_that_are_no_file_are_named():
    Path("a.spd").write_text("400 .5 # a half\n700 .5")
    assert_close(seen(SKY, 'Material "matte" "spectrum Kd" "a.spd"', WALL), 0.5)
    said = read(VIEW, SKY, 'Material "matte" "spectrum Kd" "b.spd"').warnings
    assert said == ["the spectrum 'b.spd' is not known; it is taken as 1"]
