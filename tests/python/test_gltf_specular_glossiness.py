"""Materials of KHR_materials_pbrSpecularGlossiness, by the equations of the extension."""

import numpy as np
import pytest

import pymlt as mlt

pytest.importorskip("pygltflib", reason="needs pymlt[gltf]")

from gltf_files import GltfFile, converted

NAME = "KHR_materials_pbrSpecularGlossiness"
SIZE = (8, 8)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def glossy(file: GltfFile, *, extensions=None, **given):
    """What is made of a square whose material has the extension."""
    more = {key: given.pop(key) for key in ("alphaMode",) if key in given}
    material = file.material(metallic=1.0, extensions={NAME: given} | (extensions or {}), **more)
    file.node(mesh=file.mesh(material))
    made = converted(file)
    mlt.load_dict(made.scene, size=SIZE)
    return made


def values(texture, pixel) -> np.ndarray:
    """Red, green and blue of a texture or number at a pixel."""
    if not isinstance(texture, dict):
        return np.full(3, texture)
    if texture["type"] == "rgb":
        return np.array(texture["value"])
    if texture["type"] == "scale":
        return values(texture["scale"], pixel) * values(texture["texture"], pixel)
    data = texture["data"]
    if isinstance(data, bytes):
        data = mlt._core.decode_image(data, "")[..., :3]
    return np.broadcast_to(data[pixel], 3)


def at_normal_incidence(surface: dict, pixel=(0, 0)) -> tuple[np.ndarray, np.ndarray]:
    """The specular reflectance of a blend or a part of one, and what it scatters below that."""
    if surface["type"] == "blendbsdf":
        share = values(surface["weight"], pixel)
        parts = [at_normal_incidence(surface[name], pixel) for name in ("first", "second")]
        return tuple((1 - share) * a + share * b for a, b in zip(*parts, strict=True))
    if surface.get("base_metalness") == 1:
        return values(surface["base_color"], pixel), np.zeros(3)
    reflectance = ((surface["specular_ior"] - 1) / (surface["specular_ior"] + 1)) ** 2
    return np.full(3, reflectance), (1 - reflectance) * values(surface["base_color"], pixel)


CONSTANTS = {  # diffuse, specular, and the kinds of materials that it takes
    "gold": ([0, 0, 0], [1, 0.766, 0.336], "openpbr"),
    "plastic": ([0.8, 0.5, 0.2], [0.04] * 3, "openpbr"),
    "matt": ([0.8, 0.5, 0.2], [0, 0, 0], "openpbr"),
    "gem": ([0.1, 0.2, 0.3], [0.17] * 3, "openpbr"),
    "silk": ([0.8, 0.5, 0.2], [0.1, 0.3, 0.06], "blendbsdf"),
    "blued": ([0.3, 0.2, 0.1], [0.35, 0.4, 0.6], "blendbsdf"),
    "green": ([0.3, 0.2, 0.1], [0.04, 0.9, 0.005], "blendbsdf"),
}


@pytest.mark.parametrize("name", CONSTANTS)
def test_colours_are_those_of_the_extension(name):
    diffuse, specular, kind = CONSTANTS[name]
    colours = {"diffuseFactor": [*diffuse, 1], "specularFactor": specular}
    made = glossy(GltfFile(), glossinessFactor=0.7, **colours)
    surface = made.scene["material-0"]["bsdf"]
    assert surface["type"] == kind
    reflected, scattered = at_normal_incidence(surface)
    np.testing.assert_allclose(reflected, specular, atol=1e-9)
    expected = np.array(diffuse) * (1 - max(specular))
    np.testing.assert_allclose(scattered, expected, atol=1e-9)
    for part in (surface.get("first", surface), surface.get("second", surface)):
        assert part["specular_roughness"] == pytest.approx(0.3)
    assert not [text for text in made.warnings if "pecular" in text]


def test_without_numbers_all_is_reflected():
    surface = glossy(GltfFile()).scene["material-0"]["bsdf"]
    reflected, scattered = at_normal_incidence(surface)
    np.testing.assert_allclose(reflected, 1, atol=5e-3)
    np.testing.assert_allclose(scattered, 0, atol=5e-3)
    assert surface["specular_roughness"] == 0


def test_a_dark_channel_beside_bright_ones_is_raised_with_a_warning():
    made = glossy(GltfFile(), specularFactor=[0, 0, 0.5])
    reflected, _ = at_normal_incidence(made.scene["material-0"]["bsdf"])
    assert reflected[2] == pytest.approx(0.5)
    assert 0 < reflected[0] < 0.04
    assert "specular colours below 0.04 are raised, to 0.04 at most" in made.warnings


def decoded(codes) -> np.ndarray:
    """Linear light of sRGB codes (IEC 61966-2-1)."""
    x = np.array(codes) / 255
    return np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


# Gold, red plastic, what has no reflection at all, a white metal.
SPECULAR = [[[255, 220, 150, 255], [60, 60, 60, 51]], [[0, 0, 0, 0], [255, 255, 255, 204]]]
DIFFUSE = [[[0, 0, 0, 255], [200, 20, 10, 255]], [[128, 128, 128, 128], [9, 9, 9, 0]]]


def test_textures_are_taken_apart_and_multiplied():
    file = GltfFile()
    given = {
        "diffuseTexture": {"index": file.texture(np.array(DIFFUSE)).index},
        "specularGlossinessTexture": {"index": file.texture(np.array(SPECULAR)).index},
        "diffuseFactor": [1, 0.5, 1, 0.5],
        "specularFactor": [1, 0.9, 1],
        "glossinessFactor": 0.5,
    }
    made = glossy(file, alphaMode="BLEND", **given)
    masked = made.scene["material-0"]
    surface = masked["bsdf"]["bsdf"]
    alpha = np.array(DIFFUSE)[..., 3] / 255
    np.testing.assert_allclose(masked["opacity"]["data"], 0.5 * alpha, rtol=1e-5)
    gloss = np.array(SPECULAR)[..., 3] / 255
    for part in (surface["first"], surface["second"]):
        np.testing.assert_allclose(part["specular_roughness"]["data"], 1 - 0.5 * gloss, rtol=1e-5)
        assert part["specular_roughness"]["raw"]
    for pixel in np.ndindex(2, 2):
        specular = decoded(SPECULAR[pixel[0]][pixel[1]][:3]) * [1, 0.9, 1]
        diffuse = decoded(DIFFUSE[pixel[0]][pixel[1]][:3]) * [1, 0.5, 1]
        reflected, scattered = at_normal_incidence(surface, pixel)
        raised = 0.04 if pixel == (1, 0) else 0
        np.testing.assert_allclose(reflected, np.maximum(specular, raised), atol=1e-5)
        np.testing.assert_allclose(scattered, diffuse * (1 - max(*specular, raised)), atol=1e-5)
    assert "specular colours below 0.04 are raised, to 0.04 at most" in made.warnings


def test_a_mirror_shows_a_white_sky_in_its_specular_colour():
    specular = [0.2, 0.5, 0.8]
    file = GltfFile()
    file.camera(translation=[0, 0, 4])
    colours = {"diffuseFactor": [0, 0, 0, 1], "specularFactor": specular}
    scene = glossy(file, glossinessFactor=0.8, **colours).scene
    del scene["sun"]
    scene["sky"] = {"type": "constant", "radiance": 1.0}
    image = mlt.render(mlt.load_dict(scene, size=SIZE), mlt.Path(max_depth=2), spp=256)
    assert image[3:5, 3:5].mean(axis=(0, 1)) == pytest.approx(specular, rel=0.01)


def test_the_extension_comes_before_metal_and_roughness_and_their_extensions():
    others = {"KHR_materials_transmission": {"transmissionFactor": 1}}
    others |= {"KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 1}}
    made = glossy(GltfFile(), specularFactor=[0.04] * 3, extensions=others)
    surface = made.scene["material-0"]
    assert surface["type"] == "twosided"
    assert "base_metalness" not in surface["bsdf"]
    assert "transmission_weight" not in surface["bsdf"]
    assert "interior" not in made.scene["node-0"]
    for name in others:
        assert f"{name} is left out" in made.warnings
    assert f"{NAME} is left out" not in made.warnings


def test_unlit_materials_keep_their_base_colour():
    made = glossy(GltfFile(), diffuseFactor=[0, 0, 0, 1], extensions={"KHR_materials_unlit": {}})
    assert made.scene["node-0"]["emitter"]["radiance"] == {"type": "rgb", "value": [1, 1, 1]}


def test_vertex_colours_multiply_the_diffuse_colour():
    file = GltfFile()
    colours = file.accessor(np.full((4, 3), 0.5, np.float32))
    given = {"diffuseFactor": [1, 0.5, 0.25, 1], "specularFactor": [0.04] * 3}
    file.node(mesh=file.mesh(file.material(extensions={NAME: given}), COLOR_0=colours))
    base = converted(file).scene["material-0"]["bsdf"]["base_color"]
    assert base["texture"] == {"type": "mesh_attribute", "name": "vertex_color"}
    np.testing.assert_allclose(base["scale"]["value"], [1, 0.5, 0.25])


def test_a_file_may_require_the_extension_and_mistakes_in_it_are_named():
    file = GltfFile()
    file.gltf.extensionsRequired = [NAME]
    assert "material-0" in glossy(file, specularFactor=[0, 0, 0]).scene
    with pytest.raises(mlt.SceneError, match="specularFactor has 2 numbers, but should have 3"):
        glossy(GltfFile(), specularFactor=[1, 1])
    with pytest.raises(mlt.SceneError, match=r"diffuseFactor\[3\] is 'x', but should be a number"):
        glossy(GltfFile(), diffuseFactor=[1, 1, 1, "x"])
