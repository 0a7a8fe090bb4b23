"""The extension for Blender: its panel says what of the open scene is left out."""

import importlib.util
import json

import pytest
from blender_run import run

pytestmark = pytest.mark.skipif(
    not importlib.util.find_spec("bpy"), reason="needs bpy (pip install bpy)"
)


@pytest.fixture(scope="module")
def facts(tmp_path_factory) -> dict:
    folder = tmp_path_factory.mktemp("left-out")
    run("blender_left_out.py", folder, user=folder / "user")
    return json.loads((folder / "facts.json").read_text())


def test_nothing_is_said_of_a_scene_that_is_rendered_whole(facts):
    assert facts["plain looked"] == facts["plain rendered"] == ["Nothing is left out."]
    assert facts["plain told"] == []


def test_nothing_is_known_of_a_file_before_it_has_been_looked_through(facts):
    assert facts["plain before"] == facts["rich before"] == ["Not looked for yet."]


@pytest.mark.parametrize(
    "word",
    ["Noise", "stretched", "glow", "Hair", "hidden from", "catchers", "deformed", "shadows",
     "spots", "spread", "with a size"],
)  # fmt: skip
def test_each_thing_that_is_left_out_has_a_sentence(facts, word):
    (sentence,) = (text for text in facts["rich looked"] if word in text)
    assert sentence[0].isupper()
    assert sentence[-1] == "."


def test_the_panel_says_what_a_render_warns_of(facts):
    assert facts["rich looked"] == facts["rich rendered"]
    assert [s[:-1].lower() for s in facts["rich looked"]] == [t.lower() for t in facts["rich told"]]


def test_lines_fit_into_the_panel(facts):
    assert facts["drawn 2000"] == facts["rich rendered"]
    assert max(map(len, facts["drawn 200"])) <= 22
    assert " ".join(facts["drawn 200"]) == " ".join(facts["drawn 2000"])
    assert facts["operators"] == ["pymlt.look"]


def test_a_change_of_the_scene_is_noticed(facts):
    assert facts["changed"] == "The scene has changed since."
