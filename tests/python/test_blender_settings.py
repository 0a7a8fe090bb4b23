"""The settings of the extension for Blender, read without Blender."""

import ast
from pathlib import Path

import pymlt as mlt

SETTINGS = Path(__file__).parents[2] / "blender" / "settings.py"


def test_every_integrator_has_a_place_in_files_of_blender():
    (places,) = (
        ast.literal_eval(node.value)
        for node in ast.parse(SETTINGS.read_text()).body
        if isinstance(node, ast.Assign) and node.targets[0].id == "PLACES"
    )
    assert sorted(places) == sorted(mlt.available("integrator"))
