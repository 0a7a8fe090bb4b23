"""Files that no reader knows are refused by their kind, with what to do instead."""

import json
from pathlib import Path

import pytest

import pymlt as mlt
from pymlt import cli
from pymlt.scenes.kinds import EXTENSIONS, OTHERS

KNOWN_ELSEWHERE = {  # what is said of a file, and what to do with it
    ".fbx": ("Autodesk FBX", "import it into Blender and export it as glTF"),
    ".abc": ("Alembic", "import it into Blender and export it as glTF"),
    ".blend": ("a scene of Blender", "export it from Blender as glTF .*, or render it there"),
    ".max": ("a scene of 3ds Max", "export it from 3ds Max as glTF"),
    ".c4d": ("a scene of Cinema 4D", "export it from Cinema 4D as glTF"),
    ".dae": ("COLLADA", "convert it to glTF, for example by `assimp export"),
    ".stp": ("STEP", r"export it from the CAD program, .* as glTF \(.glb\), .obj or .stl"),
    ".OFF": ("a mesh in the Object File Format", "convert it to glTF"),
}


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("extension", KNOWN_ELSEWHERE)
def test_files_of_other_programs_are_named_with_what_to_make_of_them(extension):
    kind, advice = KNOWN_ELSEWHERE[extension]
    name = f"a{extension}"
    Path(name).write_bytes(b"\0\1\2")
    for read in (mlt.load, mlt.load_file, mlt.render, lambda path: mlt.convert(path, "a.xml")):
        with pytest.raises(mlt.UsageError, match=f"^{name}: {kind}.* is not read here; {advice}"):
            read(name)


COMMANDS = {"render": ["-o", "a.exr"], "info": [], "convert": ["b.xml"]}


@pytest.mark.parametrize("command", COMMANDS)
def test_the_command_line_says_it_in_one_line(command, capsys):
    Path("a.fbx").write_bytes(b"Kaydara")
    assert cli.main([command, "a.fbx", *COMMANDS[command]]) == 2
    said = capsys.readouterr().err
    assert said.startswith("pymlt: a.fbx: Autodesk FBX is not read here; ")
    assert said.count("\n") == 1


def test_a_file_that_is_not_there_is_missing_whatever_its_kind():
    for read in (mlt.load, mlt.load_file):
        with pytest.raises(mlt.FileError, match=r"none\.fbx: there is no such file"):
            read("none.fbx")


def test_load_file_says_what_reads_a_file_that_is_no_mitsuba_scene():
    Path("a.gltf").write_text(json.dumps({"asset": {"version": "2.0"}}))
    with pytest.raises(mlt.UsageError, match=r"a\.gltf: load_file reads Mitsuba XML; load reads"):
        mlt.load_file("a.gltf")


def test_no_kind_is_both_read_and_refused_or_refused_twice():
    refused = [extension for extensions in OTHERS for extension in extensions]
    assert len(set(refused)) == len(refused)
    assert not {other for other in refused for known in EXTENSIONS if known.endswith(other)}
    assert not {known for known in (*EXTENSIONS, ".xml") for other in refused if known == other}
