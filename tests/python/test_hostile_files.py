"""Scenes of other programs that are made to hang, eat memory or crash: one line, exit code 2."""

import base64
import gzip
import json
import os
from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt
from pymlt import cli
from pymlt.formats import limits
from pymlt.formats.files import read_foreign
from pymlt.formats.imported import Imported

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
HUGE = 2**40


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    os.mkfifo("fifo")
    os.mkfifo("fifo.ply.gz")
    Path("folder").mkdir()
    with open("sparse.bin", "wb") as file:
        file.truncate(HUGE)


def refused(name: str, message: str, capsys):
    """What the command line says of a file."""
    assert cli.main(["info", name]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert message in said
    assert len(said) < 2000


# ---- glTF ----------------------------------------------------------------------------------------


def data_uri(content: bytes) -> str:
    return "data:application/octet-stream;base64," + base64.b64encode(content).decode()


def gltf(**changed) -> dict:
    """A triangle."""
    return {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [accessor()],
        "bufferViews": [view()],
        "buffers": [{"uri": data_uri(CORNERS.tobytes()), "byteLength": 36}],
    } | changed


def accessor(**changed) -> dict:
    return {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"} | changed


def view(**changed) -> dict:
    return {"buffer": 0, "byteLength": 36} | changed


def sparse(kind=5123, **changed) -> dict:
    """An accessor whose first row is that of a buffer."""
    given = {"count": 1, "indices": {"bufferView": 0, "componentType": kind}}
    return accessor(sparse=given | {"values": {"bufferView": 0}} | changed)


def uri(text: str) -> dict:
    return gltf(buffers=[{"uri": text, "byteLength": 36}])


def light(**changed) -> dict:
    name = "KHR_lights_punctual"
    given = {"lights": [{"type": "point"} | changed]}
    return gltf(nodes=[{"extensions": {name: {"light": 0}}}], extensions={name: given})


def primitive(**changed) -> dict:
    return gltf(meshes=[{"primitives": [{"attributes": {"POSITION": 0}} | changed]}])


def emitting(strength) -> dict:
    name = "KHR_materials_emissive_strength"
    extension = {name: {"emissiveStrength": strength}}
    material = {"emissiveFactor": [1, 1, 1], "extensions": extension}
    return primitive(material=0) | {"materials": [material]}


GLTF = {
    "each node has two parents": (
        gltf(nodes=[{"children": [i + 1, i + 1]} for i in range(40)] + [{}]),
        "two parents",
    ),
    "two parents": (gltf(nodes=[{"children": [1, 2]}, {"children": [2]}, {}]), "two parents"),
    "below itself": (gltf(nodes=[{"children": [1]}, {"children": [0]}]), "below itself"),
    "shown twice": (gltf(scenes=[{"nodes": [0, 0]}]), "two parents"),
    "negative node": (gltf(scenes=[{"nodes": [-1]}]), "glTF.scenes[0].nodes[0] is -1"),
    "negative mesh": (gltf(nodes=[{"mesh": -1}]), "glTF.nodes[0].mesh is -1"),
    "no such scene": (gltf(scene=1), "scene 1 is not among the 1 of the file"),
    "no such light": (gltf(nodes=light()["nodes"]), "contradicts itself"),
    "no such material": (primitive(material=0), "material 0 is not among the 0"),
    "count": (gltf(accessors=[accessor(count=HUGE)]), "beyond its bufferView"),
    "zeros": (gltf(accessors=[accessor(bufferView=None, count=HUGE)]), "and no buffer view"),
    "byteOffset": (gltf(accessors=[accessor(byteOffset=1)]), "beyond its bufferView"),
    "negative": (gltf(accessors=[accessor(byteOffset=-12)]), "byteOffset is -12"),
    "view": (gltf(bufferViews=[view(byteOffset=1)]), "bufferView 0 reaches beyond its buffer"),
    "view length": (gltf(bufferViews=[view(byteLength=HUGE)]), "beyond its buffer"),
    "stride": (gltf(bufferViews=[view(byteStride=HUGE)]), "beyond its bufferView"),
    "overlap": (gltf(bufferViews=[view(byteStride=1)]), "byteStride is too small"),
    "sparse": (gltf(accessors=[sparse(count=HUGE)]), "beyond its bufferView"),
    "sparse of floats": (gltf(accessors=[sparse(5126)]), "should be unsigned integers"),
    "sparse of signed": (gltf(accessors=[sparse(5122)]), "should be unsigned integers"),
    "endless": (uri("/dev/zero"), "/dev/zero: cannot read it: it is not a regular file"),
    "fifo": (uri("fifo"), "fifo: cannot read it: it is not a regular file"),
    "folder": (uri("folder"), "folder: cannot read it: it is a folder"),
    "sparse file": (uri("sparse.bin"), "it has more than"),
    "no file": (uri("none"), "none: there is no such file"),
    "no data": (uri("data:,"), "beyond its buffer"),
    "bad data": (uri("data:;base64,=a"), "contradicts itself"),
    "text": (gltf(nodes=[{"mesh": "0"}]), "glTF.nodes[0].mesh is '0', but should be an index"),
    "long text": (gltf(nodes=[{"mesh": "0" * 10**6}]), "but should be an index"),
    "no index": (gltf(nodes=[{"mesh": True}]), "mesh is True"),
    "texts": (gltf(nodes=[{"translation": ["0", "0", "0"]}]), "should be a number"),
    "one number": (gltf(nodes=[{"translation": 1}]), "no glTF 2.0 file"),
    "infinite": (gltf(nodes=[{"mesh": 0, "scale": [1e400, 1, 1]}]), "scale[0] is inf"),
    "overflow": (gltf(nodes=[{"mesh": 0, "rotation": [1e300] * 4}]), "contradicts itself"),
    "attribute": (primitive(attributes={"POSITION": "0"}), "should be an index"),
    "name": (gltf(nodes=[{"mesh": 0, "name": 7}]), "name is 7, but should be a text"),
    "light": (light(intensity="a", color=[10**9] * 3), "should be a number"),
    "glow": (emitting("a"), "emissiveStrength is 'a', but should be a number"),
    "a list": ([], "no glTF 2.0 file"),
    "other version": (gltf(asset={"version": "1.0"}), "no glTF 2.0 file"),
}


@pytest.mark.parametrize("name", GLTF)
def test_hostile_gltf_files_are_refused(name, capsys):
    content, message = GLTF[name]
    Path("a.gltf").write_text(json.dumps(content))
    refused("a.gltf", message, capsys)


def test_the_triangle_that_hostile_files_change_is_read():
    Path("a.gltf").write_text(json.dumps(gltf(accessors=[sparse()])))
    assert len(read_foreign("a.gltf").scene) == 4  # its type, the triangle, a camera and a light


def test_deep_json_and_long_integers_are_refused(capsys):
    for text in ("[" * 10**5, '{"asset": ' + "9" * 10_000):
        Path("a.gltf").write_text(text)
        refused("a.gltf", "no glTF 2.0 file", capsys)


@pytest.mark.parametrize("name", ["fifo.glb", "fifo.gltf", "fifo.pbrt"])
def test_a_scene_is_a_regular_file(name, capsys):
    os.rename("fifo", name)
    refused(name, "it is not a regular file", capsys)


def test_long_chains_of_nodes_are_read():
    nodes = [{"children": [i + 1]} for i in range(3000)] + [{"mesh": 0}]
    Path("a.gltf").write_text(json.dumps(gltf(nodes=nodes)))
    assert "node-3000" in read_foreign("a.gltf").scene


def test_many_plugins_of_one_name_get_names_of_their_own():
    made = Imported()
    assert [made.name(name) for name in ("a", "a", "a_2", "a")] == ["a", "a_2", "a_2_2", "a_3"]
    assert len({made.name("a") for _ in range(100_000)}) == 100_000
    assert len(made.name("b" * 10**6)) == 100


def test_without_a_scene_each_node_is_read_once():
    Path("a.gltf").write_text(json.dumps(gltf(nodes=[{"children": [1]}, {"mesh": 0}], scenes=[])))
    assert [name for name in read_foreign("a.gltf").scene if "node" in name] == ["node-1"]


def test_a_mesh_counts_each_time_that_it_is_used(monkeypatch, capsys):
    monkeypatch.setattr(limits, "MEMORY", 20_000)
    Path("a.gltf").write_text(json.dumps(gltf()))
    read_foreign("a.gltf")
    Path("a.gltf").write_text(json.dumps(gltf(nodes=[{"mesh": 0}] * 20, scenes=[])))
    refused("a.gltf", "takes more than 20000 bytes of memory", capsys)


def test_large_images_are_not_taken_apart(monkeypatch, capsys):
    monkeypatch.setattr(limits, "PIXELS", 100)
    mlt.write_image("a.png", np.zeros((10, 11), np.float32))
    pbr = {"metallicRoughnessTexture": {"index": 0}}
    content = primitive(material=0) | {"materials": [{"pbrMetallicRoughness": pbr}]}
    content |= {"textures": [{"source": 0}], "images": [{"uri": "a.png"}]}
    Path("a.gltf").write_text(json.dumps(content))
    refused("a.gltf", "a.gltf: image 0: is 11 x 10 pixels large; at most 100", capsys)
    Path("a.pbrt").write_text('LightSource "infinite" "string filename" "a.png"')
    refused("a.pbrt", "a.png: is 11 x 10 pixels large; at most 100 pixels", capsys)


# ---- pbrt ----------------------------------------------------------------------------------------

MIXES = 'MakeNamedMaterial "m0" "string type" "diffuse"\n' + "".join(
    f'MakeNamedMaterial "m{i + 1}" "string type" "mix" "string materials" ["m{i}" "m{i}"]\n'
    for i in range(40)
)
BOARDS = 'Texture "t0" "spectrum" "constant" "rgb value" [1 1 1]\n' + "".join(
    f'Texture "t{i + 1}" "spectrum" "checkerboard" "texture tex1" "t{i}" "texture tex2" "t{i}"\n'
    for i in range(40)
)
SCALES = 'Texture "t0" "spectrum" "imagemap" "string filename" "a.png"\n' + "".join(
    f'Texture "t{i + 1}" "spectrum" "scale" "texture tex" "t{i}" "float scale" .9\n'
    for i in range(200)
)
PBRT = {
    "itself": ('Include "a.pbrt"', "a.pbrt:1: 'a.pbrt' is being read already"),
    "endless": ('Include "/dev/zero"', "/dev/zero: cannot read it: it is not a regular file"),
    "fifo": ('Include "fifo"', "fifo: cannot read it: it is not a regular file"),
    "folder": ('Include "folder"', "folder: cannot read it: it is a folder"),
    "large": ('Include "sparse.bin"', "sparse.bin: cannot read it: it has more than"),
    "mesh": ('Shape "plymesh" "string filename" "fifo"', "fifo: cannot read it"),
    "packed mesh": ('Shape "plymesh" "string filename" "fifo.ply.gz"', "fifo.ply.gz: cannot read"),
    "image": (
        'Material "diffuse" "string normalmap" "/dev/zero" Shape "sphere"',
        "/dev/zero: cannot read it",
    ),
    "sky": ('LightSource "infinite" "string filename" "fifo"', "fifo: cannot read it"),
    "mixes": (MIXES, "more than 1000 parts"),
    "textures": (BOARDS, "more than 1000 parts"),
    "long chains": (SCALES, "nested more than 100 deep"),
    "blocks": ("AttributeBegin\n" * 10**5, "a.pbrt:101: blocks are nested more than 100 deep"),
    "objects": ('ObjectBegin "a"\nObjectBegin "b"', "a.pbrt:2: an object is defined inside"),
    "instances": ('ObjectBegin "a"\nObjectInstance "a"', "a.pbrt:2: an object is placed inside"),
    "long word": ('Material "' + "a" * 10**6 + '"', "a word has more than 1000 characters"),
    "nan": ('Shape "sphere" "float radius" nan', "'nan' is not a number"),
    "inf": ('Shape "sphere" "float radius" -inf', "'-inf' is not a number"),
    "integer": ('Sampler "x" "integer pixelsamples" 1' + "0" * 400, "is not a number"),
    "large integer": ('Sampler "x" "integer pixelsamples" 1e300 Camera "perspective"', "64 bits"),
    "index": (
        'Shape "trianglemesh" "point3 P" [0 0 0] "integer indices" [1e300 0 0]',
        "makes no sense",
    ),
    "large vertex": (
        'Camera "perspective" Shape "trianglemesh" "point3 P" [0 0 0 1e300 0 0 0 1 0]',
        "is not finite",
    ),
    "overflow": ("Scale 1e300 1 1\nScale 1e300 1 1", "a.pbrt:2: Scale makes no sense"),
    "flat": ('Scale 0 1 1\nCamera "perspective"', "a.pbrt:2: Camera makes no sense"),
    "NUL": ('Include "a\0b"', "a.pbrt:1: "),
    "missing": ('Texture "a" "float" "constant" "float value" []', "a.pbrt:1: "),
}


@pytest.mark.parametrize("name", PBRT)
def test_hostile_pbrt_files_are_refused(name, capsys):
    content, message = PBRT[name]
    Path("a.pbrt").write_text(content)
    refused("a.pbrt", message, capsys)


def test_includes_are_counted(capsys):
    for i in range(14):
        Path(f"{i}.pbrt").write_text(f'Include "{i + 1}.pbrt"\n' * 8)
    Path("14.pbrt").write_text("")
    refused("0.pbrt", "there are more than 10000 includes", capsys)
    for i in range(20):
        Path(f"{i}.pbrt").write_text(f'Include "{i + 1}.pbrt"\n')
    refused("0.pbrt", "files include each other more than 15 deep", capsys)


def test_texts_that_include_each_other_are_limited_together(monkeypatch, capsys):
    monkeypatch.setattr(limits, "TEXT", 1000)
    Path("b.pbrt").write_text("#" * 500)
    Path("a.pbrt").write_text('Include "b.pbrt"\n')
    read_foreign("a.pbrt")
    Path("a.pbrt").write_text('Include "b.pbrt"\n' * 2)
    refused("a.pbrt", "the files have more than 1000 bytes together", capsys)


@pytest.mark.parametrize("name", ["a.pbrt.gz", "a.ply.gz"])
def test_what_unpacks_without_end_is_refused(name, monkeypatch, capsys):
    monkeypatch.setattr(limits, "TEXT", 1000)
    Path(name).write_bytes(gzip.compress(bytes(1001)))
    Path("a.pbrt").write_text(
        f'Include "{name}"' if "pbrt" in name else f'Shape "plymesh" "string filename" "{name}"'
    )
    refused("a.pbrt", f"{name}: unpacks to more than 1000 bytes", capsys)
    Path(name).write_bytes(gzip.compress(bytes(10))[:-9] + b"123456789")
    refused("a.pbrt", f"{name}: cannot be unpacked", capsys)


def test_a_chain_of_textures_within_the_limits_is_read():
    lines = SCALES.replace("imagemap", "constant").splitlines(keepends=True)
    Path("a.pbrt").write_text(
        "".join(lines[:90]) + 'Material "diffuse" "texture reflectance" "t89"'
    )
    read_foreign("a.pbrt")


# ---- Mitsuba -------------------------------------------------------------------------------------


def nested(first: str, level: str) -> str:
    """Forty levels, each of which refers twice to the one before it."""
    levels = [level.format(i + 1, i) for i in range(40)]
    return f'<scene version="3.0.0">{first}{"".join(levels)}<sensor type="perspective"/></scene>'


def test_branching_references_are_refused(capsys):
    blend = '<bsdf type="blendbsdf" id="m{0}"><ref id="m{1}"/><ref id="m{1}"/></bsdf>'
    board = '<texture type="checkerboard" id="m{0}"><ref name="color0" id="m{1}"/>'
    board += '<ref name="color1" id="m{1}"/></texture>'
    shape = '<shape type="sphere"><emitter type="area"/>{}</shape>'
    surface = '<ref id="m40"/>'
    texture = '<bsdf type="diffuse"><ref name="reflectance" id="m40"/></bsdf>'
    for first, level, use in (
        ('<bsdf type="dielectric" id="m0"/>', blend, surface),
        ('<texture type="checkerboard" id="m0"/>', board, texture),
    ):
        text = nested(first, level).replace("</scene>", shape.format(use) + "</scene>")
        Path("a.xml").write_text(text)
        refused("a.xml", "is made of more than 1000 parts", capsys)


def test_large_files_are_refused(capsys):
    Path("a.xml").write_text('<scene version="3.0.0"><include filename="sparse.bin"/></scene>')
    refused("a.xml", "sparse.bin: cannot read it: it has more than 268435456 bytes", capsys)
    with pytest.raises(mlt.FileError, match="it has more than"):
        mlt.read_image("sparse.bin")


def test_the_texts_of_a_scene_are_limited_together(capsys):
    Path("b.xml").write_text(f'<scene version="3.0.0"><!--{" " * 2**26}--></scene>')
    include = '<include filename="b.xml"/>'
    Path("a.xml").write_text(f'<scene version="3.0.0">{include * 4}</scene>')
    refused("a.xml", "b.xml: with it the files of the scene have more than 268435456", capsys)
