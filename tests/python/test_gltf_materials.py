"""Extensions of glTF's materials and textures, with the values that their definitions give."""

import numpy as np
import pytest

import pymlt as mlt

pytest.importorskip("pygltflib", reason="needs pymlt[gltf]")

from gltf_files import GltfFile, converted

SIZE = (40, 30)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def painted(file: GltfFile, **material) -> dict:
    """The BSDF of a square's only material, without `twosided`, and what was warned of."""
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


def reflectance(index: float) -> float:
    return ((index - 1) / (index + 1)) ** 2


GREY = np.full((2, 2, 4), 255, np.uint8)
GREY[..., 3] = 51  # a fifth
SPECULAR = {  # what the extension says; the reflectance at normal incidence; a warning
    "default": ({}, 1.5, 0.04, ""),
    "none": ({"specularFactor": 0}, 1.5, 0, ""),
    "half": ({"specularFactor": 0.5, "specularColorFactor": [0.5] * 3}, 1.5, 0.01, ""),
    "clamped": ({"specularColorFactor": [5] * 3, "specularFactor": 0.5}, 3, 0.5, ""),
    "bright": ({"specularColorFactor": [2] * 3, "specularFactor": 0.8}, 3, 0.4, ""),
    "infinite": ({"specularColorFactor": [0.25] * 3}, 0, 0.25, ""),
    "coloured": ({"specularColorFactor": [3, 0, 0]}, 1.5, 0.04, "hue of specularColorFactor"),
}


@pytest.mark.parametrize("name", SPECULAR)
def test_specular_is_the_index_of_that_reflectance(name):
    given, ior, expected, warning = SPECULAR[name]
    extensions = {"KHR_materials_specular": given, "KHR_materials_ior": {"ior": ior}}
    surface, warnings = painted(GltfFile(), extensions=extensions)
    assert reflectance(surface["eta"]) == pytest.approx(expected, abs=1e-12)
    said = [text for text in warnings if "specular" in text]
    assert bool(said) == bool(warning)
    assert warning in " ".join(said)


def test_an_index_of_zero_is_infinite():
    surface, _ = painted(GltfFile(), extensions={"KHR_materials_ior": {"ior": 0}})
    assert surface["eta"] > 900


def test_textures_of_specular_count_with_their_mean():
    file = GltfFile()
    index = file.texture(GREY).index
    given = {"specularTexture": {"index": index}, "specularFactor": 0.5}
    surface, warnings = painted(file, extensions={"KHR_materials_specular": given})
    assert reflectance(surface["eta"]) == pytest.approx(0.04 * 0.5 * 0.2, rel=1e-5)
    assert "of specularTexture (KHR_materials_specular) the mean is taken" in warnings


def test_specular_of_glass_is_left_out():
    clear = {"KHR_materials_transmission": {"transmissionFactor": 1}}
    extensions = clear | {"KHR_materials_specular": {"specularFactor": 0}}
    surface, warnings = painted(GltfFile(), extensions=extensions)
    assert surface["eta"] == pytest.approx(1.5)
    assert "KHR_materials_specular is left out of what transmits" in warnings


def test_sheen_has_the_strength_of_its_colour():
    given = {"sheenColorFactor": [0.3, 0.3, 0.3]}
    surface, warnings = painted(GltfFile(), extensions={"KHR_materials_sheen": given})
    assert surface["sheen"] == pytest.approx(0.3)
    assert not [text for text in warnings if "heen" in text]
    given = {"sheenColorFactor": [0.6, 0.3, 0], "sheenRoughnessFactor": 0.5}
    surface, warnings = painted(GltfFile(), extensions={"KHR_materials_sheen": given})
    assert surface["sheen"] == pytest.approx(0.3)
    assert "the roughness of sheen is left out" in warnings
    assert "the hue of sheenColorFactor" in " ".join(warnings)
    assert "sheen" not in painted(GltfFile(), extensions={"KHR_materials_sheen": {}})[0]


def test_textures_of_extensions_that_are_not_read_are_named():
    given = {"transmissionFactor": 0.5, "transmissionTexture": {"index": 0}}
    _, warnings = painted(GltfFile(), extensions={"KHR_materials_transmission": given})
    assert "transmissionTexture (KHR_materials_transmission) is left out" in warnings
