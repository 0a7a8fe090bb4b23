"""Lights, textures and media of pbrt-v3 files, by closed formulas."""

import math

import numpy as np
import pytest
from pbrt_screens import SCREEN_V3, cast, shown, smooth
from pbrt_v3_files import RED, SKY, VIEW, WALL, assert_close, read, seen

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


# ---- images that are cast ----------------------------------------------------------------------


TURNS = {"": np.eye(3), "Rotate 90 0 1 0\n": mlt.Transform.rotate([0, 1, 0], 90).matrix[:3, :3]}


@pytest.mark.parametrize("turn", TURNS)
def test_a_goniometric_map_is_of_latitude_and_longitude_around_y(turn):
    u, v = np.meshgrid((np.arange(128) + 0.5) / 128, (np.arange(64) + 0.5) / 64)
    around_z = np.stack(
        [*np.sin(np.pi * v) * [np.cos(2 * np.pi * u), np.sin(2 * np.pi * u)], np.cos(np.pi * v)],
        axis=-1,
    )
    intensity = smooth(around_z[..., [0, 2, 1]])[..., None]
    mlt.write_image("a.exr", np.float32(intensity * [1.5, 1, 0.5]))
    lamp = f'{turn}LightSource "goniometric" "string mapname" "a.exr" "color I" [ 2 2 4 ]'
    found = cast(f'{lamp} "color scale" [ 3 3 3 ]', SCREEN_V3)
    expected = shown(lambda d: smooth(d @ TURNS[turn])) * [9, 6, 6]
    np.testing.assert_allclose(found, expected, rtol=0.02)


def test_a_goniometric_light_without_a_map_is_a_point():
    found = cast('LightSource "goniometric" "color I" [ 3 2 1 ]', SCREEN_V3)
    np.testing.assert_allclose(found, shown() * [3, 2, 1], rtol=0.01)


def test_a_projection_interpolates_and_has_its_first_row_below():
    pixels = np.random.default_rng(1).random((2, 3, 3)).astype(np.float32)
    mlt.write_image("a.exr", pixels)
    lamp = 'LightSource "projection" "string mapname" "a.exr" "float fov" 90 "color I" [ 2 4 6 ]'
    found = cast(lamp, SCREEN_V3) / shown()
    around = np.pad(pixels[::-1] * [2, 4, 6], ((1, 1), (1, 1), (0, 0)), mode="wrap")
    rows, columns = ((np.arange(count) + 0.5) / 16 + 0.5 for count in (32, 48))
    between = np.apply_along_axis(lambda c: np.interp(rows, range(4), c), 0, around)
    expected = np.apply_along_axis(lambda r: np.interp(columns, range(5), r), 1, between)
    np.testing.assert_allclose(found, expected, rtol=0.02, atol=0.02)


def test_a_projection_without_a_map_fills_its_square():
    found = cast('LightSource "projection"', SCREEN_V3) / shown()
    reach = math.tan(math.radians(45 / 2)) * 16
    assert_close(found[14:18, 22:26].mean(axis=(0, 1)), 1)
    assert found[..., 0].sum() == pytest.approx((2 * reach) ** 2, rel=0.01)


# ---- textures ----------------------------------------------------------------------------------


def texture(kind: str, parameters: str, surface: str = 'Material "matte" "texture Kd" "t"') -> str:
    return f'Texture "t" "color" "{kind}" {parameters}\n{surface}'


@pytest.mark.parametrize(
    ("name", "gamma", "linear"),
    [
        ("a.png", "", False),
        ("a.png", '"bool gamma" "false"', True),
        ("a.jpg", "", False),
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
