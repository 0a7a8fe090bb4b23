"""Errors of the command line name --lenient where it would help, and only there."""

from pathlib import Path

import pytest

from pymlt import cli

ADVICE = "; --lenient leaves out what is unknown here\n"
VIEW = """<sensor type="perspective"><film type="hdrfilm">
<integer name="width" value="4"/><integer name="height" value="4"/></film></sensor>
<emitter type="constant"/>"""
UNKNOWN = '<float name="gloss" value="1"/>'
HELPED = {
    "parameter": f'<shape type="sphere">{UNKNOWN}</shape>',
    "texture": '<shape type="sphere"><bsdf type="diffuse">'
    '<texture type="checkerboard" name="stains"/></bsdf></shape>',
    "two": f'<shape type="sphere">{UNKNOWN}</shape><shape type="cube">{UNKNOWN}</shape>',
    "integrator": '<integrator type="sppm"/><shape type="sphere"/>',
    "parameter of an integrator": f'<integrator type="path">{UNKNOWN}</integrator>'
    '<shape type="sphere"/>',
}
NOT_HELPED = {
    "plug-in": f'<shape type="sphere">{UNKNOWN}<bsdf type="hair"/></shape>',
    "misspelt": '<shape type="sphere"><float name="radus" value="1"/></shape>',
    "misspelt integrator": '<integrator type="pathh"/><shape type="sphere"/>',
    "value": '<shape type="sphere"><float name="radius" value="-1"/></shape>',
}


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def render(content: str, *flags: str) -> int:
    Path("a.xml").write_text(f'<scene version="3.0.0">{VIEW}{content}</scene>')
    return cli.main(["render", "a.xml", "--quiet", "--spp", "1", "-o", "a.exr", *flags])


@pytest.mark.parametrize("name", HELPED)
def test_leniency_is_named_where_the_scene_is_then_rendered(name, capsys):
    assert render(HELPED[name]) == 2
    said = capsys.readouterr().err
    assert said.startswith("pymlt: a.xml:")
    assert said.endswith(ADVICE)
    assert render(HELPED[name], "--lenient") == 0


@pytest.mark.parametrize("name", NOT_HELPED)
def test_leniency_is_not_named_where_the_scene_is_refused_all_the_same(name, capsys):
    assert render(NOT_HELPED[name]) == 2
    assert "--lenient" not in capsys.readouterr().err
    assert render(NOT_HELPED[name], "--lenient") == 2


def test_leniency_is_not_named_to_those_who_have_chosen_or_who_ask_for_what_is_not_there(capsys):
    assert render(HELPED["parameter"], "--strict") == 2
    assert render('<shape type="sphere"/>', "--integrator", "sppm") == 2
    assert render('<shape type="sphere"/>', "--integrator", "path", "-p", "gloss=1") == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 3
    assert "--lenient" not in said


def test_pymlt_info_names_it_too(capsys):
    Path("a.xml").write_text(f'<scene version="3.0.0">{VIEW}{HELPED["two"]}</scene>')
    assert cli.main(["info", "a.xml"]) == 2
    assert capsys.readouterr().err.endswith(ADVICE)
