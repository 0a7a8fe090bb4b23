"""A part of a scene in the place of a scene: the error has a scene in which it has its place."""

import ast
import re

import pytest
import tiny

import pymlt as mlt
from pymlt import _core
from pymlt.scenes.parts import HOMES

#: What the parts need that nothing else tells.
NEEDS = {
    "heterogeneous": {"albedo": 0.5, "sigma_t": {"type": "constvolume", "value": 1.0}},
    "constvolume": {"value": 1.0},
}
PARTS = {
    "diffuse": "bsdf",
    "constant": "emitter",
    "area": "emitter",
    "hdrfilm": "film",
    "path": "integrator",
    "homogeneous": "medium",
    "heterogeneous": "medium",
    "hg": "phase",
    "box": "rfilter",
    "independent": "sampler",
    "orthographic": "sensor",
    "sphere": "shape",
    "checkerboard": "texture",
    "constvolume": "volume",
}


def error_of(given: dict) -> str:
    with pytest.raises(mlt.SceneError) as caught:
        mlt.load_dict(given)
    return str(caught.value)


@pytest.mark.parametrize("kind", PARTS)
def test_the_scene_in_the_error_about_a_part_is_one(kind):
    part = {"type": kind} | NEEDS.get(kind, {})
    said = error_of(part)
    assert said.startswith(f"scene: {kind!r} is the type of a part, {PARTS[kind]}, and not of")
    example = re.search(r"as in (\{.*\}), and needs a sensor, light and shapes$", said)[1]
    written = example.replace(f"{{'type': {kind!r}, ...}}", repr(part))
    scene = ast.literal_eval(written.removesuffix(", ...}") + "}")
    rest = {key: value for key, value in tiny.scene().items() if key not in scene}
    mlt.load_dict(rest | scene)


def test_every_family_has_its_place():
    assert HOMES.keys() == set(_core.families())
    assert set(PARTS.values()) == HOMES.keys()


def test_parts_are_named_wherever_a_scene_is_expected(tmp_path):
    for use in (mlt.render, lambda part: mlt.convert(part, tmp_path / "a.xml")):
        with pytest.raises(mlt.SceneError, match="'sphere' is the type of a part, shape"):
            use({"type": "sphere"})


def test_a_scene_without_its_type_is_told_to_add_it():
    scene = tiny.scene()
    del scene["type"]
    assert error_of(scene) == "scene: needs a 'type'; add 'type': 'scene'"
    assert error_of({}) == "scene: needs a 'type'"
    assert error_of({"type": "nothing"}) == "scene: 'type' is 'nothing', but should be 'scene'"
