"""The extension for Blender: textures without a counterpart, baked to images."""

import importlib.util
import json
from pathlib import Path

import numpy as np
import pytest
from blender_pictures import assert_alike, picture
from blender_run import run

pytestmark = pytest.mark.skipif(
    not importlib.util.find_spec("bpy"), reason="needs bpy (pip install bpy)"
)


@pytest.fixture(scope="module")
def rendered(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("baking")
    run("blender_baking.py", folder, user=folder / "user")
    return folder


@pytest.fixture(scope="module")
def facts(rendered) -> dict:
    return json.loads((rendered / "facts.json").read_text())


def test_what_is_baked_looks_as_in_cycles(rendered):
    theirs = picture(rendered / "procedural-cycles.exr")
    assert_alike(picture(rendered / "procedural.exr"), theirs)
    with pytest.raises(AssertionError):
        assert_alike(picture(rendered / "procedural-unbaked.exr"), theirs)


def test_nothing_that_is_baked_is_left_out(facts):
    for node in ("Voronoi", "Gradient", "Checker"):
        assert any(node in sentence for sentence in facts["unbaked"])
        assert not any(node in sentence for sentence in facts["baked"])


def test_only_what_is_unknown_is_baked(facts):
    names = ["checks Base Color baked", "floor Base Color baked", "floor Roughness baked"]
    assert [name for name in facts["images"] if "baked" in name] == names


def test_baking_leaves_the_scene_as_it_is(facts):
    assert facts["after"] == facts["before"]


def test_baked_textures_can_be_removed(rendered, facts):
    assert not any("baked" in name for name in facts["left"])
    unbaked, forgotten = (
        picture(rendered / f"procedural-{name}.exr") for name in ("unbaked", "forgotten")
    )
    np.testing.assert_array_equal(forgotten, unbaked)


def test_what_cannot_be_baked_is_told(facts):
    assert facts["failures"] == [
        [],
        [
            "Cube could not be baked: it is hidden.",
            "Text could not be baked: it is no mesh; convert it to one.",
        ],
    ]
