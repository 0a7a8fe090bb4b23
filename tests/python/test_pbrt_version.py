"""Which version of pbrt a file is of."""

import numpy as np
import pytest
from pbrt_v3_files import read, written

import pymlt as mlt


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


OF_V3 = {
    "film": 'Film "image"',
    "sampler": 'Sampler "02sequence"',
    "integrator": 'Integrator "directlighting"',
    "material": 'WorldBegin Material "matte"',
    "named": 'WorldBegin MakeNamedMaterial "a" "string type" "uber"',
    "medium": 'MakeNamedMedium "a" "string type" "heterogeneous" "float density" 1',
    "shape": 'WorldBegin Shape "cone"',
    "colour": 'WorldBegin LightSource "point" "color I" [ 1 1 1 ]',
    "xyz": 'WorldBegin LightSource "point" "xyz I" [ 1 1 1 ]',
    "point": 'WorldBegin LightSource "point" "point from" [ 1 1 1 ]',
    "black body": 'WorldBegin LightSource "point" "blackbody I" [ 5000 1 ]',
    "truth": 'WorldBegin Shape "sphere" "bool x" "true"',
    "map": 'WorldBegin LightSource "infinite" "string mapname" "a.exr"',
    "texture": 'WorldBegin Texture "a" "color" "constant"',
    "end": "WorldBegin\nWorldEnd",
}
OF_V4 = {
    "film": 'Film "rgb"',
    "material": 'WorldBegin Material "diffuse"',
    "named": 'WorldBegin MakeNamedMaterial "a" "string type" "conductor"',
    "medium": 'MakeNamedMedium "a" "string type" "uniformgrid" "float density" 1',
    "attribute": 'WorldBegin Attribute "shape" "float radius" 2',
    "truth": 'WorldBegin Shape "sphere" "bool x" true',
    "neither": 'WorldBegin Shape "sphere" "float radius" 2',
}
BALL = 'LightSource "infinite"\nMaterial "mirror"\nShape "sphere"\n'  # a mirror, in pbrt-v3 alone


def is_v3(text: str) -> bool:
    return "the material 'mirror' has no counterpart; it becomes diffuse" not in read(text).warnings


@pytest.fixture
def map_of_light():
    mlt.write_image("a.exr", np.ones((4, 8, 3), np.float32))


@pytest.mark.usefixtures("map_of_light")
@pytest.mark.parametrize("sign", OF_V3)
def test_what_only_pbrt_v3_has_tells_its_files(sign):
    assert is_v3(OF_V3[sign] + "\n" + BALL)


@pytest.mark.parametrize("sign", sorted(set(OF_V4) - {"neither"}))
def test_what_only_pbrt_v4_has_tells_its_files(sign):
    assert not is_v3(OF_V4[sign] + "\n" + BALL)


def test_a_file_without_a_sign_is_of_pbrt_v4():
    assert "PixelFilter" not in str(read(OF_V4["neither"]).warnings)
    made = read('Camera "perspective"', OF_V4["neither"])
    assert "rfilter" not in made.scene["camera"].get("film", {})  # in pbrt-v3 it is a box


def test_comments_and_names_are_no_signs():
    text = (
        '# Film "image" Material "matte" "color Kd" [ 1 1 1 ]\nTexture "matte" "float" "constant"'
    )
    assert not is_v3(text + '\nFilm "rgb"\n' + BALL)
    for named in ('Texture "color" "spectrum" "constant"', 'MakeNamedMedium "a" "string type" "x"'):
        assert not is_v3(named + '\nFilm "rgb"\n' + BALL)
    clear = 'MakeNamedMaterial "glass" "string type" "dielectric"\n'
    assert not is_v3(clear + BALL)
    red = 'MakeNamedMaterial "diffuse" "string type" "matte"\n'
    assert is_v3(red + BALL)


@pytest.mark.parametrize("how", ["Include", "Import"])
def test_files_that_are_included_tell_the_version_too(how):
    written(OF_V3["film"] if how == "Include" else OF_V4["material"], name="part.pbrt")
    assert is_v3(f'{how} "part.pbrt"\n' + BALL) == (how == "Include")


def test_the_first_sign_decides():
    assert is_v3('Film "image"\nWorldBegin Material "diffuse"\n' + BALL)
    assert not is_v3('Film "rgb"\nWorldBegin Material "matte"\n' + BALL)


OTHERS = {  # the version of a file, and what it has of the other one
    3: ('Film "image"\nMaterial "diffuse" "rgb reflectance" [ 1 1 1 ]', ["diffuse", "reflectance"]),
    4: ('Film "rgb"\nMaterial "diffuse" "color Kd" [ 1 1 1 ]', ["color", "Kd"]),
}


@pytest.mark.parametrize("version", OTHERS)
def test_what_is_of_the_other_version_is_named(version):
    text, names = OTHERS[version]
    said = f"is of another version, and the file is read as one of pbrt-v{version}"
    found = read(text).placed_warnings("a.pbrt")
    assert {warning for warning in found if said in warning} == {
        f"a.pbrt:2: {name!r} {said}" for name in names
    }


@pytest.mark.parametrize("end", ['Include "a.pbrt"', 'Include "none.pbrt"', 'Shape "sphere'])
def test_what_cannot_be_read_is_an_error_with_its_line(end):
    with pytest.raises((mlt.SceneError, mlt.FileError), match=r"^a\.pbrt:2: "):
        read("WorldBegin\n" + end)
