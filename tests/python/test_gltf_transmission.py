"""What goes through materials of glTF: solid glass, thin walls, leaves."""

import numpy as np
import pytest

import pymlt as mlt

pytest.importorskip("pygltflib", reason="needs pymlt[gltf]")

from gltf_files import GltfFile, converted

SIZE = (40, 30)
CLEAR = {"KHR_materials_transmission": {"transmissionFactor": 1}}
THICK = {"KHR_materials_volume": {"thicknessFactor": 1}}
GLASS = CLEAR | THICK | {"KHR_materials_ior": {"ior": 1.6}}
DISPERSION = {"KHR_materials_dispersion": {"dispersion": 0.5}}


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def made_of(*materials: dict, roughness=1.0):
    """What is made of squares, one for each of the materials' extensions."""
    file = GltfFile()
    for index, extensions in enumerate(materials):
        file.material(extensions=extensions, colour=(1, 0.5, 0.25, 1), roughness=roughness)
        file.node(mesh=file.mesh(index), name=f"part-{index}")
    made = converted(file)
    mlt.render(mlt.load_dict(made.scene, size=SIZE), spp=1)
    return made


def colour(*values) -> dict:
    return {"type": "rgb", "value": list(values)}


def test_what_is_in_glass_absorbs_light():
    volume = {"thicknessFactor": 1, "attenuationDistance": 0.5, "attenuationColor": [1, 0.5, 0.25]}
    thin = {"KHR_materials_volume": volume | {"thicknessFactor": 0}}
    filled = {"KHR_materials_volume": volume}
    made = made_of(CLEAR | filled, CLEAR | thin, filled)
    assert "KHR_materials_volume is left out" not in made.warnings
    shapes = [made.scene[f"part-{index}"] for index in range(3)]
    assert ["interior" in shape for shape in shapes] == [True, False, False]
    inside = shapes[0]["interior"]
    assert inside["sigma_s"] == 0
    np.testing.assert_allclose(inside["sigma_a"]["value"], 2 * np.log([1, 2, 4]))


def test_what_has_no_thickness_is_a_thin_wall_in_the_base_colour():
    made = made_of(CLEAR, GLASS, roughness=0.5)
    thin, solid = made.scene["material-0"], made.scene["material-1"]
    assert thin["geometry_thin_walled"] is True
    assert "geometry_thin_walled" not in solid
    for surface in (thin, solid):
        assert surface["transmission_weight"] == 1
        assert surface["transmission_color"] == colour(1, 0.5, 0.25)


def test_perfectly_smooth_clear_glass_has_exact_mirrors():
    scene = made_of(GLASS, GLASS | DISPERSION, CLEAR, roughness=0.0).scene
    tint = {"specular_transmittance": colour(1, 0.5, 0.25)}
    assert scene["material-0"] == {"type": "dielectric", "int_ior": 1.6} | tint
    assert scene["material-1"] == {"type": "dielectric", "int_ior": "abbe 1.6 40.0"} | tint
    assert scene["material-2"] == {"type": "thindielectric", "int_ior": 1.5} | tint


UNCLEAR = {
    "half": {"KHR_materials_transmission": {"transmissionFactor": 0.5}},
    "coated": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}},
    "iridescent": {"KHR_materials_iridescence": {"iridescenceFactor": 1}},
    "velvet": {"KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1]}},
    "anisotropic": {"KHR_materials_anisotropy": {"anisotropyStrength": 0.5}},
}


@pytest.mark.parametrize("name", UNCLEAR)
def test_other_glass_is_openpbr_and_disperses_too(name):
    made = made_of(GLASS | DISPERSION | UNCLEAR[name], roughness=0.0)
    surface = made.scene["material-0"]
    assert surface["type"] == "openpbr"
    assert surface["transmission_dispersion_scale"] == 1
    assert surface["transmission_dispersion_abbe_number"] == 40
    assert not [text for text in made.warnings if "dispersion" in text]
    mlt.render(mlt.load_dict(made.scene, size=SIZE), spp=1, spectral=True)


@pytest.mark.parametrize("extensions", [CLEAR | DISPERSION, DISPERSION])
def test_dispersion_needs_a_solid(extensions):
    made = made_of(extensions)
    said = "dispersion is left out of what has no thickness or lets no light through"
    assert said in made.warnings


def test_specular_of_solid_glass_is_left_out():
    specular = {"KHR_materials_specular": {"specularFactor": 0.25}}
    made = made_of(GLASS | specular, CLEAR | specular)
    assert "specular_weight" not in made.scene["material-0"]
    assert "KHR_materials_specular is left out of solids that light passes" in made.warnings
    assert made.scene["material-1"]["specular_weight"] == 0.25


def test_textures_of_transmission_are_read():
    codes = np.full((1, 2, 4), 255, np.uint8)
    codes[0, 0, 0] = 51
    file = GltfFile()
    given = {"transmissionFactor": 0.5, "transmissionTexture": {"index": file.texture(codes).index}}
    file.node(mesh=file.mesh(file.material(extensions={"KHR_materials_transmission": given})))
    weight = converted(file).scene["material-0"]["transmission_weight"]
    np.testing.assert_allclose(weight["data"], [[0.1, 0.5]], rtol=1e-5)


@pytest.mark.parametrize("wrong", [{"attenuationColor": [1, 2]}, {"attenuationDistance": "far"}])
def test_a_wrong_volume_is_named(wrong):
    volume = {"thicknessFactor": 1, "attenuationDistance": 1} | wrong
    with pytest.raises(mlt.SceneError, match=next(iter(wrong))):
        made_of(CLEAR | {"KHR_materials_volume": volume})


LEAF = {
    "diffuseTransmissionFactor": 0.75,
    "diffuseTransmissionColorFactor": [0.25, 1, 0.5],
}


def lit_from(side: float) -> np.ndarray:
    """How bright a leaf is, (3,), whose light comes from the camera's side (1) or the other."""
    file = GltfFile()
    extensions = {"KHR_materials_diffuse_transmission": LEAF}
    extensions |= {"KHR_materials_specular": {"specularFactor": 0}}
    file.node(mesh=file.mesh(file.material(extensions=extensions, colour=(0.8, 0.4, 0.2, 1))))
    file.camera(translation=[0, 0, 4])
    sun = {"type": "directional", "direction": [0, 0, -side], "irradiance": np.pi}
    scene = converted(file).scene | {"sun": sun}
    del scene["sky"]
    image = mlt.render(mlt.load_dict(scene, size=SIZE), mlt.Path(max_depth=2), spp=16)
    return image[10:20, 15:25].mean(axis=(0, 1))


def test_leaves_let_diffuse_light_through_in_its_own_colour():
    assert lit_from(1) == pytest.approx(0.25 * np.array([0.8, 0.4, 0.2]), rel=1e-3)
    assert lit_from(-1) == pytest.approx(0.75 * np.array([0.25, 1, 0.5]), rel=1e-3)


def test_solids_let_no_diffuse_light_through():
    leaf = {"KHR_materials_diffuse_transmission": LEAF}
    made = made_of(GLASS | leaf)
    assert "KHR_materials_diffuse_transmission is left out of solids" in made.warnings
    assert "subsurface_weight" not in made.scene["material-0"]
