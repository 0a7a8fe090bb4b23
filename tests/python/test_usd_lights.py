"""Lights of USD: where they are, how bright, and what lies in their light."""

import math

import numpy as np
import pytest

import pymlt as mlt

pytest.importorskip("pxr", reason="needs pymlt[usd]")

from usd_files import converted, mesh, moved

DIRECT = mlt.Path(max_depth=2)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def lamp(kind: str, settings: str = "", name: str = "lamp", head: str = "") -> str:
    return f'def {kind} "{name}" {head} {{\n{settings}\n}}\n'


def light(kind: str, settings: str = "", head: str = "") -> dict:
    return converted(lamp(kind, settings, head=head)).scene["lamp"]


def radiance(light: dict) -> list[float]:
    return light["emitter"]["radiance"]["value"]


def brightness(text: str) -> np.ndarray:
    """The radiance of the middle of a square at z = 0 that has a quarter of albedo."""
    square = mesh("color3f[] primvars:displayColor = [(0.25, 0.25, 0.25)]")
    scene = mlt.load_dict(converted(text + square).scene, size=(64, 48))
    return mlt.render(scene, DIRECT, spp=64, seed=1)[22:26, 30:34].mean(axis=(0, 1))


def test_brightness_is_intensity_exposure_and_colour():
    settings = """
    float inputs:intensity = 3
    float inputs:exposure = 2
    color3f inputs:color = (1, 0.5, 0.25)
"""
    assert radiance(light("SphereLight", settings)) == pytest.approx([12, 6, 3])
    warm = settings + "bool inputs:enableColorTemperature = 1\nfloat inputs:colorTemperature = 3000"
    red, green, blue = np.divide(radiance(light("SphereLight", warm)), [12, 6, 3])
    assert red > 1.2 > green > 0.7 > blue
    assert 0.2126 * red + 0.7152 * green + 0.0722 * blue == pytest.approx(1, abs=0.02)


NORMALISED = "bool inputs:normalize = 1\nfloat inputs:intensity = 100\n"
SCALED = 'double3 xformOp:scale = (2, 2, 2)\nuniform token[] xformOpOrder = ["xformOp:scale"]\n'
AREAS = {
    "SphereLight": ("float inputs:radius = 3", 4 * math.pi * 36),
    "DiskLight": ("float inputs:radius = 3", math.pi * 36),
    "RectLight": ("float inputs:width = 3\nfloat inputs:height = 5", 60),
    "CylinderLight": ("float inputs:radius = 3\nfloat inputs:length = 5", 2 * math.pi * 60),
}


@pytest.mark.parametrize("kind", AREAS)
def test_what_is_normalised_is_so_by_its_area_in_the_world(kind):
    size, area = AREAS[kind]
    found = light(kind, NORMALISED + SCALED + size)
    assert radiance(found) == pytest.approx([100 / area] * 3)
    fixed = NORMALISED.replace("bool inputs:normalize = 1", "")
    assert radiance(light(kind, fixed + SCALED + size)) == [100] * 3


ABOVE = moved(0, 0, 6)  # and behind the camera
LAMPS = {  # radiance 100, and the irradiance below its middle
    "sphere": (lamp("SphereLight", ABOVE + "float inputs:radius = 0.5"), 100 * math.pi / 4 / 36),
    "disk": (lamp("DiskLight", ABOVE + "float inputs:radius = 3"), 100 * math.pi * 9 / 45),
    "point": (
        lamp("SphereLight", ABOVE + "bool treatAsPoint = 1\nfloat inputs:radius = 0.5"),
        100 * math.pi / 4 / 36,
    ),
    "sun": (lamp("DistantLight", "float inputs:angle = 60"), 100 * math.pi / 4),
    "sun of no size": (lamp("DistantLight", "float inputs:angle = 0"), 100),
    "dome": (lamp("DomeLight"), 100 * math.pi),
}


@pytest.mark.parametrize("name", LAMPS)
def test_how_bright_it_is_below_a_lamp(name):
    text, irradiance = LAMPS[name]
    bright = text.replace("{\n", "{\nfloat inputs:intensity = 100\n", 1)
    expected = 0.25 / math.pi * irradiance
    assert brightness(bright) == pytest.approx([expected] * 3, rel=0.02)


def test_what_shines_has_a_front():
    behind = moved(0, 0, -4)
    for kind in ("DiskLight", "RectLight"):
        front, back = (brightness(lamp(kind, where)) for where in (ABOVE, behind))
        assert front.min() > 0
        assert back.max() == 0


def test_a_point_is_as_bright_as_the_sphere_that_it_stands_for():
    settings = NORMALISED + "float inputs:radius = {}\nbool treatAsPoint = 1\n"
    for radius in (0, 2):
        point = light("SphereLight", settings.format(radius))
        assert point["type"] == "point"
        assert point["intensity"]["value"] == pytest.approx([25] * 3)


def test_a_cone_makes_a_spot():
    shaping = "float inputs:shaping:cone:angle = 30\nfloat inputs:shaping:cone:softness = 0.2\n"
    head = '(prepend apiSchemas = ["ShapingAPI"])'
    point = shaping + ABOVE + "bool treatAsPoint = 1\nbool inputs:normalize = 1"
    spot = light("SphereLight", point, head)
    assert (spot["type"], spot["cutoff_angle"]) == ("spot", 30)
    assert spot["beam_width"] == pytest.approx(24)
    expected = 0.25 / math.pi * 0.25 / 36
    assert brightness(lamp("SphereLight", point, head=head)) == pytest.approx([expected] * 3, 0.02)
    warnings = converted(lamp("SphereLight", shaping, head=head)).warnings
    assert "a sphere light with a cone becomes a spot of no size" in warnings
    warnings = converted(lamp("DiskLight", shaping, head=head)).warnings
    assert "cones of other lights than spheres are left out" in warnings


def around(folder_up: str, settings: str = "", kind: str = "DomeLight") -> np.ndarray:
    """What a camera sees that looks along -z (or +y, where z is up) into a dome."""
    image = np.zeros((32, 64, 3), np.float32)
    image[8:24, 60:], image[8:24, :4] = (1, 2, 3), (1, 2, 3)  # the direction -z
    image[8:24, 28:36] = 9, 0, 0  # the direction +z
    mlt.write_image("sky.exr", image)
    file = "asset inputs:texture:file = @sky.exr@\n"
    scene = converted(lamp(kind, file + settings), f'upAxis = "{folder_up}"').scene
    return mlt.render(mlt.load_dict(scene, size=(16, 12)), DIRECT, spp=4, seed=1)[5:7, 7:9].mean(
        axis=(0, 1)
    )


def test_the_middle_of_a_dome_is_in_the_direction_z():
    assert around("Y") == pytest.approx([1, 2, 3], rel=0.01)
    turned = 'double xformOp:rotateY = 180\nuniform token[] xformOpOrder = ["xformOp:rotateY"]\n'
    assert around("Y", turned) == pytest.approx([9, 0, 0], rel=0.01)
    tint = "color3f inputs:color = (1, 0.5, 2)\nfloat inputs:exposure = 1\n"
    assert around("Y", tint) == pytest.approx([2, 2, 12], rel=0.01)


def test_the_pole_of_a_dome():
    # Cameras look along -z whichever axis is up, and domes have y up but for those of version 1.
    assert around("Z") == pytest.approx([1, 2, 3], rel=0.01)
    assert around("Z", kind="DomeLight_1") == pytest.approx([0, 0, 0])
    fixed = 'uniform token poleAxis = "Y"\n'
    assert around("Z", fixed, "DomeLight_1") == pytest.approx([1, 2, 3], rel=0.01)


def test_a_picture_on_a_lamp_is_upright_for_those_whom_it_lights():
    image = np.zeros((2, 2, 3), np.float32)
    image[0, 0], image[0, 1], image[1, 0] = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    mlt.write_image("picture.exr", image)
    text = lamp(
        "RectLight",
        """
    asset inputs:texture:file = @picture.exr@
    float inputs:intensity = 2
    float inputs:width = 5
    float inputs:height = 3.75
    double xformOp:rotateY = 180
    uniform token[] xformOpOrder = ["xformOp:rotateY"]
""",
    )
    scene = mlt.load_dict(converted(text).scene, size=(32, 24))
    seen = mlt.render(scene, DIRECT, spp=4, seed=1)
    assert seen[2, 2] == pytest.approx([2, 0, 0], abs=0.05)
    assert seen[2, -3] == pytest.approx([0, 2, 0], abs=0.05)
    assert seen[-3, 2] == pytest.approx([0, 0, 2], abs=0.05)


def test_a_mesh_that_is_a_light_shines():
    head = '(prepend apiSchemas = ["MeshLightAPI"])'
    scene = converted(
        mesh("float inputs:intensity = 8\nbool inputs:normalize = 1", head=head)
    ).scene
    assert radiance(scene["square"]) == [2, 2, 2]
    assert "sun" not in scene


def test_copies_of_what_shines_are_shapes_of_their_own():
    text = f"""
def PointInstancer "points" {{
    rel prototypes = [</points/lamp>]
    int[] protoIndices = [0, 0]
    point3f[] positions = [(1, 0, 0), (2, 0, 0)]
    {lamp("SphereLight")}
}}"""
    scene = converted(text).scene
    assert [scene[f"points-lamp{end}"]["to_world"][0, 3] for end in ("", "_2")] == [1, 2]


def test_what_lights_have_and_is_not_read_is_named():
    text = lamp("PortalLight") + lamp(
        "DomeLight",
        """
    asset inputs:texture:file = @sky.exr@
    token inputs:texture:format = "angular"
    float inputs:diffuse = 0.5
""",
        "dome",
    )
    mlt.write_image("sky.exr", np.ones((4, 8, 3), np.float32))
    assert set(converted(text).warnings) == {
        "lights of type PortalLight are left out",
        "dome lights of the format 'angular' are taken as 'latlong'",
        "the factor 'diffuse' of lights is left out: they light alike",
    }


def test_images_that_are_missing_are_named():
    text = lamp("DomeLight", "asset inputs:texture:file = @no/sky.exr@")
    tinted = lamp(
        "DomeLight",
        "asset inputs:texture:file = @b.exr@\ncolor3f inputs:color = (1, 0, 0)",
        "tinted",
    )
    with pytest.raises(mlt.FileError) as error:
        converted(text + tinted)
    absent = "there is no such file"
    assert str(error.value) == f"a.usda: no/sky.exr: {absent}; b.exr: {absent}"


def test_a_temperature_that_is_none_is_refused():
    hot = "bool inputs:enableColorTemperature = 1\nfloat inputs:colorTemperature = nan"
    with pytest.raises(mlt.SceneError, match=r"a\.usda: /lamp: colorTemperature is nan, not in"):
        converted(lamp("SphereLight", hot))


def test_a_dome_of_one_pixel_is_even_and_a_dark_one_is_none():
    mlt.write_image("sky.exr", np.full((1, 1, 3), [1, 2, 4], np.float32))
    sky = "asset inputs:texture:file = @sky.exr@\nfloat inputs:intensity = 0.5"
    even = light("DomeLight", sky)
    assert (even["type"], even["radiance"]["value"]) == ("constant", [0.5, 1, 2])
    made = converted(lamp("DomeLight", sky.replace("0.5", "0")) + lamp("DistantLight", name="sun"))
    assert "lamp" not in made.scene
    assert "sun" in made.scene
