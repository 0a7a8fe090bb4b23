"""pbrt-v4 files, compared with the same scenes written as dicts."""

import gzip
from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt
from pymlt import cli
from pymlt.formats.files import read_foreign
from pymlt.formats.imported import Imported
from pymlt.formats.pbrt.environment import directions, sampled, square_of
from pymlt.formats.pbrt.spectra import (
    DISPERSIVE,
    WAVELENGTHS,
    blackbody,
    luminous,
    planck,
    red_green_blue,
)
from pymlt.formats.ply import Mesh, write_ply

T = mlt.Transform
VIEW = """
LookAt 0 1 4  0 1 0  0 1 0
Camera "perspective" "float fov" 40
Sampler "halton" "integer pixelsamples" [ 8 ]
Integrator "path" "integer maxdepth" 3
PixelFilter "box"
Film "rgb" "integer xresolution" 40 "integer yresolution" 30
WorldBegin
"""
FLOOR = """
Material "diffuse" "rgb reflectance" [ .8 .5 .2 ]
Shape "trianglemesh" "point3 P" [ -2 0 -1.5  2 0 -1.5  2 0 1.5  -2 0 1.5 ]
    "integer indices" [0 2 1 0 3 2]
"""
LAMP = 'LightSource "point" "rgb I" [ 6 3 1.2 ] "point3 from" [ .5 1.5 0 ]\n'


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def written(*parts: str, name: str = "a.pbrt") -> str:
    Path(name).write_text("".join(parts))
    return name


def read(*parts: str):
    """The dict, and what was said about it."""
    return read_foreign(written(*parts))


def colour(*values) -> dict:
    return {"type": "rgb", "value": list(values)}


def both_sides(bsdf: dict) -> dict:
    return {"type": "twosided", "bsdf": bsdf}


def test_a_mark_and_carriage_returns_are_no_words():
    text = VIEW + "# a comment\n" + LAMP + FLOOR
    plain = read(text)
    for other in ("\ufeff" + text, text.replace("\n", "\r"), text.replace("\n", "\r\n")):
        Path("b.pbrt").write_bytes(other.encode())
        assert str(read_foreign("b.pbrt").scene) == str(plain.scene)
    Path("b.pbrt").write_bytes(b"WorldBegin\rShape\r7")
    with pytest.raises(mlt.SceneError, match=r"^b\.pbrt:3: "):
        mlt.load("b.pbrt")


def right_handed_scene() -> dict:
    """What VIEW, LAMP and FLOOR say, seen by a camera with right-handed axes."""
    clay = {"type": "diffuse", "reflectance": colour(0.8, 0.5, 0.2)}
    return {
        "type": "scene",
        "sensor": {
            "type": "perspective",
            "fov": 40.0,
            "fov_axis": "smaller",
            "to_world": T.look_at(origin=[0, 1, 4], target=[0, 1, 0], up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": 40, "height": 30, "rfilter": {"type": "box"}},
        },
        "floor": {
            "type": "rectangle",
            "to_world": T().rotate([1, 0, 0], -90).scale(2, 1.5, 1),
            "bsdf": both_sides(clay),
        },
        "lamp": POINT,
    }


def assert_same(a, b):
    images = [mlt.render(scene, mlt.Path(max_depth=2), spp=4, seed=1) for scene in (a, b)]
    assert images[1].max() > 0.05
    differ = ~np.isclose(*images, rtol=2e-3, atol=1e-5).all(axis=2)
    assert differ.mean() < 0.01


# ---- scenes ------------------------------------------------------------------------------------

POINT = {"type": "point", "intensity": colour(6, 3, 1.2), "position": [0.5, 1.5, 0]}


def test_a_scene_is_what_its_dict_is():
    scene = mlt.load(written(VIEW, LAMP, FLOOR))
    info = scene.info()
    assert info["size"] == (40, 30)
    assert info["sample_count"] == 8
    assert info["filter"] == "box"
    assert '"max_depth": 4' in str(mlt.start(scene, spp=1).result().metadata["integrator"])
    # +x, where the lamp is, is on the left of somebody who looks along -z with left-handed axes.
    image = mlt.render(scene, spp=16)
    assert image[:, :20].sum() > 1.2 * image[:, 20:].sum()


def test_the_image_is_that_of_left_handed_axes():
    """A camera at +z that looks along -z has +x on its left; one of ours has it on its right."""
    scenes = (mlt.load(written(VIEW, LAMP, FLOOR)), right_handed_scene())
    images = [mlt.render(scene, "path", spp=400) for scene in scenes]
    blocks = [image.reshape(3, 10, 4, 10, 3).mean(axis=(1, 3)) for image in images]
    assert blocks[0][:, ::-1] == pytest.approx(blocks[1], rel=0.03, abs=1e-3)


LIGHTS = {
    'LightSource "distant" "rgb L" [2 2 1] "float scale" 1.5 "point3 to" [0 -1 0]': {
        "type": "directional",
        "irradiance": colour(3, 3, 1.5),
        "direction": [0, -1, 0],
    },
    'Translate 0 2 0 Rotate 90 1 0 0 LightSource "spot" "float coneangle" 35 "rgb I" [9 9 9]': {
        "type": "spot",
        "intensity": 9.0,
        "cutoff_angle": 35.0,
        "beam_width": 30.0,
        "to_world": T.look_at(origin=[0, 2, 0], target=[0, 0, 0], up=[0, 0, 1]),
    },
    'LightSource "infinite" "spectrum L" [ 300 .5 900 .5 ]': {
        "type": "constant",
        "radiance": {"type": "spectrum", "value": [(300, 1), (900, 1)]},
    },
    LAMP: POINT,
}


@pytest.mark.parametrize("text", LIGHTS)
def test_lights(text):
    made = read(VIEW, "AttributeBegin\n", text, "\nAttributeEnd\n", FLOOR)
    plain = mlt.load_dict(made.scene)
    light = LIGHTS[text]
    other = mlt.load_dict({k: v for k, v in made.scene.items() if "light" not in k} | {"l": light})
    assert_same(plain, other)


AREA = 'AttributeBegin AreaLightSource "diffuse" "rgb L" [8 8 8] Translate 0 2 0 %s AttributeEnd\n'


@pytest.mark.parametrize(
    ("shape", "lit"),
    [
        ('Rotate 90 1 0 0 Shape "disk" "float radius" .5', True),
        ('Rotate -90 1 0 0 Shape "disk" "float radius" .5', False),
        ('Rotate -90 1 0 0 ReverseOrientation Shape "disk" "float radius" .5', True),
        ('Shape "trianglemesh" "point3 P" [-1 0 -1 1 0 -1 0 0 1]', True),
        ('Shape "trianglemesh" "point3 P" [-1 0 -1 0 0 1 1 0 -1]', False),
        ('Scale -1 1 1 Shape "trianglemesh" "point3 P" [-1 0 -1 1 0 -1 0 0 1]', True),
        ('Shape "sphere" "float radius" .3', True),
        ('ReverseOrientation Shape "sphere" "float radius" .3', False),
        ('Shape "cylinder" "float radius" .3', True),
    ],
)
def test_area_lights_shine_from_the_outside(shape, lit):
    scene = mlt.load(written(VIEW, AREA % shape, FLOOR))
    image = mlt.render(scene, mlt.Path(max_depth=2, hide_emitters=True), spp=16)
    assert (image[22:].mean() > 0.05) == lit


POWERS = {  # a shape, the area of the part of it that is one light
    'Scale 2 2 2 Shape "sphere" "float radius" .3': 4 * np.pi * 0.6**2,
    'Scale 2 3 1 Shape "disk" "float radius" .5': np.pi * 0.5**2 * 6,
    'Scale 2 2 2 Shape "cylinder" "float radius" .3 "float zmin" 0': 2 * np.pi * 0.6 * 2,
    'Scale 1 2 1 Shape "trianglemesh" "point3 P" [0 0 0 3 0 0 0 1 0]': 3,
    'Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 1 1 0 0 1 0]'
    ' "integer indices" [0 1 2 0 2 3]': 0.5,
    'Shape "bilinearmesh" "point3 P" [0 0 0 1 0 0 0 1 0 1 1 0]': 1,
    'Shape "plymesh" "string filename" "mesh.ply"': 4.5,
    'Shape "plymesh" "string filename" "mesh.ply.gz"': 4.5,
}


@pytest.mark.parametrize("shape", POWERS)
@pytest.mark.parametrize("sides", [1, 2])
def test_a_power_is_pi_times_area_times_radiance(shape, sides):
    """Of a luminance of 1; pbrt takes each triangle or patch as a light of its own."""
    write_ply(Path("mesh.ply"), Mesh(np.diag([3.0, 3, 0]), np.array([[0, 1, 2]])))
    Path("mesh.ply.gz").write_bytes(gzip.compress(Path("mesh.ply").read_bytes()))
    light = 'AreaLightSource "diffuse" "float power" 10 "rgb L" [1 .5 2] "float scale" 3 '
    light += f'"bool twosided" {"true" if sides == 2 else "false"}\n'
    made = read(VIEW, light, shape)
    (lamp,) = (part for part in made.scene.values() if "emitter" in part)
    radiance = 3 * 10 / (np.pi * POWERS[shape] * sides)
    found = lamp["emitter"]["radiance"]["value"]
    assert found == pytest.approx([radiance, radiance / 2, 2 * radiance], rel=1e-6)


def test_a_power_is_shared_by_all_wavelengths():
    light = 'AreaLightSource "diffuse" "float power" 10 "spectrum L" [300 7 900 7] '
    made = read(VIEW, light, 'Shape "sphere"')
    found = np.array(made.scene["sphere"]["emitter"]["radiance"]["value"])
    assert found[:, 1] == pytest.approx(10 / (np.pi * 4 * np.pi))


def test_ellipsoids_with_a_power_are_one_light():
    made = read(VIEW, 'AreaLightSource "diffuse" "float power" 10 Scale 1 1 2 Shape "sphere"')
    e = np.sqrt(1 - 1 / 4)  # the area of a prolate spheroid is 2 pi (1 + 2 asin(e) / e)
    area = 2 * np.pi * (1 + 2 * np.arcsin(e) / e)
    found = made.scene["sphere"]["emitter"]["radiance"]
    assert found == pytest.approx(10 / (np.pi * area), rel=2e-3)


def test_a_light_of_unlike_triangles_says_so():
    mesh = (
        'Shape "trianglemesh" "point3 P" [0 0 0 2 0 0 0 1 0 9 0 0] "integer indices" [0 1 2 0 3 2]'
    )
    made = read(VIEW, 'AreaLightSource "diffuse" "float power" 10 ', mesh)
    assert "spread evenly, as their areas differ" in " ".join(made.warnings)
    with pytest.raises(mlt.SceneError, match="no area"):
        read('AreaLightSource "diffuse" "float power" 1 ', mesh.replace("0 1 0 9", "1 0 0 9"))


LIT = (
    'LightSource "point" "rgb I" [1 2 3]\nLightSource "infinite" "spectrum L" [300 .5 900 .5]\n'
    'LightSource "distant"\nAreaLightSource "diffuse" "float power" 10\nShape "sphere"\n'
)


@pytest.mark.parametrize("shutter", [(0, 1), (0.25, 0.75)])
@pytest.mark.parametrize("iso", [100, 150])
def test_the_image_is_exposure_time_times_iso_of_100(shutter, iso):
    times = '40 "float shutteropen" {} "float shutterclose" {}'.format(*shutter)
    film = f'"rgb" "float iso" {iso} "string sensor" "cie1931"'
    plain, made = (
        read(*parts)
        for parts in (
            (VIEW, LIT),
            (VIEW.replace("40", times, 1).replace('"rgb"', film), LIT),
        )
    )
    ratio = (shutter[1] - shutter[0]) * iso / 100
    lights = {
        "point-light": lambda light: light["intensity"]["value"],
        "infinite-light": lambda light: np.array(light["radiance"]["value"])[:, 1],
        "distant-light": lambda light: light["irradiance"],
        "sphere": lambda light: light["emitter"]["radiance"],
    }
    for name, strength in lights.items():
        expected = ratio * np.array(strength(plain.scene[name]))
        assert strength(made.scene[name]) == pytest.approx(expected)
    assert made.warnings == plain.warnings == []


def test_an_environment_map_is_exposed():
    mlt.write_image("map.exr", np.ones((4, 4, 3), np.float32))
    light = 'LightSource "infinite" "string filename" "map.exr" "float scale" 3'
    made = read(VIEW.replace('"rgb"', '"rgb" "float iso" 50'), light)
    assert made.scene["infinite-light"]["scale"] == 1.5


def test_a_physical_sensor_is_warned_of():
    film = '"rgb" "string sensor" "canon_eos_100d" "float iso" 200'
    made = read(VIEW.replace('"rgb"', film), LAMP)
    assert "the colours of the sensor 'canon_eos_100d' are left out" in made.warnings[0]
    assert made.scene["point-light"]["intensity"]["value"] == pytest.approx([12, 6, 2.4])


def test_instances_are_copies_of_their_object():
    ball = 'Translate 0 .2 0 Shape "sphere" "float radius" .3\n'
    places = ["Translate -.6 .3 0", "Translate .6 .3 0 Scale .5 .5 .5"]
    plain = "".join(f"AttributeBegin {place} {ball} AttributeEnd\n" for place in places)
    copies = "".join(
        f'AttributeBegin {place} ObjectInstance "ball" AttributeEnd\n' for place in places
    )
    group = f'ObjectBegin "ball"\n{ball}ObjectEnd\n'
    a = mlt.load(written(VIEW, LAMP, FLOOR, plain))
    b = mlt.load(written(VIEW, LAMP, FLOOR, group, copies, name="b.pbrt"))
    assert_same(a, b)


def test_ellipsoids_become_meshes():
    ball = 'Translate 0 .5 0 Scale %s Shape "sphere" "float radius" .4\n'
    flat = read(VIEW, LAMP, FLOOR, ball % "1 1.0001 1")
    assert flat.warnings == ["ellipsoids become meshes"]
    scenes = (mlt.load_dict(flat.scene), mlt.load(written(VIEW, LAMP, FLOOR, ball % "1 1 1")))
    images = [mlt.render(scene, mlt.Path(max_depth=2), spp=64) for scene in scenes]
    assert images[0].mean() == pytest.approx(images[1].mean(), rel=0.01)
    assert np.median(abs(images[0] - images[1])) < 0.01 * images[1].mean()


OCTAHEDRON = (
    'Shape "loopsubdiv" "point3 P" [1 0 0 0 1 0 0 0 1 -1 0 0 0 -1 0 0 0 -1]'
    ' "integer indices" [0 1 2 1 3 2 3 4 2 4 0 2 1 0 5 3 1 5 4 3 5 0 4 5] '
)


def test_a_subdivision_surface_is_that_of_loop():
    """Loop 1987: beta of a corner with 4 neighbours is 31/256, an edge weighs 3/8 and 1/8."""
    made = read(VIEW, OCTAHEDRON, '"integer levels" 1').scene["loopsubdiv"]
    assert made["faces"].shape == (32, 3)
    at = made["vertices"]
    axes = at[np.isclose(abs(at), 33 / 64).any(axis=1)]
    edges = at[np.isclose(abs(at), 3 / 8).sum(axis=1) == 2]
    assert (len(axes), len(edges)) == (6, 12)
    assert abs(axes).sum(axis=1) == pytest.approx(33 / 64)
    assert abs(edges).sum(axis=1) == pytest.approx(3 / 4)
    outwards = (made["normals"] * at).sum(axis=1) / np.linalg.norm(at, axis=1)
    assert outwards == pytest.approx(1)  # by symmetry


def test_a_subdivision_surface_has_three_levels_and_renders():
    made = read(VIEW, LAMP, 'Material "diffuse" ', OCTAHEDRON)
    assert len(made.scene["loopsubdiv"]["faces"]) == 8 * 4**3
    assert made.warnings == []
    assert mlt.render(mlt.load_dict(made.scene), "path", spp=4).max() > 0.05


def test_transforms_and_attributes_are_saved():
    made = read(
        'Translate 1 0 0 CoordinateSystem "here"\n' + VIEW,
        'AttributeBegin Translate 0 1 0 Scale 2 2 2 Shape "sphere"\n AttributeEnd\n',
        'TransformBegin Transform [1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1] Shape "sphere" TransformEnd\n',
        'ConcatTransform [0 1 0 0 -1 0 0 0 0 0 1 0 0 0 0 1] Shape "sphere"\n',
        'Identity CoordSysTransform "here" Shape "sphere" "float radius" 2\n',
    )
    turned = np.diag([1, 1, -1, 1])  # spheres are upside down
    found = [v["to_world"] @ turned for k, v in made.scene.items() if k.startswith("sphere")]
    assert found[0] == pytest.approx(np.array(T.translate(0, 1, 0) @ T.scale(2)))
    assert found[1][:3, 3] == pytest.approx([5, 6, 7])
    assert found[2] == pytest.approx(np.array(T.rotate([0, 0, 1], 90)))
    assert found[3] == pytest.approx(np.array(T.translate(1, 0, 0)))


def test_attributes_are_parameters_by_default():
    Path("i.png").write_bytes(b"")
    made = read(
        VIEW,
        'Attribute "shape" "float radius" 2 "float beauty" 1 Attribute "shape" "string x" "y"\n',
        'Attribute "light" "float scale" 3 Attribute "material" "rgb reflectance" [.1 .2 .3]\n',
        'Attribute "texture" "float uscale" 5 Attribute "medium" "rgb sigma_a" [1 1 1]\n',
        'LightSource "point" "rgb I" [1 1 1]\nMaterial "diffuse"\n',
        'Texture "t" "spectrum" "imagemap" "string filename" "i.png"\n',
        'AttributeBegin Attribute "shape" "float radius" 3 Shape "sphere" AttributeEnd\n',
        'AreaLightSource "diffuse" "float scale" 7 Shape "sphere" Shape "sphere"'
        ' "float radius" 1\n',
        'MakeNamedMaterial "m" "string type" "diffuse" "texture reflectance" "t"\n',
    )
    spheres = [part for part in made.scene.values() if "radius" in part]
    assert [sphere["radius"] for sphere in spheres] == [3, 2, 1]
    assert made.scene["point-light"]["intensity"]["value"] == [3, 3, 3]
    assert spheres[1]["emitter"]["radiance"] == 7
    assert made.scene["diffuse-material"]["bsdf"]["reflectance"] == colour(0.1, 0.2, 0.3)
    assert made.scene["m"]["bsdf"]["reflectance"]["uscale"] == 5
    assert made.warnings == []  # what only some shapes have is no mistake


# ---- materials, textures -----------------------------------------------------------------------

MATERIALS = {
    'Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k"'
    ' "float roughness" .09': both_sides(
        {"type": "roughconductor", "distribution": "ggx", "alpha": 0.3, "material": "Au"}
    ),
    'Material "conductor" "rgb reflectance" [.9 .8 .7]': both_sides(
        {"type": "conductor", "specular_reflectance": colour(0.9, 0.8, 0.7)}
    ),
    'Material "dielectric" "float eta" 1.4': {"type": "dielectric", "int_ior": 1.4},
    'Material "dielectric" "float roughness" .2 "bool remaproughness" false': {
        "type": "roughdielectric",
        "distribution": "ggx",
        "alpha": 0.2,
        "int_ior": 1.5,
    },
    'Material "dielectric" "spectrum eta" "glass-BK7"': {"type": "dielectric", "int_ior": "bk7"},
    'Material "dielectric" "spectrum eta" "glass-BAF10"': {
        "type": "dielectric",
        "int_ior": "sellmeier 1.5851495 .143559385 1.08521269 .00926681282 .0424489805 105.613573",
    },
    'Material "dielectric" "spectrum eta" [400 1.52 700 1.5]': {
        "type": "dielectric",
        "int_ior": {"type": "spectrum", "value": [(400, 1.52), (700, 1.5)]},
    },
    'Material "thindielectric"': {"type": "thindielectric", "int_ior": 1.5},
    'Material "coateddiffuse" "rgb reflectance" [.1 .2 .3] "float roughness" .04': both_sides(
        {
            "type": "roughplastic",
            "distribution": "ggx",
            "alpha": 0.2,
            "diffuse_reflectance": colour(0.1, 0.2, 0.3),
            "int_ior": 1.5,
            "nonlinear": True,
        }
    ),
    'Material "coatedconductor" "float conductor.roughness" .01': both_sides(
        {
            "type": "coating",
            "int_ior": 1.5,
            "bsdf": {
                "type": "roughconductor",
                "distribution": "ggx",
                "alpha": 0.1,
                "material": "Cu",
                "ext_eta": 1.5,
            },
        }
    ),
    'Material "interface"': {"type": "null"},
}


@pytest.mark.parametrize("text", MATERIALS)
def test_materials(text):
    made = read(VIEW, LAMP, text, '\nShape "sphere"\n')
    name = made.scene["sphere"]["bsdf"]["id"]
    expected = MATERIALS[text]
    found = made.scene[name]
    alphas = [x.get("bsdf", x).pop("alpha", 0) for x in (found, expected)]
    assert found == expected or found["bsdf"]["bsdf"].pop("alpha") == pytest.approx(0.1)
    assert alphas[0] == pytest.approx(alphas[1])
    assert made.warnings == []


def test_every_material_renders():
    for text in MATERIALS:
        mlt.render(mlt.load(written(VIEW, LAMP, text, ' Shape "sphere" "float radius" .5')), spp=1)


def test_mixtures_and_named_materials():
    made = read(
        VIEW,
        'MakeNamedMaterial "red" "string type" "diffuse" "rgb reflectance" [.5 0 0]\n',
        'MakeNamedMaterial "gold" "string type" "conductor" "spectrum eta" "metal-Au-eta"\n',
        'Material "mix" "string materials" ["red" "gold"] "float amount" .25 Shape "sphere"\n',
        'NamedMaterial "gold" Shape "sphere" ',
        LAMP,
    )
    blend = made.scene[made.scene["sphere"]["bsdf"]["id"]]["bsdf"]
    assert (blend["type"], blend["weight"]) == ("blendbsdf", 0.25)
    assert made.scene["sphere_2"]["bsdf"] == {"type": "ref", "id": "gold"}
    mlt.render(mlt.load_dict(made.scene), spp=1)


def test_images_are_the_right_way_up():
    pixels = np.zeros((2, 2, 3), np.float32)
    pixels[0, 0], pixels[1, 1] = [1, 0, 0], [0, 1, 0]  # above on the left, below on the right
    mlt.write_image("image.png", pixels)
    text = (
        'Texture "image" "spectrum" "imagemap" "string filename" "image.png"\n'
        'Material "diffuse" "texture reflectance" "image"\n'
        'Shape "bilinearmesh" "point3 P" [-1 0 0 1 0 0 -1 2 0 1 2 0]'
        ' "point2 uv" [0 0 1 0 0 1 1 1]\n'
    )
    made = read(VIEW, 'LightSource "infinite"\n', text)
    image = mlt.render(mlt.load_dict(made.scene), mlt.Path(max_depth=2), spp=16)
    # +x is on the left, so the picture is seen from behind.
    assert image[9, 25].argmax() == 0
    assert image[9, 25, 0] > 0.3
    assert image[21, 14].argmax() == 1
    assert image[21, 14, 1] > 0.3


@pytest.mark.parametrize(
    ("shape", "scale"),
    [
        ("sphere", "1 1 1"),
        ("sphere", "1 1 1.001"),
        ("sphere", "1 -1 1"),
        ("cylinder", "1 1 1"),
        ("cylinder", "1 -1 1"),
    ],
)
def test_images_are_the_right_way_up_around_an_axis(shape, scale):
    """Along z; u grows around it from x towards y, v from the lower end."""
    pixels = np.zeros((8, 8, 3), np.float32)
    pixels[:4, :, 0] = pixels[4:, :, 1] = pixels[:, :4, 2] = 1  # red above, blue where u < 1/2
    mlt.write_image("image.exr", pixels)
    text = (
        'LightSource "infinite"\n'
        'Texture "image" "spectrum" "imagemap" "string filename" "image.exr"\n'
        f'Material "diffuse" "texture reflectance" "image"\nScale {scale} Shape "{shape}"\n'
    )
    view = VIEW.replace("LookAt 0 1 4  0 1 0  0 1 0", "LookAt {} 0  0 0 0  0 0 1")
    for at, blue in (("1 4", True), ("1 -4", False)):
        made = read(view.format(at), text)
        image = mlt.render(mlt.load_dict(made.scene), mlt.Path(max_depth=2), spp=16)
        above, below = image[10, 20], image[19, 20]
        assert above[0] > 0.5 > 0.1 > above[1]
        assert below[1] > 0.5 > 0.1 > below[0]
        assert (above[2] > 0.5) == (blue != (scale == "1 -1 1"))


@pytest.mark.parametrize("film", ["rgb", "image"])
@pytest.mark.parametrize("alpha", ["", '"float alpha" 1'])
def test_images_on_disks_go_around_and_inwards(film, alpha):
    pixels = np.zeros((8, 8, 3), np.float32)
    pixels[:4, :, 0] = pixels[4:, :, 1] = pixels[:, :2, 2] = 1  # red above, blue where u < 1/4
    mlt.write_image("image.exr", pixels)
    kind, material, colour = (
        ("spectrum", "diffuse", "reflectance") if film == "rgb" else ("color", "matte", "Kd")
    )
    text = (
        'LightSource "infinite"\n'
        f'Texture "image" "{kind}" "imagemap" "string filename" "image.exr"\n'
        f'Material "{material}" "texture {colour}" "image"\n'
        f'Shape "disk" "float radius" 2 {alpha}\nShape "sphere" "float radius" .001\n'
    )
    view = VIEW.replace("LookAt 0 1 4  0 1 0  0 1 0", "LookAt 0 0 9  0 0 0  0 1 0")
    made = read(view.replace('"rgb"', f'"{film}"'), text)
    assert made.warnings == []
    # The image is turned for the disk alone.
    assert made.scene["sphere"]["bsdf"]["type"] == "ref"
    image = mlt.render(mlt.load_dict(made.scene), mlt.Path(max_depth=2), spp=16)

    def at(degrees, radius):
        """The colour there, of an image whose x axis points to the left."""
        x, y = radius * np.cos(np.radians(degrees)), radius * np.sin(np.radians(degrees))
        pixel = 30 / (2 * 9 * np.tan(np.radians(20)))
        return image[int(15 - y * pixel), int(20 - x * pixel)] > 0.5

    for degrees in (45, 135, 225, 315):
        assert list(at(degrees, 0.6)) == [True, False, degrees == 45]
        assert list(at(degrees, 1.4)) == [False, True, degrees == 45]
    mlt.convert("a.pbrt", "a.xml")
    again = mlt.render(mlt.load("a.xml"), mlt.Path(max_depth=2), spp=16)
    np.testing.assert_array_equal(again, image)


def test_a_normal_map_on_a_disk_is_a_warning():
    mlt.write_image("n.exr", np.full((2, 2, 3), [0.5, 0.5, 1], np.float32))
    material = 'Material "diffuse" "string normalmap" "n.exr"\n'
    made = read(VIEW, LAMP, material, 'Shape "sphere" ')
    assert made.warnings == []
    made = read(VIEW, LAMP, material, 'Shape "disk"')
    assert made.warnings == ["the normals of a normal map on a disk are turned by a quarter"]


def test_textures_are_scaled_and_checked():
    made = read(
        'Texture "a" "spectrum" "constant" "rgb value" [.2 .4 .6]\n',
        'Texture "b" "spectrum" "checkerboard" "texture tex1" "a" "float tex2" .5'
        ' "float uscale" 4\n',
        'Texture "c" "spectrum" "scale" "texture tex" "b" "float scale" .5\n',
        'Texture "d" "spectrum" "wrinkled"\n',
        'Material "diffuse" "texture reflectance" "c" Shape "sphere"\n',
        'Material "diffuse" "texture reflectance" "d" Shape "sphere" "float alpha" .5',
    )
    scaled = made.scene["diffuse-material"]["bsdf"]["reflectance"]
    assert (scaled["type"], scaled["scale"]) == ("scale", 0.5)
    assert scaled["texture"]["color0"] == colour(0.2, 0.4, 0.6)
    assert scaled["texture"]["uscale"] == 2
    assert made.scene["sphere_2"]["bsdf"]["type"] == "mask"
    assert "the texture 'wrinkled' has no counterpart; it becomes 0.5" in made.warnings
    mlt.render(mlt.load_dict(made.scene, size=(8, 8)), spp=1)


SCALED = {  # a constant texture, its factor, and their product
    '"float value" .5': ('"float scale" .5', 0.25),
    '"rgb value" [.2 .4 .6]': ('"float scale" .5', colour(0.1, 0.2, 0.3)),
    '"rgb value" [.2 .4 .8]': ('"rgb scale" [1 .5 .25]', colour(0.2, 0.2, 0.2)),
    '"spectrum value" [400 .2 700 .4]': ('"float scale" .5', {"type": "spectrum"}),
    '"spectrum value" [400 .2 700 .8]': ('"rgb scale" [1 .5 .25]', {"type": "scale"}),
    '"rgb value" [.2 .4 .7]': ('"spectrum scale" [400 .2 700 .4]', {"type": "scale"}),
    '"float value" .7': ('"spectrum scale" [400 .2 700 .4]', {"type": "spectrum"}),
}


@pytest.mark.parametrize("constant", SCALED)
def test_constant_textures_are_scaled(constant):
    factor, product = SCALED[constant]
    made = read(
        f'Texture "a" "spectrum" "constant" {constant}\n',
        f'Texture "b" "spectrum" "scale" "texture tex" "a" {factor}\n',
        'Material "diffuse" "texture reflectance" "b" Shape "sphere"',
    )
    found = made.scene["diffuse-material"]["bsdf"]["reflectance"]
    if isinstance(product, float):
        assert found == product
    else:
        assert found["type"] == product["type"]
        if "value" in product:
            np.testing.assert_allclose(found["value"], product["value"])
    mlt.render(mlt.load_dict(made.scene, size=(4, 4)), spp=1)


def test_black_bodies_that_do_not_shine_are_refused():
    for kelvin in (0, -3000, 10):
        with pytest.raises(mlt.Error, match=rf"a black body of {kelvin} K does not shine"):
            read(f'LightSource "infinite" "blackbody L" {kelvin}')


def test_lights_without_visible_power_are_dark():
    light = 'AreaLightSource "diffuse" "spectrum L" [ 400 0 700 0 ] Shape "disk"'
    made = read(light)
    assert not mlt.render(mlt.load_dict(made.scene, size=(4, 4)), mlt.Path(), spp=1).any()


GLASSES = {"BK7": (1.5168, 64.17), "SF11": (1.78472, 25.68)}
GLASSES |= {"BAF10": (1.67003, 47.11), "FK51A": (1.48656, 84.47)}
GLASSES |= {"LASF9": (1.85025, 32.17), "SF5": (1.6727, 32.21)}


@pytest.mark.parametrize("glass", GLASSES)
def test_glasses_have_the_index_and_the_abbe_number_of_the_catalogue(glass):
    kind, *numbers = DISPERSIVE[f"glass-{glass}"].split()
    if kind != "sellmeier":
        assert kind == glass.lower()  # one of the names that dielectrics have here
        return
    b, c = np.array(numbers, float).reshape(2, 3)

    def at(nanometres):
        square = (nanometres / 1000) ** 2
        return np.sqrt(1 + (b * square / (square - c)).sum())

    yellow, blue, red = (at(line) for line in (587.5618, 486.1327, 656.2725))
    assert yellow == pytest.approx(GLASSES[glass][0], abs=6e-6)
    assert (yellow - 1) / (blue - red) == pytest.approx(GLASSES[glass][1], abs=6e-3)


def test_glass_disperses_in_spectral_renders_alone():
    glass = 'Material "dielectric" "spectrum eta" "glass-SF11" Shape "sphere" "float radius" .5'
    plain = 'Material "dielectric" "float eta" 1.7845 Shape "sphere" "float radius" .5'
    texts = {"a.pbrt": glass, "b.pbrt": plain}
    paths = [written(VIEW, LAMP, FLOOR, text, name=name) for name, text in texts.items()]
    assert_same(*(mlt.load(path) for path in paths))
    scenes = [mlt.load(path, spectral=True) for path in paths]
    spectral = [mlt.render(scene, "bdpt", spp=4, seed=1) for scene in scenes]
    assert not np.allclose(*spectral, rtol=1e-3)


def test_metals_and_illuminants_have_their_names():
    brass = read('Material "conductor" "spectrum eta" "metal-CuZn-eta" Shape "sphere"')
    (material,) = (v for k, v in brass.scene.items() if "material" in k)
    assert material["bsdf"]["material"] == "Cu"
    assert "brass (CuZn) is not known; it is taken as copper" in brass.warnings
    made = read('LightSource "infinite" "spectrum L" "stdillum-A"')
    pairs = made.scene["infinite-light"]["radiance"]["value"]
    np.testing.assert_allclose(pairs, blackbody(2856)["value"])


def test_a_black_body_has_luminance_one():
    made = read('LightSource "infinite" "blackbody L" 3000')
    pairs = np.array(made.scene["infinite-light"]["radiance"]["value"])
    weights = np.array([luminous(wave) for wave in pairs[:, 0]])
    assert (pairs[:, 1] * weights).sum() / weights.sum() == pytest.approx(1)
    red, blue = (np.interp(wave, *pairs.T) for wave in (650, 450))
    assert red > 3 * blue


# ---- environment maps --------------------------------------------------------------------------


def test_the_octahedral_map_has_equal_areas():
    """Clarberg 2008: each square of the map is an equal part of the sphere."""
    rng = np.random.default_rng(1)
    d = rng.normal(size=(200_000, 3))
    d /= np.linalg.norm(d, axis=1, keepdims=True)
    at = square_of(d)
    counts = np.histogram2d(*at.T, bins=8, range=[[0, 1], [0, 1]])[0]
    assert counts == pytest.approx(200_000 / 64, rel=0.1)
    assert square_of(np.eye(3)) == pytest.approx(np.array([[1, 0.5], [0.5, 1], [0.5, 0.5]]))


def test_an_environment_map_lights_from_where_it_did():
    n = 64
    centres = (np.arange(n) + 0.5) / n
    u, v = np.meshgrid(centres, centres)
    found = directions(n)
    # An image that says of each direction where it is: the map is inverted by a search.
    target = square_of(found).reshape(-1, 2)
    ramp = sampled(np.stack([u, v, 0 * u], axis=-1), target)
    inside = (target > 1 / n).all(axis=1) & (target < 1 - 1 / n).all(axis=1)
    assert ramp[inside, :2] == pytest.approx(target[inside], abs=1e-9)
    # A spot around -y in pbrt's axes shines on what looks there.
    spot = (np.hypot(u - 0.5, v - 0.0) < 0.1).astype(np.float32)
    mlt.write_image("map.exr", np.repeat(spot[..., None], 3, axis=2))
    made = read(VIEW, 'LightSource "infinite" "string filename" "map.exr"\n', FLOOR)
    scene = mlt.load_dict(made.scene)
    assert mlt.render(scene, mlt.Path(max_depth=2), spp=16)[22:].mean() < 0.01
    turned = 'AttributeBegin Rotate 180 1 0 0 LightSource "infinite" "string filename" "map.exr" '
    lit = mlt.load(written(VIEW, turned, "AttributeEnd\n", FLOOR))
    assert mlt.render(lit, mlt.Path(max_depth=2), spp=64)[22:].mean() > 0.01


@pytest.mark.parametrize("degrees", [5, 30, 60, 90, 150])
def test_an_environment_map_is_seen_where_it_was(degrees):
    """A map of 1 + z, which is the mean over each of its pixels."""
    n = 64
    d = np.random.default_rng(1).normal(size=(1_000_000, 3))
    d /= np.linalg.norm(d, axis=1, keepdims=True)
    u, v = square_of(d).T
    bins = {"bins": n, "range": [[0, 1], [0, 1]]}
    total, count = (np.histogram2d(v, u, weights=w, **bins)[0] for w in (1 + d[:, 2], None))
    image = np.repeat((total / count)[..., None], 3, axis=2).astype(np.float32)
    mlt.write_image("map.exr", image)
    theta = np.radians(degrees)
    look = f"LookAt 0 0 0  {np.sin(theta) * 0.6} {np.sin(theta) * 0.8} {np.cos(theta)}  0 1 0"
    view = VIEW.replace("LookAt 0 1 4  0 1 0  0 1 0", look).replace(
        '"float fov" 40', '"float fov" 1'
    )
    made = read(view, 'LightSource "infinite" "string filename" "map.exr"')
    found = mlt.render(mlt.load_dict(made.scene), spp=1).mean()
    assert found == pytest.approx(1 + np.cos(theta), abs=0.006)


# ---- files -------------------------------------------------------------------------------------


def test_files_include_others_and_meshes(tmp_path):
    Path("parts").mkdir()
    with gzip.open("parts/floor.pbrt.gz", "wt") as file:
        file.write(FLOOR + 'Include "parts/lamp.pbrt"\n')
    Path("parts/lamp.pbrt").write_text("# a lamp\n" + LAMP)
    corners = np.array([[-2, 0, -1.5], [2, 0, -1.5], [2, 0, 1.5], [-2, 0, 1.5]])
    triangles = np.array([[0, 2, 1], [0, 3, 2]])
    write_ply(tmp_path / "mesh.ply", Mesh(corners, triangles))
    Path("mesh.ply.gz").write_bytes(gzip.compress(Path("mesh.ply").read_bytes()))
    clay = 'Material "diffuse" "rgb reflectance" [ .8 .5 .2 ] '
    whole = mlt.load(written(VIEW, LAMP, FLOOR))
    for name, text in {
        "b": 'Include "parts/floor.pbrt.gz"\n',
        "c": LAMP + clay + 'Shape "plymesh" "string filename" "mesh.ply"',
        "d": LAMP + clay + 'Shape "plymesh" "string filename" "mesh.ply.gz"',
    }.items():
        assert_same(whole, mlt.load(written(VIEW, text, name=f"{name}.pbrt")))


def test_a_converted_scene_is_the_same_scene(capsys):
    area = AREA % 'Rotate 90 1 0 0 Shape "disk" "float radius" .5'
    infinite = 'LightSource "infinite" "blackbody L" 5000 "float scale" .1\n'
    group = 'ObjectBegin "b" Shape "sphere" ObjectEnd Scale .2 .2 .2 ObjectInstance "b"\n'
    path = written(VIEW, area, infinite, FLOOR, group)
    assert cli.main(["convert", path, "b.xml"]) == 0
    assert capsys.readouterr().err == "pymlt: b.xml\n"
    images = [mlt.render(mlt.load(name), "path", spp=2, seed=1) for name in ("b.xml", path)]
    np.testing.assert_array_equal(*images)
    assert cli.main(["render", path, "--spp", "1", "-o", "a.exr", "--quiet"]) == 0


def test_what_has_no_counterpart_is_named():
    made = read(
        VIEW.replace('"box"', '"box" "float xradius" 1'),
        'MakeNamedMedium "fog" "string type" "cloud" "rgb sigma_a" [1 1 1]\n',
        'MediumInterface "" "fog"\nColorSpace "srgb"\n',
        'Material "hair" Shape "curve" Shape "sphere" "float zmax" .5 "float beauty" 1\n',
        'LightSource "laser"\n',
    )
    said = " ".join(made.warnings)
    for word in ("ColorSpace", "'cloud'", "'hair'", "'curve'", "parts of spheres"):
        assert word in said
    assert "Shape 'sphere': 'beauty' is left out" in made.warnings
    assert "there is no light" in said
    mlt.render(mlt.load_dict(made.scene), spp=1)


def test_warnings_name_the_file_and_the_line(capsys):
    Path("part.pbrt").write_text('\n\nShape "curve"\n')
    curl = 'LightSource "infinite" "string beauty" "high"\nInclude "part.pbrt"\nShape "curve"\n'
    line = VIEW.count("\n") + 1
    expected = [
        f"a.pbrt:{line}: LightSource 'infinite': 'beauty' is left out",
        "part.pbrt:3: the shape 'curve' has no counterpart",
    ]
    with pytest.warns(UserWarning, match=r"\.pbrt:\d+: ") as found:
        mlt.load(written(VIEW, curl))
    assert [str(warning.message) for warning in found] == expected
    assert mlt.convert("a.pbrt", "a.xml") == expected
    assert cli.main(["info", "a.pbrt"]) == 0
    said = capsys.readouterr().err
    assert all(f"pymlt: warning: {text}\n" in said for text in expected)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("\nAttributeEnd", r"a\.pbrt:2: AttributeEnd ends nothing"),
        ("AttributeBegin", "no AttributeEnd"),
        ('"float x" 1', "a directive is expected"),
        ("Translate 1 x 0", "'x' is not a number"),
        ("Translate 1 2", "the file ends here"),
        ("Translate 1 nan 2", "'nan' is not a number"),
        ('LightSource "infinite" "blackbody L" 0', r"a\.pbrt:1: LightSource makes no sense"),
        ("Shape sphere", "a text in quotes"),
        ('Shape "sphere" "float radius" [ 1', "the file ends here"),
        ('Shape "sphere" "radius" 1', "a type and a name"),
        ('Shape "sphere" "point3 p" [1 2]', "has 2 numbers"),
        ('Shape "trianglemesh"', "needs 'P'"),
        ('Shape "trianglemesh" "point3 P" [0 0 0] "integer indices" [0 1 2]', "does not exist"),
        ('Shape "trianglemesh" "point3 P" [0 0 0] "point2 uv" [0 0 1 1]', "2 'uv'"),
        ('NamedMaterial "x"', "no material 'x'"),
        ('Material "diffuse" "texture reflectance" "x"', "no texture 'x'"),
        ('Material "mix" "string materials" ["a"]', "two materials"),
        ('MakeNamedMaterial "x"', "string type"),
        ('ObjectInstance "x"', "no object 'x'"),
        ("ObjectEnd", "ends nothing"),
        ('CoordSysTransform "x"', "no coordinate system 'x'"),
        ("LookAt 0 0 0 0 1 0 0 1 0", "parallel"),
        ('Shape "loopsubdiv"', "needs 'P' and 'indices'"),
        (OCTAHEDRON + '"integer levels" 99', "'levels' is 99"),
        (OCTAHEDRON.replace("0 4 5", "0 4 9"), "does not exist"),
        ('Attribute "camera" "float x" 1', "Attribute 'camera' is not known"),
        ('Film "rgb" "float iso" 0', "'iso' should be above 0"),
        ('Camera "perspective" "float shutteropen" 1', "later than 'shutteropen'"),
        ('Shape "sphere', "ends on this line"),
    ],
)
def test_mistakes_are_named_with_their_line(text, message):
    with pytest.raises(mlt.SceneError, match=message):
        mlt.load(written(text))


SHINES = '\nLightSource "point" "rgb I" [1 1 1]'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('\nShape "sphere"\n"float radius" -1' + SHINES, "a.pbrt:{}: the radius of a sphere"),
        (
            '\nMaterial "diffuse" "rgb reflectance" [2 2 2]' + SHINES,
            "a.pbrt:{}: bsdf 'diffuse'",
        ),
        ('\nShape "plymesh" "string filename" "none.ply"' + SHINES, "a.pbrt:{}: .*none.ply"),
        ('\nLightSource "infinite" "string filename" "none.exr"', "a.pbrt:{}: none.exr"),
        ('\nInclude "none.pbrt"', "a.pbrt:{}: none.pbrt"),
        (
            '\nShape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 7]',
            "a.pbrt:{}: trianglemesh: a triangle",
        ),
    ],
)
def test_what_a_scene_cannot_hold_is_named_with_file_and_line(text, message):
    line = VIEW.count("\n") + 2
    with pytest.raises((mlt.SceneError, mlt.FileError), match=message.format(line)):
        mlt.load(written(VIEW + text))


def test_missing_and_endless_files_are_refused():
    with pytest.raises(mlt.FileError, match="none"):
        mlt.load(written('Include "none.pbrt"'))
    with pytest.raises(mlt.SceneError, match="read already"):
        mlt.load(written('Include "a.pbrt"'))
    with pytest.raises(mlt.UsageError, match="only Mitsuba XML"):
        mlt.load(written(VIEW), depth=3)


FOG = """
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [ .1 .2 .3 ]
    "rgb sigma_s" [ .4 .4 .2 ] "float scale" 2 "float g" .5
"""


def test_media_are_on_the_sides_that_an_interface_names():
    found = read(
        VIEW,
        FOG,
        'AttributeBegin\nMediumInterface "fog" ""\nMaterial "interface"\nShape "sphere"\n',
        'AttributeEnd\nMediumInterface "" "fog"\nShape "sphere" "float radius" 9\n',
        'MediumInterface "fog"\nShape "sphere" "float radius" 2\n',
        LAMP,
    )
    assert not found.warnings
    made = found.scene
    fog = {"type": "ref", "id": "fog-medium"}
    first, second, third = (s for s in made.values() if s in spheres(made))
    assert (first["interior"], first.get("exterior")) == (fog, None)
    assert (second.get("interior"), second["exterior"]) == (None, fog)
    assert not {"interior", "exterior"} & set(third)  # no boundary
    assert made["point-light"]["medium"] == fog
    assert made["fog-medium"] == {
        "type": "homogeneous",
        "sigma_a": colour(0.1, 0.2, 0.3),
        "sigma_s": colour(0.4, 0.4, 0.2),
        "scale": 2.0,
        "phase": {"type": "hg", "g": 0.5},
    }


def spheres(made: dict) -> list[dict]:
    return [s for s in made.values() if isinstance(s, dict) and s.get("type") == "sphere"]


def test_the_camera_is_in_the_medium_that_is_named_before_it():
    parts = (FOG, 'MediumInterface "" "fog"\n', VIEW, FLOOR, LAMP)
    assert read(*parts).scene["camera"]["medium"] == {"type": "ref", "id": "fog-medium"}
    assert mlt.render(mlt.load(written(*parts)), "path", spp=1).any()


def test_smoke_is_a_grid_between_two_corners():
    """The light through it falls off by the sum of its layers, between which pbrt interpolates, as
    it does between the outermost ones and 0 beyond the box.
    """
    grid = """
Translate 0 1 0
MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 1 "integer ny" 1 "integer nz" 3
    "float density" [ .5 0 2 ] "point3 p0" [ -8 -8 -1 ] "point3 p1" [ 8 8 1 ]
    "rgb sigma_a" [ .2 .4 .6 ] "rgb sigma_s" [ 0 0 0 ] "float scale" 1.5
AttributeBegin
MediumInterface "smoke" ""
Material "interface"
Scale 6 6 1
Shape "trianglemesh"
    "point3 P" [ -1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 1 1 ]
    "integer indices" [ 0 2 1 1 2 3  4 5 6 5 7 6  0 4 2 4 6 2
                        1 3 5 5 3 7  0 1 4 1 5 4  2 6 3 6 7 3 ]
AttributeEnd
LightSource "infinite"
"""
    image = mlt.render(mlt.load(written(VIEW, grid)), "path", spp=16)
    centre = image[15, 20]
    # Layers at z = -2/3, 0 and 2/3; at the ends, where the box cuts, half of .5 and of 2.
    layers = [0.25, 0.5, 0, 2, 1]
    widths = [1 / 3, 2 / 3, 2 / 3, 1 / 3]
    depth = sum(w * (a + b) / 2 for w, a, b in zip(widths, layers, layers[1:], strict=False))
    np.testing.assert_allclose(centre, np.exp(-1.5 * depth * np.array([0.2, 0.4, 0.6])), rtol=0.01)


def test_smoke_may_be_in_a_nanovdb_file(nanovdb):
    values = np.random.default_rng(1).random((8, 8, 8))
    Path("smoke.nvdb").write_bytes(nanovdb(values, voxel=0.25, low=(-0.875, 0.125, -0.875)))
    medium = """
Translate 0 1 0
MakeNamedMedium "smoke" "string type" "%s" %s "float g" .3
    "rgb sigma_a" [ .2 .4 .6 ] "rgb sigma_s" [ .4 .4 .6 ] "float scale" 1.5
MediumInterface "smoke" ""
Material "interface"
Shape "sphere"
LightSource "infinite"
"""
    file = '"string filename" "smoke.nvdb"'
    found = read(VIEW, medium % ("nanovdb", file + '"float Lescale" 2'))
    assert ["'Lescale' is left out" in warning for warning in found.warnings] == [True]
    made = found.scene["smoke-medium"]
    assert made["sigma_t"] == made["sigma_t"] | {
        "type": "nanovdb",
        "filename": str(Path("smoke.nvdb").resolve()),
        "grid": "density",
        "scale": colour(*np.add([0.2, 0.4, 0.6], [0.4, 0.4, 0.6])),
    }
    # The voxels of the file are the middles of the cells of a box.
    box = (
        '"point3 p0" [ -1 0 -1 ] "point3 p1" [ 1 2 1 ] "integer nx" 8 "integer ny" 8 "integer nz" 8'
    )
    density = f'"float density" [ {" ".join(map(str, values.T.ravel()))} ]'
    images = [
        mlt.render(mlt.load(written(VIEW, medium % of)), "path", spp=4, seed=1)
        for of in (("nanovdb", file), ("uniformgrid", box + density))
    ]
    np.testing.assert_allclose(images[0].mean((0, 1)), images[1].mean((0, 1)), rtol=1e-3)


def glowing(type: str, *parts: str) -> Imported:
    start = f'MakeNamedMedium "fire" "string type" "{type}" "integer nz" 2 '
    return read(VIEW, start, *parts, FLOOR, LAMP)


def test_homogeneous_media_glow():
    found = read(VIEW, FOG, '"rgb Le" [ 1 2 3 ] "float Lescale" 4', FLOOR, LAMP)
    assert not found.warnings
    assert found.scene["fog-medium"]["emission"] == colour(4, 8, 12)


def test_grids_glow_by_factors_of_a_colour():
    """A spectrum becomes the colour of its light, whose luminance is 1."""
    density = '"float density" [ 1 2 ] "float Lescale" [ 3 .5 ]'

    def emission(*parts: str):
        found = glowing("uniformgrid", *parts)
        assert not found.warnings
        return found.scene["fire-medium"]["emission"]

    data = emission(density, '"rgb Le" [ 1 2 3 ]')["data"]
    np.testing.assert_allclose(data[1:3, 1, 1], [[3, 6, 9], [0.5, 1, 1.5]])
    candle = emission(density, '"blackbody Le" 1900')["data"][1, 1, 1]
    sky = {"type": "constant", "radiance": {"type": "blackbody", "temperature": 1900}}
    scene = {"type": "scene", "sky": sky, "sensor": {"type": "perspective"}}
    light = mlt.render(mlt.load_dict(scene, size=(4, 4)), "path", spp=1).mean((0, 1))
    expected = 3 * light / (light @ [0.2126, 0.7152, 0.0722])
    np.testing.assert_allclose(candle, expected, atol=0.02 * expected.max())
    assert emission('"float density" [ 1 2 ] "rgb Le" [ 1 2 3 ] "float Lescale" 2') == colour(
        2, 4, 6
    )


def test_grids_glow_by_temperatures(nanovdb):
    heat = '"float temperatureoffset" 100 "float temperaturescale" 1.5 "float Lescale" 2'
    expected = {"temperature_offset": 100.0, "temperature_scale": 1.5, "emission_scale": 2.0}
    expected["temperature_normalized"] = True
    found = glowing("uniformgrid", '"float density" [ 1 2 ] "float temperature" [ 900 1200 ]', heat)
    assert not found.warnings
    fire = found.scene["fire-medium"]
    assert expected.items() <= fire.items()
    np.testing.assert_array_equal(fire["temperature"]["data"][:, 1, 1], [0, 900, 1200, 0])
    values = np.full((4, 4, 4), 1000.0)
    Path("fire.nvdb").write_bytes(nanovdb(values) + nanovdb(values, "temperature"))
    found = read(
        VIEW,
        f'MakeNamedMedium "fire" "string type" "nanovdb" "string filename" "fire.nvdb" {heat}\n',
        'MediumInterface "fire" ""\nMaterial "interface"\nShape "sphere"\n',
    )
    fire = found.scene["fire-medium"]
    assert expected.items() <= fire.items()
    assert (fire["temperature"]["grid"], fire["sigma_t"]["grid"]) == ("temperature", "density")


def test_a_grid_of_colours_may_glow():
    parts = '"rgb sigma_a" [ 1 2 3 0 0 0 ]', '"rgb Le" [ 1 2 3 4 5 6 ] "float Lescale" 2'
    fire = glowing("rgbgrid", *parts).scene["fire-medium"]
    np.testing.assert_array_equal(fire["emission"]["data"][1:3, 1, 1], [[1, 2, 3], [4, 5, 6]])
    assert fire["emission_scale"] == 2


def test_fire_is_as_bright_as_pbrt_says():
    """A thick ball of black bodies of 2000 K: their spectra have the value 1 at 1449 nm."""
    ball = """
MakeNamedMedium "fire" "string type" "uniformgrid" "float density" [ 1 ]
    "point3 p0" [ -5000 -5000 -5000 ] "point3 p1" [ 5000 5000 5000 ] "float temperature" [ 2000 ]
    "rgb sigma_a" [ 20 20 20 ] "rgb sigma_s" [ 0 0 0 ]
MediumInterface "fire" ""
Material "interface"
Translate 0 1 0
Shape "sphere"
"""
    image = mlt.render(mlt.load(written(VIEW, ball)), "path", spp=64)
    values = [(wave, planck(wave, 2000) / planck(1449, 2000)) for wave in WAVELENGTHS]
    expected = red_green_blue({"type": "spectrum", "value": values})
    np.testing.assert_allclose(image[15, 20], expected, atol=0.03 * expected[0])


def test_a_grid_of_colours_has_their_sum_and_quotient():
    found = read(
        VIEW,
        'MakeNamedMedium "smoke" "string type" "rgbgrid"\n'
        '"integer nx" 1 "integer ny" 1 "integer nz" 2\n'
        '"rgb sigma_a" [ 1 2 3 0 0 0 ] "rgb sigma_s" [ 1 1 1 0 0 2 ]\n',
        FLOOR,
        LAMP,
    )
    assert not found.warnings
    made = found.scene
    smoke = made["smoke-medium"]
    np.testing.assert_allclose(
        smoke["sigma_t"]["data"][1:3, 1, 1], [[2, 3, 4], [0, 0, 2]], rtol=1e-6
    )
    np.testing.assert_allclose(
        smoke["albedo"]["data"][1:3, 1, 1], [[1 / 2, 1 / 3, 1 / 4], [0, 0, 1]], rtol=1e-6
    )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('MediumInterface "fog" ""', "there is no medium 'fog' above this line"),
        ('MakeNamedMedium "fog" "float g" 0', "the medium 'fog' needs a \"string type\""),
        (
            'MakeNamedMedium "fog" "string type" "uniformgrid" "integer nx" 2 "float density" 1',
            "'density' has 1 values, but nx, ny and nz say 2 x 1 x 1",
        ),
    ],
)
def test_mistakes_in_media_are_named(text, message):
    with pytest.raises(mlt.SceneError, match=message):
        read(VIEW, text)
