"""Scenes of other programs whose files are not there: one error names all of them."""

import json
from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt

ABSENT = "there is no such file"
SQUARE = 'Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0] "integer indices" [0 1 2]\n'
SCENE = """LookAt 0 1 4  0 1 0  0 1 0
Camera "perspective"
WorldBegin
LightSource "infinite" "string filename" "sky.exr"
Texture "wood" "spectrum" "imagemap" "string filename" "wood.png"
Texture "unused" "spectrum" "imagemap" "string filename" "unused.png"
Material "diffuse" "texture reflectance" "wood"
Shape "plymesh" "string filename" "a.ply"
Shape "plymesh" "string filename" "a.ply"
Shape "plymesh" "string filename" "b.ply.gz"
AttributeBegin
AreaLightSource "diffuse" "float power" 1
Shape "plymesh" "string filename" "lamp.ply"
AttributeEnd
ObjectBegin "part"
Shape "plymesh" "string filename" "part.ply"
ObjectEnd
ObjectInstance "part"
Include "more.pbrt"
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def the_error(name: str) -> str:
    with pytest.raises(mlt.FileError) as caught:
        mlt.load(name)
    return str(caught.value)


def test_all_missing_files_of_a_pbrt_scene_are_named_with_their_lines():
    Path("a.pbrt").write_text(SCENE)
    parts = the_error("a.pbrt").split("; ")
    folder = Path.cwd()
    assert parts == [
        f"a.pbrt:4: sky.exr: {ABSENT}",
        f"line 7: {folder}/wood.png: {ABSENT}",
        f"line 8: {folder}/a.ply: {ABSENT}",
        f"line 10: b.ply.gz: {ABSENT}",
        f"line 13: {folder}/lamp.ply: {ABSENT}",
        f"line 16: {folder}/part.ply: {ABSENT}",
        f"line 19: more.pbrt: {ABSENT}",
    ]
    with pytest.raises(mlt.FileError, match=r"a\.pbrt:4: sky\.exr"):
        mlt.convert("a.pbrt", "a.xml")


def test_files_of_an_included_file_have_its_name():
    Path("more.pbrt").write_text('Include "none.pbrt"\n')
    Path("a.pbrt").write_text('Include "more.pbrt"\nInclude "other.pbrt"\n')
    expected = [f"a.pbrt:2: other.pbrt: {ABSENT}", f"more.pbrt:1: none.pbrt: {ABSENT}"]
    assert the_error("a.pbrt").split("; ") == expected


def test_what_a_missing_file_would_have_defined_is_no_other_error():
    Path("a.pbrt").write_text('Include "materials.pbrt"\nWorldBegin\nNamedMaterial "clay"\n')
    assert the_error("a.pbrt") == f"a.pbrt:1: materials.pbrt: {ABSENT}"


def test_many_missing_files_are_counted():
    lines = [f'Shape "plymesh" "string filename" "{i}.ply"\n' for i in range(25)]
    Path("a.pbrt").write_text("WorldBegin\n" + "".join(lines))
    said = the_error("a.pbrt")
    assert said.count(ABSENT) == 20
    assert said.endswith("; and 5 more")


def test_files_that_are_there_are_not_missing():
    Path("more.pbrt").write_text(SQUARE)
    Path("a.pbrt").write_text('Camera "perspective"\nWorldBegin\nInclude "more.pbrt"\n')
    with pytest.warns(UserWarning, match="no light"):
        assert mlt.load("a.pbrt").info()["triangles"] == 1


def test_all_missing_files_of_a_gltf_scene_are_named():
    pytest.importorskip("pygltflib", reason="needs pymlt[gltf]")
    images = [{"uri": uri} for uri in ("b%20c.png", "there.png", "data:image/png;base64,AA==")]
    corners = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
    scene = {
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [corners],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"uri": "a.bin", "byteLength": 36}],
        "images": images,
    }
    Path("a.gltf").write_text(json.dumps(scene))
    Path("there.png").write_bytes(b"")
    assert the_error("a.gltf") == f"a.gltf: a.bin: {ABSENT}; b c.png: {ABSENT}"
    Path("a.bin").write_bytes(np.eye(3, dtype="<f4").tobytes())
    with pytest.warns(UserWarning, match="no camera|no light"):  # nothing shows the images
        assert mlt.load("a.gltf").info()["triangles"] == 1
