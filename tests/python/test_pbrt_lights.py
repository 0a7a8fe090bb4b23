"""How bright the lights of pbrt-v4 files are, by closed formulas."""

import math

import numpy as np
import pytest
from pbrt_screens import SCREEN_V4, cast, shown, smooth
from pbrt_v3_files import assert_close, read
from pbrt_v4_files import VIEW, WALL, seen

import pymlt as mlt

WHITE = 'Material "diffuse" "rgb reflectance" [ 1 1 1 ]\n'
LUMINANCES = np.array([0.2126, 0.7152, 0.0722])
ABOVE = '"point3 from" [ 0 0 2 ] "point3 to" [ 0 0 0 ]'


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


# ---- spectra -----------------------------------------------------------------------------------

SPECTRA = {
    '"spectrum %s" [ 300 .5 900 .5 ]': 1,
    '"spectrum %s" [ 300 0 500 40 600 7 900 2 ]': 1,
    '"spectrum %s" "lamp.spd"': 1,
    '"spectrum %s" "stdillum-A"': 1,
    '"blackbody %s" 4000': 1,
    '"rgb %s" [ 3 2 1 ]': np.dot([3, 2, 1], LUMINANCES),
    "": 1,
}


@pytest.mark.parametrize("spectrum", SPECTRA)
@pytest.mark.parametrize("kind", ["infinite", "area", "point", "distant", "spot"])
def test_spectra_have_luminance_one_and_colours_have_their_own(kind, spectrum):
    with open("lamp.spd", "w") as file:
        file.write("400 1\n700 9\n")
    name = "I" if kind in ("point", "spot") else "L"
    strength = f"{spectrum % name if spectrum else ''} {'' if kind == 'infinite' else ABOVE}"
    if kind == "area":
        lamp = f'AreaLightSource "diffuse" {spectrum % name if spectrum else ""} "float scale" 3\n'
        radiance = 1.0
    else:
        lamp = f'LightSource "{kind}" {strength} "float scale" 3\n'
        radiance = {"infinite": 1, "distant": 1 / math.pi}.get(kind, 1 / 2**2 / math.pi)
    shown = "" if kind == "infinite" else WHITE + WALL
    found = seen(lamp, shown, spp=16, warnings=kind == "spot")
    assert found @ LUMINANCES == pytest.approx(3 * radiance * SPECTRA[spectrum], rel=0.01)


# ---- power and illuminance ---------------------------------------------------------------------


def test_the_power_of_a_point_light_goes_to_all_directions():
    lamp = f'LightSource "point" {ABOVE} "float power" 100 "rgb I" [ 1 2 .5 ]\n'
    irradiance = 100 / (4 * math.pi) / 2**2
    assert_close(seen(lamp, WHITE, WALL), *np.array([1, 2, 0.5]) * irradiance / math.pi)


@pytest.mark.parametrize(("cone", "delta"), [(30, 5), (60, 40), (20, 20), (10, 0)])
def test_the_power_of_a_spot_light_is_that_of_its_beam_and_edge(cone, delta):
    angles = f'"float coneangle" {cone} "float conedeltaangle" {delta}'
    lamp = f'LightSource "spot" {ABOVE} "float power" 100 "float scale" 2 {angles}\n'
    theta = np.radians(np.linspace(0, cone, 100_001))
    inner, outer = (math.cos(math.radians(x)) for x in (cone - delta, cone))
    x = ((np.cos(theta) - outer) / max(inner - outer, 1e-12)).clip(0, 1)
    smooth_step = x * x * (3 - 2 * x)
    if delta == 0:
        smooth_step[:] = 1
    mean = 2 * math.pi * np.trapezoid(smooth_step * np.sin(theta), theta)
    view = VIEW.replace('"float fov" [ 2 ]', '"float fov" [ .001 ]')
    found = seen(lamp, WHITE, WALL, warnings=1, view=view)
    assert_close(found, 2 * 100 / mean / 2**2 / math.pi)


def test_illuminance_is_that_of_what_faces_the_light():
    """A white wall that faces an even sky has its radiance."""
    sun = f'LightSource "distant" {ABOVE} "float illuminance" 100 "float scale" 2\n'
    assert_close(seen(sun, WHITE, WALL), 2 * 100 / math.pi)
    sky = 'LightSource "infinite" "float illuminance" 100 "spectrum L" [ 300 7 900 7 ]\n'
    assert seen(sky, WHITE, WALL) @ LUMINANCES == pytest.approx(100 / math.pi, rel=0.01)


@pytest.mark.parametrize("light", [1.0, 0.5])
def test_the_illuminance_of_a_map_is_twice_as_much(light):
    """pbrt divides by 2 pi times the mean of the map times the cosine, which is 1/4 if it is even,
    where 4 pi would be right."""
    mlt.write_image("map.exr", np.full((64, 64, 3), light, np.float32))
    sky = 'LightSource "infinite" "string filename" "map.exr" "float illuminance" 100\n'
    assert_close(seen(sky), 100 / (math.pi / 2))


def test_only_the_upper_half_of_a_map_gives_illuminance():
    """Which is the diamond in the middle of the square, as large as the corners."""
    n = 64
    u, v = np.meshgrid(*[(np.arange(n) + 0.5) / n * 2 - 1] * 2)
    above = (abs(u) + abs(v) < 1)[..., None]
    mlt.write_image("map.exr", np.where(above, [1, 1, 1], [9, 9, 9]).astype(np.float32))
    sky = 'LightSource "infinite" "string filename" "map.exr" "float illuminance" 100\n'
    view = VIEW.replace("LookAt 0 0 5  0 0 0", "LookAt 0 0 0  0 0 1")
    assert_close(seen(sky, view=view), 100 / (math.pi / 2), rel=0.02)


# ---- images that shine -------------------------------------------------------------------------


def test_an_area_light_may_have_an_image():
    colours = np.full((4, 4, 3), 9, np.float32)
    colours[1, 1] = [1, 2, 3]  # its middle is at u = .375 and v = .625, as that of the wall
    mlt.write_image("a.exr", colours)
    lamp = 'AreaLightSource "diffuse" "string filename" "a.exr" "float scale" 2\n'
    wall = WALL + '"point2 uv" [ .37 .62 .38 .62 .38 .63 .37 .63 ]'
    assert_close(seen(lamp, wall), 2, 4, 6)


TRIANGLE = WALL.replace("0 1 2 0 2 3", "0 1 2") + '"point2 uv" [ 0 .1 1 .1 1 .2 0 .2 ]'
DISK = 'Shape "disk" "float radius" 2'


@pytest.mark.parametrize(("shape", "area"), [(TRIANGLE, 8), (DISK, math.pi * 2**2)])
def test_an_image_that_shines_has_the_power_that_is_given(shape, area):
    """pi times the area times the mean of the luminance of the image."""
    colours = np.full((4, 4, 3), [2, 1, 1], np.float32)
    colours[0] = [0, 0, 8]
    mlt.write_image("a.exr", colours)
    lamp = 'AreaLightSource "diffuse" "string filename" "a.exr" "float power" 100\n'
    mean = (3 * np.array([2, 1, 1]) + [0, 0, 8]) / 4 @ LUMINANCES
    view = VIEW.replace("LookAt 0 0 5  0 0 0", "LookAt 1.7 0 5  1.7 0 0")  # v = .15, also of a disk
    radiance = 100 / (math.pi * area) / mean
    assert_close(seen(lamp, shape, view=view), *np.multiply(radiance, [2, 1, 1]), rel=2e-3)


def test_a_black_image_has_no_power():
    mlt.write_image("a.exr", np.zeros((2, 2, 3), np.float32))
    with pytest.raises(mlt.SceneError, match="with a 'power' has a black image"):
        read(VIEW, 'AreaLightSource "diffuse" "string filename" "a.exr" "float power" 1')


def test_images_that_shine_are_exposed():
    mlt.write_image("a.exr", np.full((2, 2, 3), 0.5, np.float32))
    lamp = 'AreaLightSource "diffuse" "string filename" "a.exr"\n'
    view = VIEW.replace('"rgb"', '"rgb" "float iso" 300')
    assert_close(seen(lamp, WALL, view=view), 1.5)


# ---- images that are cast ----------------------------------------------------------------------


def slide() -> np.ndarray:
    """Six colours."""
    colours = np.random.default_rng(1).random((2, 3, 3)).astype(np.float32)
    mlt.write_image("slide.exr", colours)
    return colours


def test_a_projection_casts_the_intensities_of_its_image():
    colours = slide()
    found = cast('LightSource "projection" "string filename" "slide.exr" "float scale" 5')
    expected = 5 * colours.repeat(16, axis=0).repeat(16, axis=1) * shown()
    inside = np.arange(48) % 16 % 15 > 0  # an edge may lie within a pixel beside it
    kept = np.ix_(inside[:32], inside)
    np.testing.assert_allclose(found[kept], expected[kept], rtol=0.02)


def test_a_projection_has_the_power_that_is_given():
    """All of it meets a screen of the area 2 x 3."""
    colours = np.random.default_rng(1).random((64, 96, 3)).astype(np.float32)
    mlt.write_image("slide.exr", colours)
    lamp = 'LightSource "projection" "string filename" "slide.exr" "float power" 100'
    found = cast(lamp) @ LUMINANCES
    assert math.pi * found.mean() * 6 == pytest.approx(100, rel=0.01)
    exposed = cast(lamp, SCREEN_V4.replace('"rgb"', '"rgb" "float iso" 300', 1)) @ LUMINANCES
    assert exposed.mean() == pytest.approx(3 * found.mean(), rel=1e-3)


def test_a_projection_may_be_grey():
    mlt.write_image("slide.exr", np.full((2, 3, 1), 0.5, np.float32))
    found = cast('LightSource "projection" "string filename" "slide.exr" "float scale" 5')
    assert_close(found[15:17, 23:25].mean((0, 1)), 5 * 0.5 / math.pi)


def test_a_projection_without_an_image_is_refused():
    with pytest.raises(mlt.SceneError, match="projection light needs the 'filename' of its image"):
        read(VIEW, 'LightSource "projection"')


@pytest.mark.parametrize(
    "lamp",
    [
        '"spot" "float coneangle" 0 "float conedeltaangle" 0 "float power" 1',
        '"projection" "string filename" "slide.exr" "float power" 1',
        '"infinite" "string filename" "slide.exr" "float illuminance" 1',
    ],
)
def test_a_dark_light_with_a_power_is_refused(lamp):
    mlt.write_image("slide.exr", np.zeros((2, 2, 3), np.float32))
    with pytest.raises(mlt.SceneError, match=r"^a\.pbrt:7: the light has a '.*', but no direction"):
        read(VIEW, f"LightSource {lamp}")


# ---- goniometric lights ------------------------------------------------------------------------


def octahedral_directions(side: int) -> np.ndarray:
    """EqualAreaSquareToSphere of pbrt-v4 (Clarberg 2008) of the middles of an image's pixels."""
    along = (np.arange(side) + 0.5) / side * 2 - 1
    u, v = np.meshgrid(along, along)
    inside = 1 - abs(u) - abs(v)  # of the square of the upper half
    r = 1 - abs(inside)
    phi = np.pi / 4 * ((abs(v) - abs(u)) / r + 1)
    across = r * np.sqrt(2 - r**2)
    x, y = np.copysign(across * np.cos(phi), u), np.copysign(across * np.sin(phi), v)
    return np.stack([x, y, np.copysign(1 - r**2, inside)], axis=-1)


TURNS = {
    "": np.eye(3),
    "Rotate 50 1 2 3\n": mlt.Transform.rotate([1, 2, 3], 50).matrix[:3, :3],
    "Scale -1 1 1\n": np.diag([-1.0, 1, 1]),
}


@pytest.mark.parametrize("turn", TURNS)
def test_a_goniometric_light_has_the_intensities_of_its_image(turn):
    """The y axis of the light is the z axis of its image, and greys are means of colours."""
    intensity = smooth(octahedral_directions(128)[..., [0, 2, 1]])[..., None]
    mlt.write_image("a.exr", np.float32(intensity * [1.2, 1, 0.8]))
    lamp = f'{turn}LightSource "goniometric" "string filename" "a.exr" "rgb I" [ 3 2 1 ]'
    expected = shown(lambda d: smooth(d @ TURNS[turn])) * [15, 10, 5]
    np.testing.assert_allclose(cast(f'{lamp} "float scale" 5'), expected, rtol=0.02)


def test_a_goniometric_light_has_the_power_that_is_given():
    mlt.write_image("a.exr", np.full((4, 4, 3), 7, np.float32))
    lamp = 'LightSource "goniometric" "string filename" "a.exr" "rgb I" [ 3 2 1 ] "float power" 9'
    np.testing.assert_allclose(cast(lamp), shown() * [3, 2, 1] * 9 / (4 * math.pi), rtol=0.01)


def test_a_goniometric_light_without_an_image_is_refused():
    with pytest.raises(mlt.SceneError, match="goniometric light needs the 'filename' of its image"):
        read(VIEW, 'LightSource "goniometric"')
    mlt.write_image("a.exr", np.ones((2, 4, 3), np.float32))
    with pytest.raises(mlt.SceneError, match="a map of all directions of pbrt-v4 is square"):
        read(VIEW, 'LightSource "goniometric" "string filename" "a.exr"')
