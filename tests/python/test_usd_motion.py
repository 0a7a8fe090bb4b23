"""Motion of USD: transforms while the shutter of a camera is open."""

from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt

pytest.importorskip("pxr", reason="needs pymlt[usd]")

from usd_files import converted, mesh, moved

from pymlt.formats.files import read_foreign

SHUTTER = """
def Camera "shot" {
    double shutter:open = -0.25
    double shutter:close = 0.25
}
"""
PUSHED = """
    double3 xformOp:translate.timeSamples = { 10: (0, 0, 0), 14: (4, 0, 0), 18: (4, 8, 0) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
"""
RANGE = "startTimeCode = 12\nendTimeCode = 20"


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_without_a_shutter_all_is_as_it_is_at_the_start():
    scene = converted(mesh(PUSHED), RANGE).scene
    np.testing.assert_allclose(scene["square"]["to_world"][:3, 3], [2, 0, 0])
    np.testing.assert_allclose(converted(mesh(PUSHED)).scene["square"]["to_world"][:3, 3], 0)


def test_what_moves_while_a_shutter_is_open_has_an_animation():
    scene = converted(SHUTTER + mesh(PUSHED) + mesh(name="still"), RANGE).scene
    motion = dict(scene["square"]["to_world"])
    assert motion.pop("type") == "animation"
    assert min(motion) == -0.25
    assert max(motion) == 0.25
    for time, matrix in motion.items():
        np.testing.assert_allclose(matrix[:3, 3], [2 + time, 0, 0])
    assert scene["still"]["to_world"].shape == (4, 4)
    assert (scene["shot"]["shutter_open"], scene["shot"]["shutter_close"]) == (-0.25, 0.25)
    assert "shutter_open" not in scene["camera"]


def test_a_wheel_goes_around_its_axle():
    turning = """
    double xformOp:rotateZ.timeSamples = { 12: 0, 13: 360 }
    uniform token[] xformOpOrder = ["xformOp:rotateZ"]
"""
    text = f"""
def Xform "axle" {{ {turning}
    {mesh(moved(2, 0, 0))}
}}
"""
    motion = converted(SHUTTER + text, RANGE).scene["square"]["to_world"]
    for time in (-0.25, 0, 0.25):
        angle = 2 * np.pi * max(time, 0)
        np.testing.assert_allclose(
            motion[time][:2, 3], [2 * np.cos(angle), 2 * np.sin(angle)], atol=1e-9
        )


def test_cameras_lights_and_copies_move_too():
    text = f"""
def Xform "all" {{ {PUSHED}
    def Camera "moving" {{
    }}
    def SphereLight "lamp" {{
    }}
    def DistantLight "sun" {{
        float inputs:angle = 0
    }}
    def PointInstancer "points" {{
        rel prototypes = [</all/points/leaf>]
        int[] protoIndices = [0, 0]
        point3f[] positions = [(0, 1, 0), (0, 2, 0)]
        {mesh(name="leaf")}
    }}
}}
"""
    made = converted(SHUTTER + text, RANGE)
    for name, height in (("moving", 0), ("lamp", 0), ("points-leaf", 1), ("points-leaf_2", 2)):
        motion = made.scene[name]["to_world"]
        np.testing.assert_allclose(motion[0.25][:3, 3], [2.25, height, 0], atol=1e-9)
    assert made.scene["sun"]["to_world"].shape == (4, 4)
    assert "lights at infinity do not move: they are as the shutter opens" in made.warnings


def test_what_moves_is_blurred_alike_as_xml():
    lit = 'def DomeLight "sky" {\n}\n'
    converted(SHUTTER.replace("shot", "a") + lit + mesh(PUSHED), RANGE)
    text = (
        Path("a.usda")
        .read_text()
        .replace(
            'def Camera "a" {',
            'def Camera "a" {\n'
            "double3 xformOp:translate = (2, 0, 5)\n"
            'uniform token[] xformOpOrder = ["xformOp:translate"]',
        )
    )
    Path("b.usda").write_text(text)
    assert mlt.convert("b.usda", "b.xml") == []
    options = {"size": (32, 24), "sensor": 1}
    given = mlt.load_dict(read_foreign("b.usda").scene, **options)
    images = [
        mlt.render(scene, "path", spp=4, seed=1)
        for scene in (given, mlt.load_file("b.xml", **options))
    ]
    np.testing.assert_allclose(*images, rtol=1e-4, atol=1e-5)
    still = mlt.load_dict(read_foreign("b.usda").scene, size=(32, 24), sensor=0)
    assert still.info()["shapes"] == 1
