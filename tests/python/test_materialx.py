"""Materials of MaterialX: shaders become `openpbr`."""

import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
from materialx_files import image, linked, material, node, write

import pymlt as mlt
from pymlt.formats.files import read_foreign

# Rows of the matrix from ACEScg to linear Rec. 709, with Bradford's adaptation from D60 to D65
# (Academy, S-2014-004 and TB-2014-004).
ACESCG = [
    [1.70505, -0.62179, -0.08326],
    [-0.13026, 1.14080, -0.01055],
    [-0.02400, -0.12897, 1.15297],
]


EXAMPLE = Path(__file__).resolve().parents[2] / "docs" / "examples" / "materials.mtlx"
HEAD = '<materialx version="1.39"'


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def parts(*elements, expected=(), **given):
    """What the material M of a file becomes; `expected` are parts of its warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = mlt.load_materials(write("a.mtlx", *elements, **given))
    texts = [str(warning.message) for warning in caught]
    assert len(texts) == len(expected), texts
    for text, part in zip(texts, expected, strict=True):
        assert text.startswith("a.mtlx: ")
        assert part in text
    return found["M"]


def bsdf(category, expected=(), **inputs):
    return parts(material(category, **inputs), expected=expected)["bsdf"]


def rgb(*values):
    return {"type": "rgb", "value": pytest.approx(list(values), abs=1e-4)}


# ---- open_pbr_surface ----------------------------------------------------------------------------


def test_inputs_of_openpbr_become_parameters_of_the_same_name():
    made = bsdf(
        "open_pbr_surface",
        base_color=(0.9, 0.5, 0.3),
        base_metalness=1.0,
        coat_weight=0.5,
        coat_ior=1.4,
        geometry_opacity=0.75,
        geometry_thin_walled=True,
    )
    assert made == {
        "type": "openpbr",
        "base_color": rgb(0.9, 0.5, 0.3),
        "base_metalness": 1.0,
        "coat_weight": 0.5,
        "coat_ior": 1.4,
        "geometry_opacity": 0.75,
        "geometry_thin_walled": True,
    }


def test_defaults_and_what_has_no_weight_are_left_out():
    made = bsdf("open_pbr_surface", base_weight=1.0, coat_roughness=0.5, fuzz_color=(1.0, 0.0, 0.0))
    assert made == {"type": "openpbr"}


@pytest.mark.parametrize(
    ("space", "expected"),
    [
        ("", (0.5, 0.4, 0.3)),
        ("lin_rec709", (0.5, 0.4, 0.3)),
        ("srgb_texture", (0.2140, 0.1329, 0.0732)),
        ("g22_rec709", (0.5**2.2, 0.4**2.2, 0.3**2.2)),
        ("acescg", np.array(ACESCG) @ (0.5, 0.4, 0.3)),
        ("lin_ap1", np.array(ACESCG) @ (0.5, 0.4, 0.3)),
        ("g22_ap1", np.array(ACESCG) @ np.power((0.5, 0.4, 0.3), 2.2)),
    ],
)
def test_colours_become_linear_rec_709(space, expected):
    colour = {"type": "color3", "value": "0.5, 0.4, 0.3"}
    own = material("open_pbr_surface", base_color=colour | ({"colorspace": space} if space else {}))
    assert parts(own)["bsdf"]["base_color"] == rgb(*expected)
    files = material("open_pbr_surface", base_color=colour)
    made = parts(files, **({"colorspace": space} if space else {}))
    assert made["bsdf"]["base_color"] == rgb(*expected)


def test_a_colour_space_that_nobody_knows_is_an_error():
    colour = {"type": "color3", "value": "1, 1, 1", "colorspace": "lin_mars"}
    write("a.mtlx", material("open_pbr_surface", base_color=colour))
    with pytest.raises(mlt.SceneError, match=r"^a\.mtlx: M_shader/base_color: .*'lin_mars'"):
        mlt.load_materials("a.mtlx")


@pytest.mark.parametrize(
    ("category", "inputs"),
    [
        ("open_pbr_surface", {"thin_film_thickness": ("0.3", "300")}),
        ("standard_surface", {"thin_film_thickness": ("300", "300")}),
        ("gltf_pbr", {"iridescence_thickness": ("300", "300")}),
    ],
)
@pytest.mark.parametrize("unit", ["", "nanometer", "micron"])
def test_thicknesses_of_films_become_micrometres(category, inputs, unit):
    ((name, (plain, nanometres)),) = inputs.items()
    value = {"": plain, "nanometer": nanometres, "micron": "0.3"}[unit]
    given = {"type": "float", "value": value}
    weights = {"open_pbr_surface": "thin_film_weight", "gltf_pbr": "iridescence"}
    more = {weights[category]: 1.0} if category in weights else {}
    if unit:
        given |= {"unit": unit, "unittype": "distance"}
    assert bsdf(category, **{name: given}, **more)["thin_film_thickness"] == pytest.approx(0.3)


def test_other_lengths_with_a_unit_become_metres():
    radius = {"type": "float", "value": "25", "unit": "millimeter", "unittype": "distance"}
    made = bsdf("open_pbr_surface", subsurface_weight=1.0, subsurface_radius=radius)
    assert made["subsurface_radius"] == pytest.approx(0.025)


def test_a_film_as_thick_as_paper_is_probably_meant_in_nanometres():
    made = bsdf(
        "open_pbr_surface",
        ["M_shader: thin_film_thickness is 500 micrometres"],
        thin_film_weight=1.0,
        thin_film_thickness=500.0,
    )
    assert made["thin_film_thickness"] == 500


def test_what_glows_has_an_emitter_beside_its_bsdf():
    dark = parts(material("open_pbr_surface", emission_color=(1.0, 0.5, 0.0)))
    assert dark.keys() == {"bsdf"}
    lamp = parts(
        material("open_pbr_surface", emission_luminance=20.0, emission_color=(1.0, 0.5, 0.0))
    )
    assert lamp["emitter"] == {"type": "area", "radiance": rgb(20, 10, 0)}


def test_numbers_outside_of_their_range_are_clipped_with_a_warning():
    expected = ["M_shader: base_color is 1.2, 0.5, -0.1, and taken as 1, 0.5, 0"]
    made = bsdf("open_pbr_surface", expected, base_color=(1.2, 0.5, -0.1))
    assert made["base_color"] == rgb(1, 0.5, 0)


def test_inputs_that_openpbr_does_not_have_are_named():
    expected = ["M_shader: specular_rotation is left out"]
    made = bsdf("open_pbr_surface", expected, specular_rotation=0.25, specular_roughness=0.1)
    assert made == {"type": "openpbr", "specular_roughness": 0.1}


def test_tangents_that_are_turned_are_left_out_by_their_name():
    turned = node("normalize", "turned", "vector3", **{"in": {"type": "vector3", "value": "1,1,0"}})
    plain = node("tangent", "plain", "vector3")
    inputs = {
        "geometry_tangent": linked("vector3", "turned"),
        "geometry_coat_tangent": linked("vector3", "plain"),
    }
    made = parts(
        turned,
        plain,
        material("open_pbr_surface", **inputs),
        expected=["M_shader: geometry_tangent is left out"],
    )
    assert made["bsdf"] == {"type": "openpbr"}


# ---- other shaders -------------------------------------------------------------------------------


def test_standard_surface_is_translated_by_the_graph_of_materialx():
    made = bsdf(
        "standard_surface",
        base_color=(0.5, 0.25, 0.1),
        specular_roughness=0.4,
        coat=0.5,
        coat_color=(0.8, 0.6, 0.4),
        coat_IOR=1.4,
        sheen=0.3,
        sheen_roughness=0.5,
    )
    assert made == {
        "type": "openpbr",
        # The coat tints what is below, by its share of the surface.
        "base_color": rgb(0.5 * 0.9, 0.25 * 0.8, 0.1 * 0.7),
        "specular_roughness": 0.4,
        "coat_weight": 0.5,
        "coat_color": rgb(0.8, 0.6, 0.4),
        "coat_roughness": 0.1,
        "coat_ior": 1.4,
        "coat_darkening": 0.0,
        "fuzz_weight": 0.3,
        "fuzz_roughness": pytest.approx(0.5**0.4),
    }


def test_inputs_of_standard_surface_that_the_translation_does_not_read_are_named():
    expected = ["M_shader: specular_rotation is left out"]
    made = bsdf("standard_surface", expected, specular_rotation=0.25, coat_rotation=0.0)
    assert made == {"type": "openpbr", "specular_roughness": 0.2}


def test_gltf_pbr_is_translated():
    made = bsdf(
        "gltf_pbr",
        ["M_shader: occlusion is left out"],
        base_color=(0.5, 0.25, 0.1),
        metallic=0.0,
        roughness=0.4,
        occlusion=0.5,
        specular=0.5,
        clearcoat=1.0,
        sheen_color=(0.4, 0.2, 0.0),
        sheen_roughness=0.5,
        iridescence=1.0,
        iridescence_thickness=400.0,
        alpha=0.25,
        alpha_mode=2,
        emissive=(0.5, 0.25, 0.0),
        emissive_strength=4.0,
    )
    assert made == {
        "type": "openpbr",
        "base_color": rgb(0.5, 0.25, 0.1),
        "specular_roughness": 0.4,
        "specular_weight": 0.5,
        "coat_weight": 1.0,
        "coat_ior": 1.5,
        "coat_darkening": 0.0,
        "fuzz_weight": 0.4,
        "fuzz_color": rgb(1, 0.5, 0),
        "fuzz_roughness": pytest.approx(0.5**0.4),
        "thin_film_weight": 1.0,
        "thin_film_thickness": pytest.approx(0.4),
        "thin_film_ior": 1.3,
        "geometry_opacity": 0.25,
    }


def test_glass_of_gltf_absorbs_if_it_is_thick_and_is_a_wall_if_it_is_not():
    glass = {"transmission": 1.0, "metallic": 0.0, "roughness": 0.0, "base_color": (0.9, 0.8, 0.7)}
    wall = bsdf("gltf_pbr", **glass)
    assert wall["geometry_thin_walled"] is True
    assert wall["transmission_color"] == rgb(0.9, 0.8, 0.7)
    assert "transmission_depth" not in wall
    volume = {"thickness": 1.0, "attenuation_distance": 2.0, "attenuation_color": (0.5, 1.0, 0.5)}
    block = bsdf("gltf_pbr", **glass, **volume, dispersion=0.5)
    assert "geometry_thin_walled" not in block
    assert block["transmission_depth"] == 2
    assert block["transmission_color"] == rgb(0.5, 1, 0.5)
    assert block["transmission_dispersion_scale"] == 0.5


@pytest.mark.parametrize(("alpha_mode", "opacity"), [(0, None), (1, 0.0), (2, 0.3)])
def test_alpha_of_gltf_is_opacity_as_its_mode_says(alpha_mode, opacity):
    made = bsdf("gltf_pbr", alpha=0.3, alpha_mode=alpha_mode)
    assert made.get("geometry_opacity") == opacity


@pytest.mark.parametrize(
    ("inputs", "expected"),
    [
        ({"opacity": 0.4}, {"transmission_weight": pytest.approx(0.6)}),
        ({"opacity": 0.4, "opacityMode": 1}, {"geometry_opacity": 0.4}),
        ({"opacity": 0.4, "opacityThreshold": 0.5}, {"geometry_opacity": 0.0}),
        ({"opacity": 0.4, "opacityThreshold": 0.3}, {}),
    ],
)
def test_opacity_of_usd_lets_light_through_or_cuts_out(inputs, expected):
    made = bsdf("UsdPreviewSurface", **inputs)
    read = ("transmission_weight", "geometry_opacity")
    assert {name: made[name] for name in read if name in made} == expected


def test_specular_colours_of_usd_are_the_reflectance_at_normal_incidence():
    made = bsdf("UsdPreviewSurface", useSpecularWorkflow=1, specularColor=(0.09, 0.02, 0.01))
    reflectance = ((made["specular_ior"] - 1) / (made["specular_ior"] + 1)) ** 2
    hue = np.array(made["specular_color"]["value"])
    assert reflectance * hue == pytest.approx([0.09, 0.02, 0.01])
    assert hue.max() == pytest.approx(1)


def test_metal_and_light_of_usd_become_those_of_openpbr():
    made = parts(material("UsdPreviewSurface", metallic=1.0, emissiveColor=(2.0, 1.0, 0.0)))
    assert made["bsdf"]["base_metalness"] == 1
    assert made["bsdf"]["base_color"] == rgb(0.18, 0.18, 0.18)
    assert made["emitter"] == {"type": "area", "radiance": rgb(2, 1, 0)}


def test_other_shaders_are_an_error_that_names_those_which_are_read():
    write("a.mtlx", material("disney_principled"))
    message = r"^a\.mtlx: M_shader: the shader 'disney_principled' .*standard_surface, gltf_pbr"
    with pytest.raises(mlt.SceneError, match=message):
        mlt.load_materials("a.mtlx")


def test_what_an_input_names_and_does_not_exist_is_an_error():
    for link in ({"nodename": "none"}, {"nodegraph": "none", "output": "out"}):
        write("a.mtlx", material("open_pbr_surface", base_color={"type": "color3", **link}))
        message = r"^a\.mtlx: M_shader/base_color: is connected to what does not exist"
        with pytest.raises(mlt.SceneError, match=message):
            mlt.load_materials("a.mtlx")


# ---- files ---------------------------------------------------------------------------------------


def test_files_of_older_versions_are_read():
    Path("a.mtlx").write_text(
        '<materialx version="1.37"><material name="M"><shaderref name="S" node="standard_surface">'
        '<bindinput name="metalness" type="float" value="0.5"/></shaderref></material></materialx>'
    )
    assert mlt.load_materials("a.mtlx")["M"]["bsdf"]["base_metalness"] == 0.5


def test_a_file_includes_others_beside_it():
    Path("lib").mkdir()
    write("lib/more.mtlx", material("open_pbr_surface", base_weight=0.5))
    write("lib/all.mtlx", '<xi:include href="more.mtlx"/>')
    made = parts('<xi:include href="lib/all.mtlx"/>')
    assert made["bsdf"] == {"type": "openpbr", "base_weight": 0.5}


def test_files_that_include_each_other_without_end_are_refused():
    write("a.mtlx", '<xi:include href="b.mtlx"/>')
    write("b.mtlx", '<xi:include href="a.mtlx"/>')
    with pytest.raises(mlt.SceneError, match="include each other"):
        mlt.load_materials("a.mtlx")


def test_an_included_file_that_is_missing_is_named():
    write("a.mtlx", '<xi:include href="none.mtlx"/>')
    with pytest.raises(mlt.FileError, match=r"none\.mtlx"):
        mlt.load_materials("a.mtlx")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no MaterialX"),
        ("<materialx", "no MaterialX"),
        ("<scene/>", "no MaterialX"),
        (f"{HEAD}/>", "no surfacematerial"),
        (f'{HEAD}><surfacematerial name="M" type="material"/></materialx>', "no surface shader"),
    ],
)
def test_what_is_no_material_is_refused_by_the_files_name(text, message):
    Path("a.mtlx").write_text(text)
    with pytest.raises(mlt.SceneError, match=rf"^a\.mtlx: .*{message}"):
        mlt.load_materials("a.mtlx")


@pytest.mark.parametrize("value", ["red", "1, 2", "nan"])
def test_numbers_that_are_none_are_refused_by_their_input(value):
    write("a.mtlx", material("open_pbr_surface", base_color={"type": "color3", "value": value}))
    with pytest.raises(mlt.SceneError, match=r"^a\.mtlx: M_shader/base_color: .*3 numbers"):
        mlt.load_materials("a.mtlx")


def test_other_extensions_and_a_missing_package_are_said(monkeypatch):
    with pytest.raises(mlt.UsageError, match=r"a\.glb: load_materials reads MaterialX"):
        mlt.load_materials("a.glb")
    write("a.mtlx", material("open_pbr_surface"))
    monkeypatch.setitem(sys.modules, "MaterialX", None)
    with pytest.raises(mlt.UsageError, match="reading MaterialX needs `pip install 'materialx"):
        mlt.load_materials("a.mtlx")


def test_the_materials_of_the_documentation_are_read():
    found = mlt.load_materials(EXAMPLE)
    assert list(found) == ["Brass", "Car_Paint", "Velvet", "Soap", "Jade", "Glass"]


# ---- the scene that shows them -------------------------------------------------------------------


def shown(*names, expected=0):
    made = read_foreign(
        write("a.mtlx", *(material("open_pbr_surface", name=name) for name in names))
    )
    assert len(made.warnings) == expected
    return made.scene


def test_each_material_is_on_a_ball_of_a_row():
    scene = shown("left", "right")
    assert scene["left"]["type"] == scene["right"]["type"] == "sphere"
    assert scene["left"]["bsdf"] == {"type": "openpbr"}
    centres = [scene[name]["to_world"][:3, 3] for name in ("left", "right")]
    assert centres[0] == pytest.approx([-1.2, 1, 0])
    assert centres[1] == pytest.approx([1.2, 1, 0])


def test_no_more_than_eight_materials_are_shown():
    scene = shown(*(f"m{index}" for index in range(10)), expected=2)
    assert [name for name in scene if name.startswith("m")] == [f"m{i}" for i in range(8)]


@pytest.mark.parametrize("count", [1, 2, 8])
def test_the_camera_sees_all_balls_whole(count):
    """Black balls before white: none at the edge of the image, which they fill otherwise."""
    scene = shown(*(f"m{index}" for index in range(count)))
    film = scene["camera"]["film"]
    balls = {
        name: part | {"bsdf": {"type": "diffuse", "reflectance": 0.0}}
        for name, part in scene.items()
        if name.startswith("m")
    }
    white = {"sky": {"type": "constant"}, "camera": scene["camera"], "type": "scene"}
    loaded = mlt.load_dict(balls | white, size=(film["width"] // 8, film["height"] // 8))
    black = mlt.render(loaded, "path", spp=4, seed=1).max(axis=2) < 0.5
    inner = black[1:-1, 1:-1]
    assert black.sum() == inner.sum()
    assert inner.any(axis=1).mean() > 0.65
    assert count == 1 or inner.any(axis=0).mean() > 0.8


def test_an_image_stands_upright_with_its_middle_before_the_camera():
    """Four quarters that glow: red above left, green above right, blue below left, black."""
    quarters = np.zeros((2, 2, 3), np.float32)
    quarters[0, 0, 0] = quarters[0, 1, 1] = quarters[1, 0, 2] = 1
    mlt.write_image("quarters.exr", quarters)
    glow = {"emission_luminance": 1.0, "emission_color": linked("color3", "i")}
    picture = image("i", "quarters.exr", space="", filtertype="closest")
    write("a.mtlx", picture, material("open_pbr_surface", name="m", **glow))
    scene = read_foreign("a.mtlx").scene
    black = {"bsdf": {"type": "diffuse", "reflectance": 0.0}}
    lone = {"type": "scene", "m": scene["m"] | black, "camera": scene["camera"]}
    seen = mlt.render(mlt.load_dict(lone, size=(40, 30)), "path", spp=4, seed=1)
    for row, column, colour in ((9, 14, 0), (9, 25, 1), (20, 14, 2)):
        assert (seen[row, column] > 0.5).tolist() == np.eye(3, dtype=bool)[colour].tolist()
    assert seen[20, 25] == pytest.approx(0)
