"""glTF files that are made to hang, eat memory or crash: one line, exit code 2."""

import base64
import json
import os
from pathlib import Path

import numpy as np
import pytest
from hostile_files import HUGE, make_places, refused

import pymlt as mlt
from pymlt.formats import limits
from pymlt.formats.files import read_foreign
from pymlt.formats.imported import Imported

pytest.importorskip("pygltflib", reason="needs pymlt[gltf]")

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    make_places()


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
    return extended("emissive_strength", {"emissiveStrength": strength})


def extended(name: str, given) -> dict:
    """A triangle that glows, whose material has an extension."""
    material = {"emissiveFactor": [1, 1, 1], "extensions": {f"KHR_materials_{name}": given}}
    return primitive(material=0) | {"materials": [material]}


def coated(texture) -> dict:
    return extended("clearcoat", {"clearcoatFactor": 1, "clearcoatTexture": texture})


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
    "link": (uri("loop"), "loop: cannot read it"),
    "folder": (uri("folder"), "folder: cannot read it: it is a folder"),
    "sparse file": (uri("sparse.bin"), "it has more than"),
    "NUL": (uri("sparse.bin%00"), "the name of a file holds a NUL"),
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
    "extension": (extended("sheen", [1]), "KHR_materials_sheen is [1], but should be an object"),
    "texture": (coated(3), "clearcoatTexture is 3, but should be an object"),
    "no texture": (coated({}), "texture None is not among the 0 of the file"),
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
    assert len(read_foreign("a.gltf").scene) == 5  # its type, the triangle, a camera, sky and sun


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
