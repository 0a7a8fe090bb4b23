"""glTF files, compared with the same scenes written as dicts."""

import json
import pickle
import sys
from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt
from pymlt import cli
from pymlt.formats.files import read_foreign
from pymlt.formats.gltf.glow import mean_radiance

gl = pytest.importorskip("pygltflib", reason="needs pymlt[gltf]")

from gltf_files import CORNERS, GltfFile, converted  # noqa: E402

T = mlt.Transform
SIZE = (40, 30)
HALF = np.sqrt(0.5)
DOWN = [-HALF, 0, 0, HALF]  # a quarter turn about x: +z becomes +y, -z becomes -y
DIRECT = mlt.Path(max_depth=2)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def colour(*values) -> dict:
    return {"type": "rgb", "value": list(values)}


def surface(**values) -> dict:
    given = {"type": "openpbr", "specular_roughness": 1.0}
    return {"type": "twosided", "bsdf": given | values}


def scene_dict(**more) -> dict:
    """A floor below a camera 4 behind and 1 above it, and what else there is."""
    sensor = {
        "type": "perspective",
        "fov": 40.0,
        "fov_axis": "y",
        "to_world": T.look_at(origin=[0, 1, 4], target=[0, 1, 0], up=[0, 1, 0]),
        "film": {"type": "hdrfilm", "width": 960, "height": 720},
    }
    floor = {
        "type": "rectangle",
        "to_world": T().translate(0, 0.2, 0).rotate([1, 0, 0], -90).scale(2, 1.5, 1),
        "bsdf": surface(base_color=colour(0.8, 0.5, 0.2), specular_roughness=0.4),
    }
    return {"type": "scene", "sensor": sensor, "floor": floor} | more


def floor_file(**material) -> GltfFile:
    file = GltfFile()
    paint = {"colour": (0.8, 0.5, 0.2, 1), "roughness": 0.4} | material
    mesh = file.mesh(file.material(**paint))
    child = file.node(root=False, mesh=mesh, scale=[2, 1.5, 1])
    file.node(translation=[0, 0.2, 0], rotation=DOWN, children=[child])
    file.camera(translation=[0, 1, 4], scale=[3, 3, 3])
    return file


def assert_same(a, b, spp=4, integrator=DIRECT):
    images = [mlt.render(scene, integrator, spp=spp, seed=1) for scene in (a, b)]
    assert images[1].max() > 0.05
    # The two meshes may round a ray at an edge differently.
    differ = ~np.isclose(*images, rtol=2e-3, atol=1e-5).all(axis=2)
    assert differ.mean() < 0.01


WATT = 683  #: lumens

LIGHTS = {
    "point": (
        {"type": "point", "color": [1, 0.5, 0.2], "intensity": 6 * WATT},
        {"translation": [0.5, 1.5, 0]},
        {"type": "point", "intensity": colour(6, 3, 1.2), "position": [0.5, 1.5, 0]},
    ),
    "directional": (
        {"type": "directional", "intensity": 2 * WATT},
        {"rotation": DOWN},
        {"type": "directional", "irradiance": 2.0, "direction": [0, -1, 0]},
    ),
    "spot": (
        {
            "type": "spot",
            "intensity": 9 * WATT,
            "spot": {"outerConeAngle": np.radians(35), "innerConeAngle": np.radians(20)},
        },
        {"translation": [0, 2, 0], "rotation": DOWN},
        {
            "type": "spot",
            "intensity": 9.0,
            "cutoff_angle": 35.0,
            "beam_width": 20.0,
            "to_world": T.look_at(origin=[0, 2, 0], target=[0, 0, 0], up=[0, 0, 1]),
        },
    ),
}


@pytest.mark.parametrize("name", LIGHTS)
def test_lights_cameras_and_nodes_are_placed(name, recwarn):
    given, place, expected = LIGHTS[name]
    file = floor_file()
    file.light(given, **place)
    read = mlt.load(file.save("a.glb"), size=SIZE)
    assert_same(read, mlt.load_dict(scene_dict(lamp=expected), size=SIZE))
    assert len(recwarn) == (name == "spot")
    assert (mlt.load("a.glb").width, mlt.load("a.glb").height) == (960, 720)


def test_emission_and_indirect_light():
    file = floor_file()
    extension = {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}
    glow = file.material(emissiveFactor=[1, 0.8, 0.5], colour=(0, 0, 0, 1), extensions=extension)
    half = [HALF, 0, 0, HALF]
    file.node(mesh=file.mesh(glow), translation=[0, 2, 0], rotation=half, scale=[0.5, 0.5, 0.5])
    lamp = {
        "type": "rectangle",
        "to_world": T().translate(0, 2, 0).rotate([1, 0, 0], 90).scale(0.5),
        "bsdf": surface(base_color=colour(0, 0, 0)),
        "emitter": {"type": "area", "radiance": colour(8, 6.4, 4)},
    }
    a, b = mlt.load(file.save("a.glb"), size=SIZE), mlt.load_dict(scene_dict(lamp=lamp), size=SIZE)
    images = [mlt.render(scene, "path", spp=400, seed=seed) for seed, scene in enumerate((a, b))]
    assert images[0].mean(axis=(0, 1)) == pytest.approx(images[1].mean(axis=(0, 1)), rel=0.01)
    blocks = [image.reshape(3, 10, 4, 10, 3).mean(axis=(1, 3)) for image in images]
    assert blocks[0] == pytest.approx(blocks[1], rel=0.05, abs=1e-3)


CODES = np.array([[[255, 0, 0, 255], [0, 255, 0, 255]], [[0, 0, 255, 0], [128, 128, 128, 255]]])


def test_textures_are_the_right_way_up_and_tinted():
    file = GltfFile()
    info = file.texture(CODES, magFilter=gl.NEAREST, wrapS=gl.CLAMP_TO_EDGE)
    file.node(mesh=file.mesh(file.material(colour=(0.5, 1, 1, 1), baseColorTexture=info)))
    file.camera(translation=[0, 0, 4])
    file.light({"type": "directional", "intensity": 3})
    image = mlt.render(mlt.load(file.save("a.glb"), size=(41, 41)), DIRECT, spp=16)
    # v = 0 is the first row of the image; the rectangle has v = 0 below, u = 0 on the left.
    corners = {(28, 12): 0, (28, 28): 1, (12, 12): 2}
    for (y, x), channel in corners.items():
        assert image[y, x].argmax() == channel
        others = np.delete(image[y, x], channel)
        assert others.max() < 0.5 * image[y, x].max()  # white is what the surface reflects
    grey = image[12, 28] - image[12, 28].min()
    assert grey[0] < 0.1 * grey[1] == pytest.approx(0.1 * grey[2], rel=1e-3)


def test_packed_textures_are_taken_apart():
    file = GltfFile()
    codes = np.zeros((2, 2, 4), np.uint8)
    codes[..., 1], codes[..., 2], codes[..., 3] = 51, 255, 255
    packed = file.texture(codes)
    file.node(mesh=file.mesh(file.material(packed=packed, roughness=0.5, metallic=1.0)))
    bsdf = converted(file).scene["material-0"]["bsdf"]
    for name, value in {"specular_roughness": 0.1, "base_metalness": 1.0}.items():
        assert bsdf[name]["raw"] is True
        assert bsdf[name]["data"] == pytest.approx(value, abs=1e-5)


def test_normals_alpha_and_extensions_of_materials():
    file = GltfFile()
    base, normals = file.texture(CODES), file.texture(np.full((2, 2, 4), 128))
    bent = gl.NormalMaterialTexture(index=normals.index, scale=2.0)
    extensions = {
        "KHR_materials_ior": {"ior": 1.33},
        "KHR_materials_transmission": {"transmissionFactor": 0.75},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25},
        "KHR_materials_volume_scatter": {},
    }
    file.material(baseColorTexture=base, normalTexture=bent, alphaMode="MASK", alphaCutoff=0.4)
    file.material(extensions=extensions, alphaMode="BLEND", colour=(1, 1, 1, 0.5))
    for index in range(2):
        file.node(mesh=file.mesh(index))
    made = converted(file)
    cut, clear = made.scene["material-0"], made.scene["material-1"]
    assert cut["type"] == "mask"
    assert cut["bsdf"]["bsdf"]["type"] == "normalmap"
    assert cut["opacity"]["data"].tolist() == [[1, 1], [0, 1]]
    assert clear["opacity"] == 0.5
    expected = {
        "type": "openpbr",
        "specular_ior": 1.33,
        "transmission_weight": 0.75,
        "coat_weight": 0.5,
        "coat_roughness": 0.25,
    }
    assert clear["bsdf"].items() >= expected.items()
    assert "KHR_materials_volume_scatter is left out" in made.warnings
    assert "the scale of normal textures is left out" in made.warnings
    mlt.render(mlt.load_dict(made.scene, size=SIZE), spp=1)


@pytest.mark.parametrize(
    ("mode", "indices"), [(gl.TRIANGLE_STRIP, (0, 1, 3, 2)), (gl.TRIANGLE_FAN, None)]
)
def test_strips_and_fans_and_numbers_of_all_kinds(mode, indices):
    whole, other = floor_file(), floor_file()
    uvs = np.array([[0, 0], [255, 0], [255, 255], [0, 255]], np.uint8)
    mesh = other.mesh(0, mode=mode, indices=indices, uvs=other.accessor(uvs, normalized=True))
    other.gltf.nodes[0].mesh = mesh
    lamp = {"type": "directional", "intensity": 2 * WATT}
    for name, file in {"a.glb": whole, "b.gltf": other}.items():
        file.light(lamp, rotation=DOWN)
        file.save(name)
    assert json.loads(Path("b.gltf").read_text())["asset"]["version"] == "2.0"
    assert_same(mlt.load("a.glb", size=SIZE), mlt.load("b.gltf", size=SIZE))


def test_sparse_accessors():
    whole, other = floor_file(), floor_file()
    rows = other.view(np.array([2], np.uint16).tobytes())
    values = other.view(np.array([3, 3, 0], np.float32).tobytes())
    other.gltf.accessors[0].sparse = gl.Sparse(
        count=1,
        indices=gl.AccessorSparseIndices(bufferView=rows, componentType=gl.UNSIGNED_SHORT),
        values=gl.AccessorSparseValues(bufferView=values),
    )
    for name, file in {"a.glb": whole, "b.glb": other}.items():
        made = read_foreign(file.save(name))
        assert made.scene["node-0"]["type"] == "mesh"
    a, b = (mlt.load_dict(read_foreign(f"{n}.glb").scene) for n in "ab")
    assert b.info()["radius"] > a.info()["radius"]


# ---- what is added to files without light ------------------------------------------------------

SKY, SUN, SUNBEAM = 0.15, 3.0, np.array([1.0, -1.5, -1.2])


@pytest.mark.parametrize("behind", [False, True])
def test_a_white_model_without_lamps_differs_from_its_background(behind):
    file = GltfFile()
    turned = {"rotation": [0, 1, 0, 0]} if behind else {}
    mesh = file.mesh(file.material(colour=(0, 0, 0, 1)))
    file.gltf.meshes[mesh].primitives[0].material = None
    file.node(mesh=mesh)
    file.camera(translation=[0, 0, -4 if behind else 4], **turned)
    with pytest.warns(UserWarning, match="there is no light; an even sky and a sun are added"):
        scene = mlt.load(file.save("a.glb"), size=SIZE)
    image = mlt.render(scene, DIRECT, spp=256, seed=1)
    # The horizontal part of the beam makes an angle with the view, which is the same from behind.
    across, along = SUNBEAM[[0, 2]] @ [[2, 1], [-1, 2]] / np.sqrt(5)
    assert across > 0  # the sun is on the left
    lit = SKY + SUN * -along / np.linalg.norm(SUNBEAM) / np.pi
    assert image[0, 0] == pytest.approx(SKY, rel=1e-3)
    assert image[13:17, 18:22].mean() == pytest.approx(lit, rel=0.02)


def test_a_lone_mesh_has_the_same_light_as_a_file_without_lamps():
    file = GltfFile()
    file.node(mesh=file.mesh())
    made = converted(file).scene
    Path("a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    alone = read_foreign("a.obj").scene
    for name in ("sky", "sun"):
        assert made[name] == alone[name]
    assert alone["sun"]["direction"] == pytest.approx(SUNBEAM.tolist(), abs=1e-12)


def test_a_lone_mesh_in_a_file_of_scenes_gives_one_warning():
    file = GltfFile()
    file.node(mesh=file.mesh())
    assert converted(file).warnings == [
        "there is no light, and there is no camera; an even sky, a sun and a camera that sees "
        "everything are added"
    ]
    file.light({"type": "point"}, translation=[0, 2, 0])
    assert converted(file).warnings == [
        "there is no camera; a camera that sees everything is added"
    ]


def room(emission: float, *, texture=None) -> GltfFile:
    """Two squares of area 4 and 396, of which the first emits."""
    file = GltfFile()
    glow = {"KHR_materials_emissive_strength": {"emissiveStrength": emission}}
    info = {"emissiveTexture": file.texture(texture)} if texture is not None else {}
    lamp = file.material(emissiveFactor=[1, 0.5, 0.3], extensions=glow, **info)
    file.node(mesh=file.mesh(lamp), translation=[0, 0, 1], rotation=[0, 1, 0, 0])
    file.node(mesh=file.mesh(file.material()), scale=[np.sqrt(99), np.sqrt(99), 1])
    return file


DOTS = np.zeros((10, 10, 4), np.uint8)
DOTS[..., 3] = 255
DOTS[:2, 0, :3] = 255  # two texels of a hundred


@pytest.mark.parametrize(
    ("strength", "texture", "mean"),
    [(10, None, 0.06), (2, None, 0.012), (10, DOTS, 0.0012), (200, DOTS, 0.024)],
)
def test_what_glows_lights_a_scene_alone_if_it_is_strong_enough(strength, texture, mean):
    made = converted(room(strength, texture=texture))
    shapes = [made.scene[f"node-{i}"] for i in range(2)]
    assert mean_radiance(shapes) == pytest.approx(mean, rel=1e-5)
    said = "what glows is too weak to light the scene, and there is no camera; an even sky"
    assert (said in made.warnings[0]) == (mean < 0.02)
    assert {"sky", "sun"} & made.scene.keys() == ({"sky", "sun"} if mean < 0.02 else set())


def test_beside_a_lamp_what_glows_is_no_reason_for_a_sun():
    file = room(0.1)
    file.light({"type": "point"}, name="lamp")
    assert {"sky", "sun"}.isdisjoint(converted(file).scene)


# ---- the rest of the interface -----------------------------------------------------------------


def test_a_converted_scene_is_the_same_scene(capsys):
    file = floor_file()
    codes = np.full((2, 2, 4), 200, np.uint8)
    file.node(mesh=file.mesh(file.material(packed=file.texture(codes), metallic=1.0)))
    file.light(LIGHTS["spot"][0], translation=[0, 2, 0], rotation=DOWN)
    file.save("a.glb")
    assert cli.main(["convert", "a.glb", "b.xml"]) == 0
    assert "spot light falls off" in capsys.readouterr().err
    with pytest.warns(UserWarning, match="spot"):
        assert_equal(mlt.load_file("b.xml", size=SIZE), mlt.load("a.glb", size=SIZE))
    assert "/" not in Path("b.xml").read_text().split("<shape")[1].split("/>")[0]


def assert_equal(converted, loaded) -> None:
    for key in ("shapes", "triangles", "emitters", "bytes", "center", "radius"):
        assert converted.info()[key] == loaded.info()[key]
    images = [mlt.render(scene, "path", spp=2, seed=1) for scene in (converted, loaded)]
    np.testing.assert_array_equal(*images)


def test_loading_writes_no_files(monkeypatch):
    monkeypatch.setenv("TMPDIR", "/nowhere")
    file = floor_file(baseColorTexture=None)
    packed = file.texture(np.full((2, 2, 4), 200, np.uint8))
    file.node(mesh=file.mesh(file.material(packed=packed, metallic=1.0)))
    file.light({"type": "point"}, translation=[0, 2, 0])
    file.save("a.glb")
    scene = mlt.load("a.glb", size=SIZE)
    assert [path.name for path in Path().iterdir()] == ["a.glb"]
    Path("a.glb").unlink()
    edited = scene.updated({"material-0.bsdf.specular_roughness": 0.9})
    assert edited.info()["triangles"] == scene.info()["triangles"]


def test_the_command_line_renders_it_and_resumes(capsys):
    floor_file().save("a.glb")
    flags = ["--spp", "2", "--integrator", "path", "--size", "16x12"]
    checkpoint = ["--checkpoint", "c.ckpt"]
    assert cli.main(["render", "a.glb", *flags, *checkpoint, "-o", "a.exr"]) == 0
    assert "a.glb: there is no light; an even sky and a sun" in capsys.readouterr().err
    assert mlt.read_image("a.exr").mean() > 0.1
    assert cli.main(["info", "a.glb"]) == 0
    more = ["--resume", "c.ckpt", "--spp", "4", "-o", "b.exr"]
    assert cli.main(["render", "a.glb", *more]) == 0
    with pytest.warns(UserWarning, match="no light"):
        expected = mlt.render(mlt.load("a.glb", size=(16, 12)), "path", spp=4)
    assert np.array_equal(mlt.read_image("b.exr"), expected.astype(np.float16))


def test_what_has_no_counterpart_is_named():
    file = GltfFile()
    file.node(mesh=file.mesh(None, mode=gl.LINES))
    colours = file.accessor(np.full((4, 4), 0.5, np.float32))
    paint = file.material(
        baseColorTexture=file.texture(CODES), doubleSided=True, emissiveFactor=[1, 1, 1]
    )
    file.node(mesh=file.mesh(paint, COLOR_0=colours))
    file.gltf.animations.append(gl.Animation())
    with pytest.warns(UserWarning, match=r"a\.glb: ") as found:
        scene = mlt.load(file.save("a.glb"), size=SIZE)
    said = " ".join(str(warning.message) for warning in found)
    coloured = "colours of vertices", "alpha of vertices"
    for word in ("points and lines", *coloured, "animations", "no camera", "side of their normals"):
        assert word in said
    assert (mlt.render(scene, "path", spp=4) > 0.1).any()


def test_extensions_that_are_not_read_are_named_wherever_they_stand():
    file = GltfFile()
    info = file.texture(CODES)
    info.extensions = {"EXT_of_texture": {}}
    mesh = file.mesh(file.material(baseColorTexture=info, extensions={"EXT_of_material": {}}))
    file.gltf.meshes[mesh].primitives[0].extensions = {"EXT_of_primitive": {}}
    file.node(mesh=mesh, extensions={"KHR_node_visibility": {"visible": False}})
    file.light({"type": "point"})
    file.gltf.extensionsUsed += ["EXT_of_nothing", "KHR_mesh_quantization"]
    unread = {f"EXT_of_{name}" for name in ("texture", "material", "primitive", "nothing")}
    unread.add("KHR_node_visibility")
    found = [text for text in converted(file).warnings if text.endswith("is left out")]
    assert sorted(found) == sorted(f"{name} is left out" for name in unread)


def test_a_scene_can_be_sent_to_other_processes():
    file = floor_file(baseColorTexture=None)
    file.node(mesh=file.mesh(file.material(baseColorTexture=file.texture(CODES))))
    file.light({"type": "point"}, translation=[0, 2, 0])
    scene = mlt.load(file.save("a.glb"), size=SIZE)
    assert pickle.loads(pickle.dumps(scene)).hash == scene.hash


def test_mistakes_are_named_with_their_file():
    Path("a.gltf").write_text('{"asset":\n{"version" "2.0"}}')
    with pytest.raises(mlt.SceneError, match=r"^a.gltf:2: "):
        mlt.load("a.gltf")
    camera = {"type": "perspective", "perspective": {"yfov": 40, "znear": 0.1}}
    scene = {"asset": {"version": "2.0"}, "nodes": [{"camera": 0}], "cameras": [camera]}
    Path("a.gltf").write_text(json.dumps(scene))
    with pytest.raises(mlt.SceneError, match=r"^a.gltf: scene\['node-0'\]: .*'fov'"):
        mlt.load("a.gltf")
    file = floor_file()
    file.save("b.gltf")
    broken = json.loads(Path("b.gltf").read_text())
    broken["buffers"][0]["uri"] = "none.bin"
    Path("b.gltf").write_text(json.dumps(broken))
    with pytest.raises(mlt.FileError, match=r"^b.gltf: none.bin: "):
        mlt.load("b.gltf")


@pytest.mark.parametrize("name", ["a.glb", "a.gltf"])
def test_other_files_are_refused(name, capsys):
    Path(name).write_bytes(b"This is no scene.")
    with pytest.raises(mlt.SceneError, match="no glTF"):
        mlt.load(name)
    with pytest.raises(mlt.FileError, match="no such file"):
        mlt.load(f"none-{name}")
    assert cli.main(["convert", name, "b.xml"]) == 2
    assert not Path("b.xml").exists()
    assert cli.main(["render", name, "-o", "b.exr", "-D", "a=1"]) == 2
    assert capsys.readouterr().err.count("\n") == 2


@pytest.mark.parametrize("name", ["KHR_draco_mesh_compression", "EXT_meshopt_compression"])
def test_compressed_meshes_are_refused_with_what_undoes_it(name):
    file = floor_file()
    file.gltf.extensionsRequired = [name]
    file.save("compressed.glb")
    with pytest.raises(mlt.SceneError, match=f"{name}.*gltf-transform copy"):
        mlt.load("compressed.glb")


@pytest.mark.parametrize("fallback", [False, True])
def test_meshes_that_are_also_compressed_are_read_where_they_are_not(fallback):
    file = floor_file()
    file.gltf.extensionsUsed = ["KHR_draco_mesh_compression"]
    primitive = file.gltf.meshes[0].primitives[0]
    primitive.extensions = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}}
    if not fallback:
        file.gltf.accessors[primitive.indices].bufferView = None
        with pytest.raises(mlt.SceneError, match=r"a\.glb: needs KHR_draco.*gltf-transform copy"):
            converted(file)
        return
    made = converted(file)
    np.testing.assert_allclose(made.scene["node-0"]["vertices"], CORNERS)
    assert not [text for text in made.warnings if "draco" in text]


@pytest.mark.parametrize("fallback", [False, True])
def test_buffers_that_stand_for_compressed_ones_are_read_if_they_hold_something(fallback):
    file = floor_file()
    file.gltf.extensionsUsed = ["EXT_meshopt_compression"]
    file.save("a.gltf")
    given = json.loads(Path("a.gltf").read_text())
    buffer = given["buffers"][0]
    buffer["extensions"] = {"EXT_meshopt_compression": {"fallback": True}}
    if not fallback:
        del buffer["uri"]
    Path("a.gltf").write_text(json.dumps(given))
    if fallback:
        np.testing.assert_allclose(read_foreign("a.gltf").scene["node-0"]["vertices"], CORNERS)
        return
    with pytest.raises(mlt.SceneError, match=r"a\.gltf: needs EXT_meshopt.*gltf-transform copy"):
        read_foreign("a.gltf")


def test_files_that_contradict_themselves_are_refused():
    required = floor_file()
    required.gltf.extensionsRequired = ["KHR_draco_mesh_compression"]
    required.save("required.glb")
    short = floor_file()
    short.gltf.accessors[0].count = 10_000
    short.save("short.glb")
    missing = floor_file()
    missing.gltf.nodes[0].mesh = 7
    missing.save("missing.glb")
    turn = floor_file()
    turn.gltf.nodes[0].rotation = [0, 0, 1]
    turn.save("turn.glb")
    circle = floor_file()
    circle.gltf.nodes[0].children = [1]
    circle.save("circle.glb")
    messages = {
        "required": "KHR_draco",
        "short": "beyond its buffer",
        "missing": "mesh 7 is not among the 1 of the file",
        "turn": "contradicts itself",
        "circle": "below itself",
    }
    for name, message in messages.items():
        with pytest.raises(mlt.SceneError, match=message):
            mlt.load(f"{name}.glb")


@pytest.mark.parametrize(("source", "target"), [("a.fbx", "b.xml"), ("a.glb", "b.json")])
def test_only_known_formats_are_converted(source, target):
    floor_file().save("a.glb")
    with pytest.raises(mlt.UsageError):
        mlt.convert(source, target)


def test_without_the_package_it_says_what_to_install(monkeypatch):
    floor_file().save("a.glb")
    monkeypatch.setitem(sys.modules, "pygltflib", None)
    with pytest.raises(mlt.UsageError, match="pip install 'pygltflib>="):
        mlt.load("a.glb")
