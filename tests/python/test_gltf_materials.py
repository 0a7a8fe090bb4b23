"""Extensions of glTF's materials and textures, with the values that their definitions give."""

import io

import numpy as np
import pytest

import pymlt as mlt

gl = pytest.importorskip("pygltflib", reason="needs pymlt[gltf]")

from gltf_files import GltfFile, converted  # noqa: E402

SIZE = (40, 30)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def painted(file: GltfFile, **material) -> dict:
    """The BSDF of a square's only material, without `twosided`, and what was warned of."""
    file.gltf.materials, file.gltf.nodes, file.gltf.scenes[0].nodes = [], [], []
    file.node(mesh=file.mesh(file.material(**material)))
    made = converted(file)
    surface = made.scene["material-0"]
    mlt.load_dict(made.scene, size=SIZE)
    return surface.get("bsdf", surface), made.warnings


# Each quarter of the image has its own colour; row 0 is at v = 0.
QUARTERS = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], np.uint8)
QUARTER_TURN = np.pi / 2
TRANSFORMS = {
    # The lower left quarter, turned clockwise (the specification's example).
    "example": ({"offset": [0, 1], "rotation": QUARTER_TURN, "scale": [0.5, 0.5]}, (0.3, 0.1)),
    "offset": ({"offset": [0.25, 0.5]}, (0.55, 0.6)),
    "scale": ({"scale": [2, 3]}, (0.6, 0.3)),
    "none": ({}, (0.3, 0.1)),
}
EXPECTED = {"example": (0.05, 0.85), "offset": (0.8, 1.1), "scale": (1.2, 0.9), "none": (0.3, 0.1)}


@pytest.mark.parametrize("name", TRANSFORMS)
def test_texture_coordinates_are_transformed(name):
    given, uv = TRANSFORMS[name]
    file = GltfFile()
    info = file.texture(QUARTERS)
    info.extensions = {"KHR_texture_transform": given}
    surface, warnings = painted(file, baseColorTexture=info)
    to_uv = surface["base_color"].get("to_uv", np.eye(4))
    np.testing.assert_allclose((to_uv @ [*uv, 0, 1])[:2], EXPECTED[name], atol=1e-12)
    assert not [text for text in warnings if "KHR_texture_transform" in text]


def test_a_transform_may_choose_other_coordinates_and_must_be_one():
    file = GltfFile()
    info = file.texture(QUARTERS)
    info.extensions = {"KHR_texture_transform": {"texCoord": 1}}
    assert "second texture coordinates" in " ".join(painted(file, baseColorTexture=info)[1])
    info.extensions = {"KHR_texture_transform": {"scale": [2]}}
    with pytest.raises(mlt.SceneError, match="scale has 1 numbers, but should have 2"):
        converted(file)


def test_unlit_materials_have_their_colour_in_any_light():
    file = GltfFile()
    extensions = {"KHR_materials_unlit": {}}
    colours = file.accessor(np.full((4, 3), 0.5, np.float32))
    plain = file.mesh(file.material(colour=(0.8, 0.4, 0.2, 1), extensions=extensions))
    file.gltf.meshes[plain].primitives[0].attributes.COLOR_0 = colours
    file.node(mesh=plain)
    file.camera(translation=[0, 0, 4])
    file.light({"type": "directional", "intensity": 683})
    with pytest.warns(UserWarning, match="unlit materials are seen from the side"):
        image = mlt.render(mlt.load(file.save("a.glb"), size=SIZE), "path", spp=64)
    middle = image[10:20, 15:25].mean(axis=(0, 1))
    assert middle == pytest.approx([0.4, 0.2, 0.1], rel=2e-3)


@pytest.mark.parametrize("alone", [False, True])
def test_unlit_surfaces_light_nothing_and_need_no_light(alone):
    file = GltfFile()
    file.node(mesh=file.mesh(file.material(extensions={"KHR_materials_unlit": {}})))
    if not alone:
        file.node(mesh=file.mesh(file.material()), translation=[3, 0, 0])
    assert ("sun" in converted(file).scene) == (not alone)


def extended(file: GltfFile, paint=None, **extensions) -> dict:
    """As `painted`, with extensions of materials alone, and the BSDF alone."""
    given = {f"KHR_materials_{name}": value for name, value in extensions.items()}
    surface, warnings = painted(file, extensions=given, **(paint or {}))
    assert not [text for text in warnings if "KHR_materials" in text]
    return surface


GREY = np.full((2, 2, 4), 255, np.uint8)
GREY[..., 3] = 51  # a fifth
STEPS = np.zeros((1, 2, 4), np.uint8)
STEPS[0, :, 1], STEPS[..., [0, 2]] = [0, 255], 51
STEPS[..., 3] = 255
SPECULAR = {  # what the extension says; the index; the reflectance at normal incidence
    "default": ({}, 1.5, [0.04] * 3),
    "none": ({"specularFactor": 0}, 1.5, [0] * 3),
    "half": ({"specularFactor": 0.5, "specularColorFactor": [0.5] * 3}, 1.5, [0.01] * 3),
    "clamped": ({"specularColorFactor": [5] * 3, "specularFactor": 0.5}, 3, [0.5] * 3),
    "bright": ({"specularColorFactor": [2] * 3, "specularFactor": 0.8}, 3, [0.4] * 3),
    "infinite": ({"specularColorFactor": [0.25] * 3}, 0, [0.25] * 3),
    "coloured": ({"specularColorFactor": [3, 0, 1]}, 1.5, [0.12, 0, 0.04]),
    "both": ({"specularColorFactor": [5, 1, 2]}, 3, [1, 0.25, 0.5]),
    "black": ({"specularColorFactor": [0, 0, 0]}, 1.5, [0] * 3),
}


@pytest.mark.parametrize("name", SPECULAR)
def test_specular_is_that_reflectance_at_normal_incidence(name):
    given, ior, expected = SPECULAR[name]
    surface = extended(GltfFile(), specular=given, ior={"ior": ior})
    index = surface["specular_ior"]
    colour = np.array(surface.get("specular_color", {"value": [1] * 3})["value"])
    reflectance = ((index - 1) / (index + 1)) ** 2 * surface.get("specular_weight", 1) * colour
    assert reflectance == pytest.approx(expected, abs=2e-3 if ior == 0 else 1e-12)


def test_metals_have_no_specular_factor():
    given = {"specularFactor": 0.25, "specularColorFactor": [1, 0, 0]}
    file = GltfFile()
    surface = extended(file, {"metallic": 1.0}, specular=given)
    assert not {"specular_weight", "specular_color"} & surface.keys()
    mixed = extended(GltfFile(), {"metallic": 0.5}, specular=given)
    assert mixed["specular_weight"] == {
        "type": "mix",
        "first": 0.25,
        "second": 1.0,
        "amount": 0.5,
    }


def test_an_index_of_zero_is_infinite():
    assert extended(GltfFile(), ior={"ior": 0})["specular_ior"] > 900


def test_textures_of_specular_are_read():
    file = GltfFile()
    index = file.texture(GREY).index
    given = {"specularTexture": {"index": index}, "specularColorTexture": {"index": index}}
    surface = extended(file, specular=given | {"specularFactor": 0.5})
    np.testing.assert_allclose(surface["specular_weight"]["data"], 0.1, rtol=1e-5)
    assert surface["specular_weight"]["raw"]
    assert surface["specular_color"]["type"] == "bitmap"


def test_sheen_covers_as_much_as_its_greatest_component():
    surface = extended(GltfFile(), sheen={"sheenColorFactor": [0.6, 0.3, 0]})
    assert surface["fuzz_weight"] == pytest.approx(0.6)
    assert surface["fuzz_color"]["value"] == pytest.approx([1, 0.5, 0])
    assert surface["fuzz_roughness"] == 0
    assert "fuzz_weight" not in extended(GltfFile(), sheen={})


def test_textures_of_sheen_are_taken_apart():
    file = GltfFile()
    colours, grey = file.texture(QUARTERS).index, file.texture(GREY).index
    given = {"sheenColorTexture": {"index": colours}, "sheenColorFactor": [0.5, 0.5, 0.5]}
    given |= {"sheenRoughnessTexture": {"index": grey}, "sheenRoughnessFactor": 0.5}
    surface = extended(file, sheen=given)
    assert surface["fuzz_weight"] == pytest.approx(0.5)
    hues = surface["fuzz_color"]["data"]
    np.testing.assert_allclose(hues, QUARTERS / 255, atol=1e-6)
    assert surface["fuzz_roughness"] == pytest.approx((0.5 * 0.2) ** 0.4, rel=1e-5)


def test_coats_and_their_textures():
    file = GltfFile()
    info = {"index": file.texture(STEPS).index}
    given = {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.5}
    plain = extended(file, clearcoat=given)
    assert plain.items() >= {"coat_weight": 0.5, "coat_roughness": 0.5, "coat_ior": 1.5}.items()
    textured = given | {"clearcoatTexture": info, "clearcoatRoughnessTexture": info}
    surface = extended(file, clearcoat=textured)
    np.testing.assert_allclose(surface["coat_weight"]["data"], 0.1, rtol=1e-5)
    np.testing.assert_allclose(surface["coat_roughness"]["data"], [[0, 0.5]], atol=1e-5)


def test_normals_that_coats_do_not_have_are_warned_of():
    file = GltfFile()
    bent, other = (file.texture(np.full((2, 2, 3), code)).index for code in (128, 127))
    for coat, base in ((None, bent), (other, bent), (bent, None), (bent, bent)):
        given = {"clearcoatFactor": 1} | (
            {} if coat is None else {"clearcoatNormalTexture": {"index": coat}}
        )
        paint = {"extensions": {"KHR_materials_clearcoat": given}}
        if base is not None:
            paint["normalTexture"] = gl.NormalMaterialTexture(index=base)
        _, warnings = painted(file, **paint)
        warned = "clear coats have the normals of what is below them" in warnings
        assert warned == (coat != base)


def test_films_have_a_thickness_in_micrometres():
    given = {"iridescenceFactor": 0.5, "iridescenceThicknessMaximum": 600}
    surface = extended(GltfFile(), iridescence=given)
    expected = {"thin_film_weight": 0.5, "thin_film_thickness": 0.6, "thin_film_ior": 1.3}
    assert surface.items() >= expected.items()
    file = GltfFile()
    info = {"index": file.texture(STEPS).index}
    textures = {"iridescenceTexture": info, "iridescenceThicknessTexture": info}
    extensions = {"KHR_materials_iridescence": given | textures}
    surface, warnings = painted(file, extensions=extensions)
    np.testing.assert_allclose(surface["thin_film_weight"]["data"], 0.1, rtol=1e-5)
    assert surface["thin_film_thickness"] == pytest.approx((0.1 + 0.6) / 2, rel=1e-5)
    assert [text for text in warnings if "iridescenceThicknessTexture" in text]


def alphas(surface: dict) -> tuple[float, float]:
    """Along and across the tangent, by the specification of OpenPBR."""
    across = 1 - surface["specular_roughness_anisotropy"]
    along = surface["specular_roughness"] ** 2 * np.sqrt(2 / (1 + across**2))
    return along, across * along


@pytest.mark.parametrize("strength", [0.3, 0.8, 1.0])
def test_anisotropy_stretches_highlights_towards_one(strength):
    file = GltfFile()
    surface = extended(file, {"roughness": 0.4}, anisotropy={"anisotropyStrength": strength})
    along, across = alphas(surface)
    assert across == pytest.approx(0.16, rel=1e-9)
    assert along == pytest.approx(0.16 + 0.84 * strength**2, rel=1e-9)


def test_turned_and_textured_anisotropy_is_simplified_with_a_warning():
    file = GltfFile()
    given = {"anisotropyStrength": 1, "anisotropyRotation": 1}
    given |= {"anisotropyTexture": {"index": file.texture(STEPS).index}}
    paint = {"packed": file.texture(STEPS), "roughness": 0.5}
    surface, warnings = painted(file, extensions={"KHR_materials_anisotropy": given}, **paint)
    assert "the rotation of anisotropy" in " ".join(warnings)
    assert "anisotropyTexture the mean strength" in " ".join(warnings)
    texels = {name: surface[name]["data"] for name in surface if "roughness" in name}
    along, across = alphas(texels)
    np.testing.assert_allclose(across, [[0, 0.25]], atol=1e-5)
    np.testing.assert_allclose(along, [[0.04, 0.25 + 0.75 * 0.04]], rtol=1e-4)


def test_grey_images_have_all_channels():
    from PIL import Image

    content = io.BytesIO()
    Image.fromarray(np.array([[51, 255]], np.uint8)).save(content, "png")
    file = GltfFile()
    file.gltf.images = [gl.Image(bufferView=file.view(content.getvalue()), mimeType="image/png")]
    file.gltf.textures = [gl.Texture(source=0)]
    given = {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 1}
    surface = extended(file, clearcoat=given | {"clearcoatRoughnessTexture": {"index": 0}})
    np.testing.assert_allclose(surface["coat_roughness"]["data"], [[0.2, 1]], rtol=1e-5)
