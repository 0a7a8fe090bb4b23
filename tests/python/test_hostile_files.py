"""Scenes of pbrt and Mitsuba that are made to hang, eat memory or crash: one line, exit code 2."""

import gzip
from pathlib import Path

import pytest
from hostile_files import make_places, refused

import pymlt as mlt
from pymlt.formats import limits
from pymlt.formats.files import read_foreign


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    make_places()


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
    "link": ('Include "loop"', "a.pbrt:1: Include makes no sense"),
    "link to a mesh": (
        'Shape "plymesh" "string filename" "loop"',
        "a.pbrt:1: Shape makes no sense",
    ),
    "folder": ('Include "folder"', "folder: cannot read it: it is a folder"),
    "large": ('Include "sparse.bin"', "sparse.bin: cannot read it: it has more than"),
    "mesh": ('Shape "plymesh" "string filename" "fifo"', "fifo: cannot read it"),
    "packed mesh": ('Shape "plymesh" "string filename" "fifo.ply.gz"', "fifo.ply.gz: cannot read"),
    "image": (
        'Material "diffuse" "string normalmap" "/dev/zero" Shape "sphere"',
        "/dev/zero: cannot read it",
    ),
    "sky": ('LightSource "infinite" "string filename" "fifo"', "fifo: cannot read it"),
    "map": ('LightSource "infinite" "string mapname" "fifo"', "fifo: cannot read it"),
    "spectrum": (
        'Material "metal" "spectrum eta" "sparse.bin" "spectrum k" "sparse.bin"',
        "sparse.bin: cannot read it: it has more than",
    ),
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
