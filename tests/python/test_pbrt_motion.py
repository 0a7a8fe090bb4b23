"""What moves in pbrt files while the shutter is open, by the share of the time that it is seen."""

import numpy as np
import pytest
from pbrt_v3_files import SKY, read, written

import pymlt as mlt

#: It shows the origin, or what is turned or moved there.
VIEW = """
%s
Camera "perspective" "float fov" [ .1 ] %s
Film "%s" "integer xresolution" [ 8 ] "integer yresolution" [ 8 ]
PixelFilter "box"
%s
WorldBegin
"""
STILL = "LookAt 0 0 5  0 0 0  0 1 0"
#: A lamp of the radiance 1 that is 1 wide and high and shines to the camera.
LAMP = """
AreaLightSource "diffuse" "rgb L" [ 1 1 1 ]
Shape "trianglemesh" "%s P" [ -.5 -.5 0  .5 -.5 0  .5 .5 0  -.5 .5 0 ]
    "integer indices" [ 0 1 2 0 2 3 ]
"""
MOVE = """
ActiveTransform StartTime Translate -2 0 0
ActiveTransform EndTime Translate 2 0 0
ActiveTransform All
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def view(look=STILL, shutter="", film="rgb", times="") -> str:
    return VIEW % (look, shutter, film, times)


def lamp(version: int = 4) -> str:
    return LAMP % ("point" if version == 3 else "point3")


def brightness(*parts: str) -> float:
    made = read(*parts)
    assert made.warnings == []
    return float(mlt.render(mlt.load_dict(made.scene), spp=2048).mean())


#: Parameters of the camera and the option of the file, and the share of the time in which the lamp
#: is before the camera: it is as long as its way of 4.
SHARES = {
    ("", ""): 1 / 4,
    ('"float shutteropen" .25 "float shutterclose" .75', ""): 1 / 2,
    ('"float shutterclose" .5', ""): 1 / 4,
    ("", "TransformTimes 0 2"): 1 / 4,
    ("", "TransformTimes .25 .75"): 1 / 8,
}


@pytest.mark.parametrize(("shutter", "times"), SHARES)
@pytest.mark.parametrize("version", [3, 4])
def test_a_shape_is_seen_while_it_is_in_view(shutter, times, version):
    film = "image" if version == 3 else "rgb"
    found = brightness(view(STILL, shutter, film, times), MOVE, lamp(version))
    exposure = 0.5 if version == 4 and "close" in shutter else 1
    assert found == pytest.approx(SHARES[shutter, times] * exposure, rel=0.02)


def test_a_shape_turns_evenly():
    """A wedge of 30 degrees turns by 90: a third of the time it covers what is at 45 degrees."""
    look = "LookAt .5 .5 5  .5 .5 0  0 1 0"
    turn = "ActiveTransform EndTime Rotate 90 0 0 1 ActiveTransform All\n"
    wedge = np.array([[0, 0, 0], [2, 0, 0], [2, 2 * np.tan(np.radians(30)), 0]])
    corners = " ".join(map(str, wedge.ravel()))
    shape = f'AreaLightSource "diffuse" Shape "trianglemesh" "point3 P" [ {corners} ]'
    assert brightness(view(look), turn, shape) == pytest.approx(1 / 3, rel=0.02)


@pytest.mark.parametrize("kind", ["perspective", "orthographic"])
@pytest.mark.parametrize("window", ["", '"float screenwindow" [ -.01 .01 -.01 .01 ]'])
def test_a_camera_moves(kind, window):
    look = """
ActiveTransform StartTime LookAt -2 0 5  -2 0 0  0 1 0
ActiveTransform EndTime   LookAt 2 0 5  2 0 0  0 1 0
ActiveTransform All"""
    text = view(look, window)
    if kind == "orthographic":
        text = text.replace('"perspective" "float fov" [ .1 ]', '"orthographic"')
    found = brightness(text, lamp())
    wide = kind == "orthographic" and not window
    # An image that is 2 wide and high has a quarter for the lamp, all of which it shows on a way of
    # the length 1, and half of which, on average, before and after, each of the length 1, too.
    assert found == pytest.approx(1 / 4 * 1 / 2 if wide else 1 / 4, rel=0.02)


def test_an_instance_moves():
    group = 'ObjectBegin "wall"\nShape "trianglemesh" "point3 P"'
    group += " [ -.5 -.5 0  .5 -.5 0  .5 .5 0  -.5 .5 0 ]"
    group += ' "integer indices" [ 0 1 2 0 2 3 ]\nObjectEnd\n'
    black = 'Material "diffuse" "rgb reflectance" [ 0 0 0 ]\n'
    found = brightness(view(), SKY, black, group, MOVE, 'ObjectInstance "wall"')
    assert found == pytest.approx(3 / 4, rel=0.02)


def test_a_converted_file_moves_alike():
    path = written(view(), MOVE, lamp())
    mlt.convert(path, "a.xml")
    images = [mlt.render(mlt.load(name), "path", spp=8, seed=1) for name in (path, "a.xml")]
    np.testing.assert_array_equal(*images)


def test_what_is_active_is_part_of_the_state():
    """Blocks, of both kinds, end it, and so does the beginning of the world."""
    moved = "ActiveTransform EndTime Translate 9 0 0\n"
    for kind in ("Attribute", "Transform"):
        made = read(view(), SKY, f"{kind}Begin\n{moved}{kind}End\n", "Translate 1 0 0", lamp())
        np.testing.assert_array_equal(made.scene["trianglemesh"]["to_world"][:3, 3], [1, 0, 0])
        assert "shutter_close" not in made.scene["camera"]
    made = read(view(times="ActiveTransform EndTime"), SKY, "Translate 1 0 0", lamp())
    np.testing.assert_array_equal(made.scene["trianglemesh"]["to_world"][:3, 3], [1, 0, 0])
    named = 'AttributeBegin Translate 3 0 0 CoordinateSystem "here" AttributeEnd\n'
    back = f'{named}{moved}CoordSysTransform "here"\n'
    made = read(view(), SKY, back, lamp())
    np.testing.assert_array_equal(made.scene["trianglemesh"]["to_world"][:3, 3], [3, 0, 0])


def test_lights_and_media_and_shapes_in_groups_stay_where_they_start():
    light = 'LightSource "point"\n'
    medium = 'MakeNamedMedium "m" "string type" "homogeneous"\n'
    group = 'ObjectBegin "o"\nShape "sphere"\nObjectEnd\nIdentity ObjectInstance "o"\n'
    made = read(view(), MOVE, light, medium, group)
    assert made.warnings == [
        "LightSource 'point' stays where it starts",
        "MakeNamedMedium 'homogeneous' stays where it starts",
        "Shape 'sphere' stays where it starts",
    ]
    assert made.scene["point-light"]["position"] == [-2, 0, 0]
    mlt.load_dict(made.scene)


def test_a_dark_scene_gets_a_sun_where_its_camera_starts():
    look = "ActiveTransform EndTime Translate 1 0 0 ActiveTransform All " + STILL
    still, moving = (read(view(look), 'Shape "sphere"').scene for look in (STILL, look))
    np.testing.assert_allclose(moving["sun"]["direction"], still["sun"]["direction"])
    mlt.load_dict(moving)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("ActiveTransform Never", "'Never' is not known; valid are: All, EndTime, StartTime"),
        ("TransformTimes 1 1", "should be later than the first"),
        ("ActiveTransform", "the file ends here"),
    ],
)
def test_mistakes_in_motion_are_named(text, message):
    with pytest.raises(mlt.SceneError, match=f"^a.pbrt:1: .*{message}"):
        read(text)
