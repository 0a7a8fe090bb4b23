"""Shaders of MaterialX in USD that become OpenPBR by the graphs of MaterialX."""

import sys
from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt
from pymlt.formats.files import read_foreign

pytest.importorskip("pxr", reason="needs pymlt[usd]")
pytest.importorskip("MaterialX", reason="needs pymlt[materialx]")

from test_usd_materials import BOUND, HEAD, PIXELS, UVS, material, painted
from usd_files import converted, mesh, written

STANDARD, GLTF = "ND_standard_surface_surfaceshader", "ND_gltf_pbr_surfaceshader"
BASE = "color3f inputs:base_color.connect = </paint/{}.outputs:out>"


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def node(name: str, kind: str, inputs: str, output: str = "color3f outputs:out") -> str:
    return f"""
    def Shader "{name}" {{
        uniform token info:id = "{kind}"
        {inputs}
        {output}
    }}
"""


def surface(inputs: str, others: str = "", kind: str = STANDARD, uv: str = "st") -> dict:
    """The BSDF within `twosided`."""
    made = painted(inputs, others, kind, uv)
    assert made.warnings == ["there is no light; an even sky and a sun are added"]
    mlt.load_dict(made.scene, size=(8, 6))
    return made.scene["paint"]["bsdf"]


SAME = {  # as USD and as MaterialX write it
    "color3f inputs:base_color = (0.25, 0.5, 0.75)": ("base_color", "color3", "0.25, 0.5, 0.75"),
    "float inputs:metalness = 0.5": ("metalness", "float", "0.5"),
    "float inputs:specular_roughness = 0.25": ("specular_roughness", "float", "0.25"),
    "float inputs:coat = 0.75": ("coat", "float", "0.75"),
    "float inputs:sheen = 0.5": ("sheen", "float", "0.5"),
    "float inputs:emission = 2": ("emission", "float", "2"),
}


def test_a_standard_surface_is_that_of_a_file_of_materialx():
    inputs = [f'<input name="{n}" type="{t}" value="{v}"/>' for n, t, v in SAME.values()]
    Path("a.mtlx").write_text(f"""<materialx version="1.39">
<standard_surface name="s" type="surfaceshader">{"".join(inputs)}</standard_surface>
<surfacematerial name="paint" type="material">
<input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial></materialx>""")
    expected = mlt.load_materials("a.mtlx")["paint"]
    made = painted("\n".join(SAME), kind=STANDARD)
    assert expected["bsdf"]["base_metalness"] == 0.5
    assert made.scene["paint"] == {"type": "twosided", "bsdf": expected["bsdf"]}
    assert made.scene["square"]["emitter"] == expected["emitter"]


def test_gltf_pbr_is_read_as_well():
    found = surface("float inputs:metallic = 0\nfloat inputs:clearcoat = 0.5", kind=GLTF)
    assert found["coat_weight"] == 0.5
    assert found["coat_ior"] == 1.5


def test_glass_and_holes():
    glass = painted("float inputs:transmission = 1", kind=STANDARD).scene["paint"]
    assert glass["type"] == "openpbr"
    assert glass["transmission_weight"] == 1
    hole = painted("color3f inputs:opacity = (0.5, 0.5, 0.5)", kind=STANDARD).scene["paint"]
    assert (hole["type"], hole["opacity"]) == ("mask", 0.5)
    assert "geometry_opacity" not in hole["bsdf"]["bsdf"]


IMAGE = 'asset inputs:file = @a.png@ (colorSpace = "srgb_texture")\n'


def test_an_image_is_a_bitmap_of_its_file():
    mlt.write_image("a.png", PIXELS)
    found = surface(BASE.format("image"), node("image", "ND_image_color3", IMAGE))["base_color"]
    assert found == {"type": "bitmap", "filename": str(Path("a.png").absolute())}


def test_nodes_are_computed():
    mlt.write_image("a.exr", PIXELS)
    half = "color3f inputs:in1.connect = </paint/image.outputs:out>\nfloat inputs:in2 = 0.5"
    others = node("image", "ND_image_color3", "asset inputs:file = @a.exr@")
    others += node("half", "ND_multiply_color3FA", half)
    found = surface(BASE.format("half"), others)["base_color"]
    np.testing.assert_allclose(found["data"], PIXELS / 2, atol=1e-3)


def test_texture_coordinates_have_the_name_that_the_network_gives():
    mlt.write_image("a.png", PIXELS)
    where = "float2 inputs:texcoord.connect = </paint/place.outputs:out>\n"
    others = node("image", "ND_image_color3", IMAGE + where)
    reader = 'string inputs:geomprop = "wide"'
    others += node("place", "ND_geompropvalue_vector2", reader, "float2 outputs:out")
    square = mesh(UVS.format("wide") + UVS.format("st").replace("1", "7") + BOUND, head=HEAD)
    written(material(BASE.format("image"), others, STANDARD) + square)
    with pytest.warns(UserWarning, match="no light"):
        scene = mlt.load("a.usda", size=(8, 6))
    found = scene.intersect([[0.5, 0.5, 5.0]], [[0.0, 0.0, -1.0]])
    assert found["uv"][0] == pytest.approx([0.75, 0.25], abs=1e-5)


def test_outputs_and_inputs_of_graphs_are_followed():
    split = "color3f inputs:in = (0.25, 0.5, 0.75)"
    outputs = "\n".join(f"float outputs:out{channel}" for channel in "rgb")
    others = node("split", "ND_separate3_color3", split, outputs)
    others += """
    def NodeGraph "graph" {
        float inputs:rough = 0.375
        float outputs:metal.connect = </paint/split.outputs:outb>
    }
"""
    inputs = "float inputs:metalness.connect = </paint/graph.outputs:metal>\n"
    inputs += "float inputs:specular_roughness.connect = </paint/graph.inputs:rough>"
    found = surface(inputs, others)
    assert found["base_metalness"] == pytest.approx(0.75)
    assert found["specular_roughness"] == pytest.approx(0.375)


@pytest.mark.parametrize("kind", ["ND_normalmap", "ND_normalmap_float"])
def test_normal_maps_of_old_and_new_versions(kind):
    mlt.write_image("a.png", PIXELS)
    image = node("image", "ND_image_vector3", "asset inputs:file = @a.png@", "float3 outputs:out")
    source = "float3 inputs:in.connect = </paint/image.outputs:out>"
    others = image + node("bent", kind, source, "float3 outputs:out")
    found = surface("float3 inputs:normal.connect = </paint/bent.outputs:out>", others)
    assert found["type"] == "normalmap"
    assert found["normalmap"]["raw"]
    assert found["normalmap"]["filename"].endswith("a.png")
    assert found["bsdf"]["type"] == "openpbr"


@pytest.mark.parametrize("computed", [False, True])
def test_images_within_a_package(computed):
    from pxr import UsdUtils

    mlt.write_image("a.png", PIXELS)
    others = node("image", "ND_image_color3", IMAGE)
    half = "color3f inputs:in1.connect = </paint/image.outputs:out>\nfloat inputs:in2 = 0.5"
    others += node("half", "ND_multiply_color3FA", half)
    inputs = BASE.format("half" if computed else "image")
    written(material(inputs, others, STANDARD) + mesh(UVS.format("st") + BOUND, head=HEAD))
    assert UsdUtils.CreateNewUsdzPackage("a.usda", "b.usdz")
    content = Path("a.png").read_bytes()
    Path("a.png").unlink()
    made = read_foreign("b.usdz")
    data = made.scene["paint"]["bsdf"]["base_color"]["data"]
    if computed:
        np.testing.assert_allclose(data, PIXELS / 2, atol=0.01)
    else:
        assert data == content


def test_missing_images_are_named():
    with pytest.raises(mlt.FileError, match=r"a\.png: "):
        painted(BASE.format("image"), node("image", "ND_image_color3", IMAGE), STANDARD)


CIRCLE = "color3f inputs:in.connect = </paint/odd.outputs:out>"
ODD = {
    "noise": (node("odd", "ND_noise3d_color3", ""), "the node 'noise3d' is not read"),
    "circle": (node("odd", "ND_dot_color3", CIRCLE), "or in a circle"),
}


@pytest.mark.parametrize("name", ODD)
def test_what_cannot_be_read_is_grey_with_a_warning(name):
    others, said = ODD[name]
    made = painted(BASE.format("odd"), others, STANDARD)
    assert made.scene["square"]["bsdf"]["bsdf"]["type"] == "diffuse"
    left_out = [text for text in made.warnings if "is left out" in text]
    assert len(left_out) == 1
    assert said in left_out[0]


def test_other_nodes_and_inputs_are_left_out_with_a_warning():
    inputs = BASE.format("odd") + "\nfloat inputs:sparkle = 1\nfloat inputs:metalness = 1"
    made = painted(inputs, node("odd", "ACME_wood", ""), STANDARD)
    assert "shaders of the kind 'ACME_wood' are left out" in made.warnings
    assert f"'sparkle' of '{STANDARD}' is left out" in made.warnings
    assert made.scene["paint"]["bsdf"]["base_metalness"] == 1


PREVIEW = """
    token outputs:surface.connect = </paint/plain.outputs:surface>
    def Shader "plain" {
        uniform token info:id = "UsdPreviewSurface"
        token outputs:surface
    }
"""


@pytest.mark.parametrize("beside", [False, True])
def test_without_the_package_it_says_what_to_install(beside, monkeypatch):
    monkeypatch.setitem(sys.modules, "MaterialX", None)
    text = material("", PREVIEW if beside else "", STANDARD)
    text = text.replace("outputs:surface.connect", "outputs:mtlx:surface.connect", 1)
    made = converted(text + mesh(BOUND, head=HEAD))
    said = [text for text in made.warnings if "needs `pip install" in text]
    assert len(said) == 1
    assert "materialx" in said[0]
    if beside:
        assert made.scene["paint"]["bsdf"]["type"] == "openpbr"
    else:
        assert made.scene["square"]["bsdf"]["bsdf"]["type"] == "diffuse"
