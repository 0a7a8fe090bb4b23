"""Materials of USD: UsdPreviewSurface, open_pbr_surface, their images and texture coordinates."""

import numpy as np
import pytest

import pymlt as mlt

pytest.importorskip("pxr", reason="needs pymlt[usd]")

from usd_files import converted, mesh, written

UVS = 'texCoord2f[] primvars:{} = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")\n'
BOUND = "rel material:binding = </paint>\n"
HEAD = '(prepend apiSchemas = ["MaterialBindingAPI"])'
PIXELS = np.array([[[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]], [[0.7, 0.8, 0.9], [1, 0, 0.5]]], np.float32)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def material(inputs: str, others: str = "", kind: str = "UsdPreviewSurface") -> str:
    return f"""
def Material "paint" {{
    token outputs:surface.connect = </paint/surface.outputs:surface>
    def Shader "surface" {{
        uniform token info:id = "{kind}"
        {inputs}
        token outputs:surface
    }}
    {others}
}}
"""


def texture(settings: str = "", file: str = "a.exr", name: str = "image") -> str:
    return f"""
    def Shader "{name}" {{
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @{file}@
        {settings}
        float3 outputs:rgb
        float outputs:r
        float outputs:g
        float outputs:a
    }}
"""


def painted(inputs: str, others: str = "", kind: str = "UsdPreviewSurface", uv: str = "st"):
    square = mesh(UVS.format(uv) + BOUND, head=HEAD)
    return converted(material(inputs, others, kind) + square)


def surface(inputs: str, others: str = "", kind: str = "UsdPreviewSurface") -> dict:
    """The BSDF within `twosided`."""
    return painted(inputs, others, kind).scene["paint"]["bsdf"]


DIFFUSE = "color3f inputs:diffuseColor.connect = </paint/image.outputs:rgb>"
ROUGH = "float inputs:roughness.connect = </paint/image.outputs:g>"


def test_numbers_and_colours():
    made = painted("""
    color3f inputs:diffuseColor = (0.25, 0.5, 0.75)
    float inputs:metallic = 0.5
    float inputs:roughness = 0.25
    float inputs:ior = 1.25
    float inputs:clearcoat = 0.75
    float inputs:clearcoatRoughness = 0.125
""")
    assert made.scene["square"]["bsdf"] == {"type": "ref", "id": "paint"}
    assert made.scene["paint"] == {
        "type": "twosided",
        "bsdf": {
            "type": "openpbr",
            "base_color": {"type": "rgb", "value": [0.25, 0.5, 0.75]},
            "base_metalness": 0.5,
            "specular_roughness": 0.25,
            "specular_ior": 1.25,
            "coat_weight": 0.75,
            "coat_roughness": 0.125,
            "coat_ior": 1.5,
            "coat_darkening": 0.0,
        },
    }
    assert made.warnings == ["there is no light; an even sky and a sun are added"]


def test_what_a_material_does_not_say_is_what_usd_says():
    found = surface("")
    assert found["base_color"]["value"] == pytest.approx([0.18] * 3)
    assert (found["specular_roughness"], found["base_metalness"]) == (0.5, 0)


def test_an_image_is_a_bitmap_whose_rows_are_where_usd_has_them():
    mlt.write_image("a.exr", PIXELS)
    made = painted(DIFFUSE, texture())
    bitmap = made.scene["paint"]["bsdf"]["base_color"]
    assert bitmap.keys() == {"type", "filename"}
    np.testing.assert_allclose(made.scene["square"]["uv"], [[0, 1], [1, 1], [1, 0], [0, 0]])


def test_scale_and_bias():
    mlt.write_image("a.exr", PIXELS)
    scaled = surface(DIFFUSE, texture("float4 inputs:scale = (2, 1, 0.5, 1)"))["base_color"]
    assert scaled["scale"]["value"] == [2, 1, 0.5]
    assert scaled["texture"]["type"] == "bitmap"
    both = "float4 inputs:scale = (0.5, 0.5, 0.5, 1)\nfloat4 inputs:bias = (0.5, 0.25, 0, 0)"
    found = surface(DIFFUSE, texture(both))["base_color"]
    np.testing.assert_allclose(found["data"], PIXELS / 2 + [0.5, 0.25, 0], rtol=1e-3)
    grey = surface(ROUGH, texture("float4 inputs:scale = (0, 0.5, 0, 0)"))["specular_roughness"]
    np.testing.assert_allclose(grey["data"], PIXELS[..., 1] / 2, rtol=1e-3)
    assert grey["raw"]


def test_a_colour_of_one_channel_is_a_grey_image():
    mlt.write_image("a.exr", np.tile(PIXELS, (1, 4, 1)))
    found = surface(DIFFUSE.replace("outputs:rgb", "outputs:r"), texture())["base_color"]
    np.testing.assert_allclose(found["data"], np.tile(PIXELS[..., 0], (1, 4)), rtol=1e-3)


def test_values_that_no_surface_has_are_cut_off():
    made = painted("color3f inputs:diffuseColor = (2, 0.5, -1)\nfloat inputs:roughness = 3")
    found = made.scene["paint"]["bsdf"]
    assert found["base_color"]["value"] == [1, 0.5, 0]
    assert found["specular_roughness"] == 1
    assert "values of 'diffuseColor' outside of 0 to 1 are cut off" in made.warnings
    bright = painted("color3f inputs:emissiveColor = (-1, 5, 0)")
    assert bright.scene["square"]["emitter"]["radiance"]["value"] == [0, 5, 0]
    assert "values of 'emissiveColor' below 0 are cut off" in bright.warnings


def test_the_colour_space_of_images():
    mlt.write_image("a.png", PIXELS)
    encoded = mlt.read_image("a.png")
    for space, expected in (("sRGB", encoded), ("auto", encoded), ("raw", None)):
        given = texture(f'token inputs:sourceColorSpace = "{space}"', "a.png")
        found = surface(ROUGH, given)["specular_roughness"]["data"]
        if expected is None:
            steps = found * 255
            np.testing.assert_allclose(steps, np.round(steps), atol=1e-3)
            assert found[0, 0] > encoded[0, 0, 1] + 0.1
        else:
            np.testing.assert_allclose(found, expected[..., 1], atol=1e-6)
        assert surface(DIFFUSE, given)["base_color"].get("raw", False) == (space == "raw")


READER = """
    def Shader "turn" {
        uniform token info:id = "UsdTransform2d"
        float2 inputs:in.connect = </paint/reader.outputs:result>
        float inputs:rotation = 90
        float2 inputs:scale = (2, 3)
        float2 inputs:translation = (0.5, 0.25)
        float2 outputs:result
    }
    def Shader "reader" {
        uniform token info:id = "UsdPrimvarReader_float2"
        string inputs:varname.connect = </paint.inputs:uv>
        float2 outputs:result
    }
"""


def test_texture_coordinates_and_their_transform():
    mlt.write_image("a.exr", PIXELS)
    image = texture("""
        float2 inputs:st.connect = </paint/turn.outputs:result>
        token inputs:wrapS = "clamp"
        token inputs:wrapT = "mirror"
""")
    text = material(DIFFUSE, image + READER).replace(
        'def Material "paint" {', 'def Material "paint" {\n    string inputs:uv = "map"', 1
    )
    square = mesh(UVS.format("map") + BOUND, head=HEAD)
    scene = converted(text + square).scene
    bitmap = scene["paint"]["bsdf"]["base_color"]
    assert (bitmap["wrap_mode_u"], bitmap["wrap_mode_v"]) == ("clamp", "mirror")
    # The corner (1, 1) becomes (2, 3), (-3, 2), (-2.5, 2.25); rows are counted from above here.
    corner = np.append(scene["square"]["uv"][2], [0, 1])
    np.testing.assert_allclose((bitmap["to_uv"] @ corner)[:2], [-2.5, 1 - 2.25], atol=1e-9)


def test_opacity():
    mlt.write_image("a.exr", np.concatenate([PIXELS, PIXELS[..., :1]], axis=2))
    alpha = "float inputs:opacity.connect = </paint/image.outputs:a>\n"
    soft = painted(alpha, texture()).scene["paint"]
    assert soft["type"] == "mask"
    assert soft["bsdf"]["type"] == "twosided"
    np.testing.assert_allclose(soft["opacity"]["data"], PIXELS[..., 0], rtol=1e-3)
    cut = painted(alpha + "float inputs:opacityThreshold = 0.5", texture()).scene["paint"]
    np.testing.assert_allclose(cut["opacity"]["data"], PIXELS[..., 0] >= 0.5)
    thin = painted("float inputs:opacity = 0.25").scene["paint"]
    assert (thin["transmission_weight"], thin["geometry_thin_walled"]) == (0.75, True)
    presence = 'float inputs:opacity = 0.25\ntoken inputs:opacityMode = "presence"'
    assert painted(presence).scene["paint"]["opacity"] == 0.25


def test_what_glows():
    made = painted("color3f inputs:emissiveColor = (1, 2, 3)")
    emitter = {"type": "area", "radiance": {"type": "rgb", "value": [1, 2, 3]}}
    assert made.scene["square"]["emitter"] == emitter
    assert "emitter" not in painted("color3f inputs:emissiveColor = (0, 0, 0)").scene["square"]


def test_normals():
    mlt.write_image("a.exr", PIXELS)
    normal = "normal3f inputs:normal.connect = </paint/image.outputs:rgb>"
    usual = "float4 inputs:scale = (2, 2, 2, 1)\nfloat4 inputs:bias = (-1, -1, -1, 0)"
    bent = painted(normal, texture(usual)).scene["paint"]["bsdf"]
    assert bent["type"] == "normalmap"
    assert bent["normalmap"]["raw"]
    assert "filename" in bent["normalmap"]
    plain = painted(normal, texture()).scene["paint"]["bsdf"]["normalmap"]
    np.testing.assert_allclose(plain["data"], (PIXELS + 1) / 2, rtol=1e-3)


@pytest.mark.parametrize("colour", [0.04, 0.2])
def test_a_specular_colour_is_an_index_of_refraction(colour):
    found = surface(f"""
    int inputs:useSpecularWorkflow = 1
    color3f inputs:specularColor = ({colour}, {colour}, {colour})
    float inputs:metallic = 1
""")
    index = found["specular_ior"]
    assert ((index - 1) / (index + 1)) ** 2 == pytest.approx(colour)
    assert "base_metalness" not in found


def test_a_specular_colour_that_no_dielectric_has_is_a_metal():
    inputs = "int inputs:useSpecularWorkflow = 1\ncolor3f inputs:specularColor = (0.9, 0.5, 0.1)"
    made = painted(inputs)
    found = made.scene["paint"]["bsdf"]
    assert found["base_metalness"] == 1
    assert found["base_color"]["value"] == pytest.approx([0.9, 0.5, 0.1])
    assert (
        "materials with a 'specularColor' above 0.25 become metals of that colour" in made.warnings
    )


def test_colours_of_vertices_in_a_material():
    reader = """
    def Shader "image" {
        uniform token info:id = "UsdPrimvarReader_float3"
        string inputs:varname = "displayColor"
        float3 outputs:rgb
    }
"""
    text = material(DIFFUSE, reader)
    colours = 'color3f[] primvars:displayColor = [(1, 0, 0)] (interpolation = "uniform")\n'
    scene = converted(text + mesh(colours + BOUND, head=HEAD)).scene
    assert scene["paint"]["bsdf"]["base_color"]["type"] == "mesh_attribute"
    np.testing.assert_allclose(scene["square"]["vertex_color"], [[1, 0, 0]] * 4)


def test_subsets_have_materials_of_their_own():
    subset = f"""
    def GeomSubset "half" {HEAD} {{
        uniform token elementType = "face"
        uniform token familyName = "materialBind"
        int[] indices = [1]
        {BOUND}
    }}
"""
    text = mesh(subset).replace("[4]", "[3, 3]").replace("[0, 1, 2, 3]", "[0, 1, 2, 0, 2, 3]")
    scene = converted(material("") + text).scene
    bare, covered = scene["square"], scene["square_2"]
    if bare["bsdf"]["type"] == "ref":
        bare, covered = covered, bare
    assert covered["bsdf"] == {"type": "ref", "id": "paint"}
    assert bare["bsdf"]["bsdf"]["type"] == "diffuse"
    np.testing.assert_allclose(covered["vertices"], [[-1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    assert len(bare["faces"]) == len(covered["faces"]) == 1


OPEN_PBR = "ND_open_pbr_surface_surfaceshader"


def test_open_pbr_has_the_same_names():
    made = painted(
        """
    float inputs:base_weight = 0.5
    color3f inputs:base_color = (0.1, 0.2, 0.3)
    float inputs:specular_ior = 1.25
    float inputs:coat_weight = 0.75
    color3f inputs:transmission_scatter = (1, 0.5, 0.25)
    float inputs:emission_luminance = 10
    color3f inputs:emission_color = (1, 0.5, 0)
    float inputs:geometry_opacity = 0.5
    bool inputs:geometry_thin_walled = 1
""",
        kind=OPEN_PBR,
    )
    paint = made.scene["paint"]
    assert (paint["type"], paint["opacity"]) == ("mask", 0.5)
    found = paint["bsdf"]["bsdf"]
    assert found["base_color"].pop("value") == pytest.approx([0.1, 0.2, 0.3])
    assert found == {
        "type": "openpbr",
        "base_weight": 0.5,
        "base_color": {"type": "rgb"},
        "specular_ior": 1.25,
        "coat_weight": 0.75,
        "transmission_scatter": {"type": "rgb", "value": [1, 0.5, 0.25]},
        "geometry_thin_walled": True,
    }
    assert made.scene["square"]["emitter"]["radiance"]["value"] == [10, 5, 0]


def test_glass_has_one_side():
    paint = painted("float inputs:transmission_weight = 1", kind=OPEN_PBR).scene["paint"]
    assert paint == {"type": "openpbr", "transmission_weight": 1.0}


def test_images_of_materialx():
    mlt.write_image("a.png", PIXELS)
    image = """
    def Shader "image" {
        uniform token info:id = "ND_tiledimage_color3"
        asset inputs:file = @a.png@ (colorSpace = "srgb_texture")
        float2 inputs:uvtiling = (2, 3)
        color3f outputs:out
    }
"""
    inputs = "color3f inputs:base_color.connect = </paint/image.outputs:out>"
    bitmap = surface(inputs, image, OPEN_PBR)["base_color"]
    assert bitmap["filename"].endswith("a.png")
    assert "raw" not in bitmap
    np.testing.assert_allclose(bitmap["to_uv"] @ [0, 1, 0, 1], [0, 1, 0, 1])
    np.testing.assert_allclose(bitmap["to_uv"] @ [0.5, 1, 0, 1], [1, 1, 0, 1])
    plain = surface(inputs, image.replace(' (colorSpace = "srgb_texture")', ""), OPEN_PBR)
    assert plain["base_color"]["raw"]


def test_what_is_not_read_is_named():
    disney = painted("", kind="ND_disney_principled")
    said = "materials made of 'ND_disney_principled' are left out: they become grey"
    assert said in disney.warnings
    assert disney.scene["square"]["bsdf"]["bsdf"]["type"] == "diffuse"
    noise = 'def Shader "image" {\nuniform token info:id = "ND_noise"\nfloat3 outputs:rgb\n}\n'
    assert "shaders of the kind 'ND_noise' are left out" in painted(DIFFUSE, noise).warnings
    deep = painted("float inputs:displacement = 1")
    assert "displacement is left out" in deep.warnings


def test_missing_images_are_named():
    inputs = DIFFUSE + "\n" + ROUGH.replace("/image", "/other")
    others = texture(file="no.png") + texture(file="neither.png", name="other")
    with pytest.raises(mlt.FileError) as error:
        painted(inputs, others)
    assert {text.split(": ")[-2] for text in str(error.value).split("; ")} == {
        "no.png",
        "neither.png",
    }


def test_texture_coordinates_of_materialx():
    """As Blender writes them: scale, rotate about z, move."""
    mlt.write_image("a.png", PIXELS)

    def node(name: str, kind: str, source: str, more: str = "", width: str = "float3") -> str:
        return f"""
    def Shader "{name}" {{
        uniform token info:id = "ND_{kind}"
        {source}
        {more}
        {width} outputs:out
    }}
"""

    def after(name: str, place: str = "in") -> str:
        return f"float3 inputs:{place}.connect = </paint/{name}.outputs:out>"

    others = node("uv", "texcoord_vector2", "")
    others += node("wide", "convert_vector2_vector3", after("uv"))
    others += node(
        "scaled", "multiply_vector3", after("wide", "in1"), "float3 inputs:in2 = (2, 3, 1)"
    )
    turn = "float inputs:amount = 90\nfloat3 inputs:axis = (0, 0, 1)"
    others += node("turned", "rotate3d_vector3", after("scaled"), turn)
    others += node(
        "moved", "add_vector3", after("turned", "in1"), "float3 inputs:in2 = (0.5, 0, 0)"
    )
    image = "asset inputs:file = @a.png@\n" + after("moved", "texcoord")
    others += node("picture", "image_color4", image)
    others += node("image", "convert_color4_color3", after("picture"))
    inputs = "color3f inputs:base_color.connect = </paint/image.outputs:out>"
    made = painted(inputs, others, OPEN_PBR)
    to_uv = made.scene["paint"]["bsdf"]["base_color"]["to_uv"]
    # The corner (1, 1) becomes (2, 3), (-3, 2), (-2.5, 2); rows are counted from above here.
    np.testing.assert_allclose((to_uv @ [1, 0, 0, 1])[:2], [-2.5, -1], atol=1e-6)
    assert made.warnings == ["there is no light; an even sky and a sun are added"]
    skew = others.replace("(0, 0, 1)", "(0, 1, 0)")
    said = "texture coordinates of the kind 'ND_rotate3d_vector3' are left out"
    assert said in painted(inputs, skew, OPEN_PBR).warnings


SKY = 'def DomeLight "sky" {\n}\n'
BLACK = "color3f inputs:diffuseColor = (0, 0, 0)\nfloat inputs:ior = 1\n"


def seen(inputs: str, others: str = "") -> np.ndarray:
    """The middle of a square below a sky of radiance 1, as a file and as the XML made of it."""
    square = mesh(UVS.format("st") + BOUND, head=HEAD)
    written(SKY + material(inputs, others) + square)
    assert mlt.convert("a.usda", "a.xml") == []
    scenes = [mlt.load(name, size=(32, 24)) for name in ("a.usda", "a.xml")]
    images = [mlt.render(scene, "path", spp=64, seed=1) for scene in scenes]
    np.testing.assert_allclose(*images, rtol=1e-4, atol=1e-5)
    return images[0][10:14, 14:18].mean(axis=(0, 1))


def test_what_lets_light_through_shows_the_sky_behind_it():
    assert seen(BLACK) == pytest.approx([0] * 3, abs=0.01)
    assert seen(BLACK + "float inputs:opacity = 0.25") == pytest.approx([0.75] * 3, rel=0.03)
    presence = 'float inputs:opacity = 0.25\ntoken inputs:opacityMode = "presence"'
    assert seen(BLACK + presence) == pytest.approx([0.75] * 3, rel=0.03)


def test_a_matte_surface_has_its_colour():
    matte = BLACK.replace("(0, 0, 0)", "(0.2, 0.4, 0.8)") + "float inputs:roughness = 1"
    assert seen(matte) == pytest.approx([0.2, 0.4, 0.8], rel=0.03)


def test_an_image_colours_a_surface():
    mlt.write_image("a.exr", np.full((4, 4, 3), [0.2, 0.4, 0.8], np.float32))
    textured = DIFFUSE + "\nfloat inputs:ior = 1"
    assert seen(textured, texture()) == pytest.approx([0.2, 0.4, 0.8], rel=0.03)


def test_a_metal_reflects_the_sky_in_its_colour():
    metal = "color3f inputs:diffuseColor = (0.9, 0.6, 0.3)\nfloat inputs:metallic = 1\n"
    assert seen(metal + "float inputs:roughness = 0.1") == pytest.approx([0.9, 0.6, 0.3], rel=0.03)
