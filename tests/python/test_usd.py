"""Stages of USD: which prims are there, where they are, and their copies."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt

pytest.importorskip("pxr", reason="needs pymlt[usd]")

from usd_files import converted, mesh, moved, written

LIB = (
    'class Xform "lib" { '
    + mesh(
        "double3 xformOp:translate = (1, 0, 0)\n"
        'uniform token[] xformOpOrder = ["xformOp:translate"]'
    )
    + mesh(name="other")
    + "}\n"
)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def of_type(made, kind: str) -> list[dict]:
    return [
        plugin for plugin in made.scene.values() if plugin != "scene" and plugin["type"] == kind
    ]


def test_transforms_are_chained_and_y_is_up():
    inner = mesh(moved(0, 0, 3))
    text = 'def Xform "a" { double xformOp:rotateX = 90\n double3 xformOp:scale = (2, 2, 2)\n'
    text += f'uniform token[] xformOpOrder = ["xformOp:scale", "xformOp:rotateX"]\n {inner} }}'
    # A quarter turn about x takes +z to -y, and a stage in which z is up has -y as our +z.
    for up, origin in (("Y", [0, -6, 0]), ("Z", [0, 0, 6])):
        square = converted(text, f'upAxis = "{up}"').scene["square"]
        np.testing.assert_allclose(square["to_world"][:3, 3], origin, atol=1e-12)
        assert np.linalg.det(square["to_world"]) == pytest.approx(8)


def test_what_is_hidden_or_no_part_of_a_render_is_left_out():
    hidden = {
        "invisible": 'token visibility = "invisible"',
        "guide": 'uniform token purpose = "guide"',
        "proxy": 'uniform token purpose = "proxy"',
    }
    text = "".join(
        f'def Xform "x{name}" {{ {how}\n {mesh(name=name)} }}\n' for name, how in hidden.items()
    )
    shown = converted(text + mesh(name="render", more='uniform token purpose = "render"')).scene
    assert {"invisible", "guide", "proxy", "render"} & shown.keys() == {"render"}


def test_what_is_invisible_stays_so_but_cameras_are_no_things_to_be_seen():
    again = mesh(name="below", more='uniform token purpose = "render"')
    rig = f'def Xform "rig" {{ token visibility = "invisible"\n def Camera "b" {{\n}}\n{again} }}'
    scene = converted(rig).scene
    assert "below" not in scene
    assert scene["b"]["type"] == "perspective"


def test_instances_share_a_group():
    copy = 'def "{}" (instanceable = true\n references = </lib>) {{ {} }}\n'
    made = converted(LIB + copy.format("one", "") + copy.format("two", moved(0, 7, 0)))
    (group,) = of_type(made, "shapegroup")
    assert [part["to_world"][0, 3] for part in group.values() if part != "shapegroup"] == [1, 0]
    places = [instance["to_world"][:3, 3].tolist() for instance in of_type(made, "instance")]
    assert places == [[0, 0, 0], [0, 7, 0]]
    assert not of_type(made, "mesh")


def test_points_are_copies_of_their_prototypes():
    text = f"""
def PointInstancer "points" {{
    rel prototypes = [</points/near>, </points/far>]
    int[] protoIndices = [0, 1, 0, 0]
    point3f[] positions = [(1, 0, 0), (2, 0, 0), (3, 0, 0), (4, 0, 0)]
    float3[] scales = [(1, 1, 1), (1, 1, 1), (2, 2, 2), (1, 1, 1)]
    int64[] invisibleIds = [3]
    def Xform "near" {{ {mesh(moved(0, 1, 0))} }}
    {mesh(name="far", more=moved(0, 0, -5))}
}}"""
    made = converted(text)
    assert len(of_type(made, "shapegroup")) == 1
    places = [instance["to_world"][:3] for instance in of_type(made, "instance")]
    assert len(places) == 2
    np.testing.assert_allclose(places[0], mlt.Transform.translate(1, 0, 0).matrix[:3])
    np.testing.assert_allclose(places[1][:, 3], [3, 0, 0])
    np.testing.assert_allclose(places[1][:, :3], 2 * np.eye(3))
    (lone,) = of_type(made, "mesh")
    np.testing.assert_allclose(lone["to_world"][:3, 3], [2, 0, -5])
    assert mlt.load_dict(made.scene).info()["triangles"] == 4


def test_an_instancer_within_an_instancer():
    inner = f"""
def PointInstancer "inner" {{
    rel prototypes = [</outer/inner/leaf>]
    int[] protoIndices = [0, 0]
    point3f[] positions = [(1, 0, 0), (2, 0, 0)]
    {mesh(name="leaf")}
}}"""
    made = converted(f"""
def PointInstancer "outer" {{
    rel prototypes = [</outer/inner>]
    int[] protoIndices = [0, 0]
    point3f[] positions = [(0, 10, 0), (0, 20, 0)]
    {inner}
}}""")
    places = [instance["to_world"][:2, 3].tolist() for instance in of_type(made, "instance")]
    assert places == [[1, 10], [2, 10], [1, 20], [2, 20]]


def test_copies_are_placed_before_their_instancer():
    made = converted(f"""
def PointInstancer "points" {{
    rel prototypes = [</points/leaf>]
    int[] protoIndices = [0, 0]
    point3f[] positions = [(0, 1, 0), (0, 2, 0)]
    double3 xformOp:scale = (3, 3, 3)
    uniform token[] xformOpOrder = ["xformOp:scale"]
    {mesh(name="leaf")}
}}""")
    places = [instance["to_world"][:2, 3].tolist() for instance in of_type(made, "instance")]
    assert places == [[0, 3], [0, 6]]


def test_what_is_scaled_to_nothing_is_left_out():
    flat = 'double3 xformOp:scale = (0, 0, 0)\nuniform token[] xformOpOrder = ["xformOp:scale"]'
    made = converted(mesh(flat) + mesh(name="there"))
    assert "square" not in made.scene
    assert "there" in made.scene
    assert "what is scaled to nothing is left out" in made.warnings


def test_what_contradicts_itself_is_named():
    text = 'def Cone "pile" { double height = 0\n double radius = 0\n}'
    with pytest.raises(mlt.SceneError, match=r"^a\.usda: /pile: contradicts itself: Floating"):
        converted(text)
    with pytest.raises(mlt.SceneError, match=r"^a\.usda: /square: its transform has numbers that"):
        converted(mesh(moved(0, float("inf"), 0)))


def test_a_camera_sees_what_usd_says_it_does():
    text = """
def Camera "lens" {
    float horizontalAperture = 36
    float verticalAperture = 24
    float focalLength = 50
    float fStop = 2
    float focusDistance = 7
}
def Camera "flat" {
    token projection = "orthographic"
    float horizontalAperture = 40
    float verticalAperture = 20
}"""
    scene = converted(text + mesh()).scene
    lens, flat = scene["lens"], scene["flat"]
    assert scene["camera"]["fov"] == pytest.approx(np.degrees(2 * np.arctan(0.5)))
    assert (scene["camera"]["film"]["width"], scene["camera"]["film"]["height"]) == (960, 720)
    assert lens["type"] == "thinlens"
    assert lens["fov"] == pytest.approx(np.degrees(2 * np.arctan(0.36)))
    assert lens["aperture_radius"] == pytest.approx(5 / 2 / 2)
    assert lens["focus_distance"] == 7
    assert flat["film"]["width"] == 2 * flat["film"]["height"]
    np.testing.assert_allclose(flat["to_world"], np.diag([-2, 2, -1, 1]), atol=1e-12)


def test_an_aperture_that_is_moved_to_the_right_shows_more_of_the_right():
    ball = 'def Sphere "ball" { double radius = 0.3\n' + moved(1.2, 0.9, 0) + "}"
    offsets = "float horizontalApertureOffset = 4.8\n float verticalApertureOffset = 3.6"
    text = (
        ball
        + f"""
def Camera "moved" {{ {moved(0, 0, 5)}
    float horizontalAperture = 20
    float verticalAperture = 15
    float focalLength = 20
    {offsets}
}}"""
    )
    scene = mlt.load_dict(converted(text).scene, size=(40, 30), sensor=1)
    image = mlt.render(scene, "path", spp=16, seed=1).sum(axis=2)
    covered = abs(image - image[0, 0]) > 0.05
    rows, columns = np.nonzero(covered)
    assert np.mean(columns) == pytest.approx(19.5, abs=0.7)
    assert np.mean(rows) == pytest.approx(14.5, abs=0.7)


def test_xml_says_the_same():
    made = converted(LIB + 'def "a" (references = </lib>) {}\n def Sphere "s" {}')
    assert mlt.convert("a.usda", "a.xml") == made.placed_warnings("a.usda")
    scenes = mlt.load_file("a.xml", size=(32, 24)), mlt.load_dict(made.scene, size=(32, 24))
    images = [mlt.render(scene, "path", spp=4, seed=1) for scene in scenes]
    np.testing.assert_allclose(*images, rtol=1e-4, atol=1e-5)


def test_files_that_are_not_there_are_all_named():
    written('def "a" (references = @b.usda@) {}\n def "c" (payload = @d/e.usdc@) {}')
    with pytest.raises(mlt.FileError) as error:
        mlt.load("a.usda")
    absent = "there is no such file"
    assert str(error.value) == f"a.usda: b.usda: {absent}; d/e.usdc: {absent}"


@pytest.mark.parametrize("name", ["a.usda", "a.usdc", "a.usdz", "a.usd"])
def test_what_is_no_usd_file_is_refused_in_one_line(name, capfd):
    Path(name).write_text("nothing of the kind")
    with pytest.raises(mlt.SceneError, match=rf"^{name}: this is no USD file: .*") as error:
        mlt.load(name)
    assert "\n" not in str(error.value)
    assert capfd.readouterr().err == ""


def test_files_that_are_no_files_are_refused():
    os.mkfifo("pipe.usda")
    Path("folder.usdc").mkdir()
    with open("large.usda", "wb") as file:
        file.truncate(2**40)
    for name, said in (
        ("pipe.usda", "it is not a regular file"),
        ("folder.usdc", "it is a folder"),
        ("large.usda", "it has more than 268435456 bytes"),
    ):
        with pytest.raises(mlt.FileError, match=f"^{name}: cannot read it: {said}"):
            mlt.load(name)


WRONG = {
    "int[] faceVertexCounts = [5]": "add up to 5, but should to the 4",
    "int[] faceVertexIndices = [0, 1, 2, 9]": "a face has a point that does not exist",
    "normal3f[] normals = [(0, 0, 1)]": "has 1 values, but should have 4",
}


@pytest.mark.parametrize("line", WRONG)
def test_a_mesh_that_contradicts_itself_is_named(line):
    kept = [old for old in mesh(line).splitlines() if old.split("=")[0].split() != line.split()[:2]]
    text = "\n".join(kept if line in kept else [*kept[:-2], line, "}"])
    with pytest.raises(mlt.SceneError, match=f"^a.usda: /square: .*{WRONG[line]}"):
        converted(text)


def test_the_extra_is_named_where_it_lacks(monkeypatch):
    written("")
    monkeypatch.setitem(sys.modules, "pxr.Usd", None)
    with pytest.raises(mlt.UsageError, match="reading USD needs `pip install 'usd-core"):
        mlt.load("a.usda")


def test_the_settings_of_a_stage_say_which_camera_and_size():
    text = """
def Camera "other" {
    float horizontalAperture = 20
    float verticalAperture = 10
    float focalLength = 20
}
def RenderSettings "settings" {
    rel camera = </other>
    uniform int2 resolution = (SIZE)
}
"""
    head = 'renderSettingsPrimPath = "/settings"'
    scene = converted(text.replace("SIZE", "300, 100"), head).scene
    assert next(plugin for plugin in scene.values() if plugin != "scene") is scene["other"]
    assert (scene["other"]["film"]["width"], scene["other"]["film"]["height"]) == (300, 100)
    # The aperture is 2 wide and 1 high before a focal length of 2: it becomes wider.
    assert scene["other"]["fov_axis"] == "y"
    assert scene["other"]["fov"] == pytest.approx(np.degrees(2 * np.arctan(0.25)))
    scene = converted(text.replace("SIZE", "100, 100"), head).scene
    assert scene["other"]["fov_axis"] == "x"
    assert scene["other"]["fov"] == pytest.approx(np.degrees(2 * np.arctan(0.5)))


def test_skeletons_pose_what_they_hold():
    skin = mesh(
        """
    rel skel:skeleton = </root/bones>
    int[] primvars:skel:jointIndices = [0, 0, 0, 0] (interpolation = "vertex"\nelementSize = 1)
    float[] primvars:skel:jointWeights = [1, 1, 1, 1] (interpolation = "vertex"\nelementSize = 1)
""",
        head='(prepend apiSchemas = ["SkelBindingAPI"])',
    )
    unit = "( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )"
    text = f"""
def SkelRoot "root" {{
    def Skeleton "bones" (prepend apiSchemas = ["SkelBindingAPI"]) {{
        uniform token[] joints = ["a"]
        uniform matrix4d[] bindTransforms = [{unit}]
        uniform matrix4d[] restTransforms = [{unit}]
        rel skel:animationSource = </root/bones/walk>
        def SkelAnimation "walk" {{
            uniform token[] joints = ["a"]
            float3[] translations.timeSamples = {{ 0: [(0, 0, 0)], 10: [(10, 0, 0)] }}
            quatf[] rotations = [(1, 0, 0, 0)]
            half3[] scales = [(1, 1, 1)]
        }}
    }}
    {skin}
}}
"""
    square = converted(text, "startTimeCode = 4\nendTimeCode = 8").scene["square"]
    np.testing.assert_allclose(square["vertices"].mean(axis=0), [4, 0, 0], atol=1e-5)
    assert Path("a.usda").read_text().count("translations") == 1


def test_a_package_holds_its_images():
    from pxr import UsdUtils

    image = np.full((4, 8, 3), 0.25, np.float32)
    mlt.write_image("sky.exr", image)
    sky = 'def DomeLight "sky" {\n asset inputs:texture:file = @sky.exr@\n}\n'
    written(sky)
    assert UsdUtils.CreateNewUsdzPackage("a.usda", "b.usdz")
    Path("sky.exr").unlink()
    scene = mlt.load("b.usdz", size=(8, 6))
    assert mlt.render(scene, "path", spp=64, seed=1).mean() == pytest.approx(0.25, rel=0.03)
    assert mlt.convert("b.usdz", "c.xml") == []
    assert mlt.load("c.xml").info()["emitters"] == 1


def test_copies_of_copies_are_not_too_many(monkeypatch):
    from pymlt.formats.usd import reader

    zeros, places = ", ".join(["0"] * 10), ", ".join(["(0, 0, 0)"] * 10)
    inner = "".join(
        f"""
def PointInstancer "level{level}" {{
    rel prototypes = [</library/level{level - 1}>]
    int[] protoIndices = [{zeros}]
    point3f[] positions = [{places}]
}}
"""
        for level in range(1, 5)
    )
    library = (
        f'def Xform "library" {{ token visibility = "invisible"\n {mesh(name="level0")} {inner} }}'
    )
    top = '\ndef "top" (references = </library/level4>) {}\n'
    assert len(of_type(converted(library + top), "instance")) == 10**4
    monkeypatch.setattr(reader, "COPIES", 11000)
    with pytest.raises(mlt.SceneError, match=r"^a\.usda: there are more than 11000 copies"):
        converted(library + top)
