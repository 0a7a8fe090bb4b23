"""The pictures of docs/openpbr.md, and the script that makes them."""

import importlib.util
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
SPEC = importlib.util.spec_from_file_location("spheres", DOCS / "examples/openpbr_spheres.py")
spheres = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(spheres)


@pytest.mark.parametrize("name", spheres.ROWS)
def test_each_row_has_its_picture_above_its_table(name):
    page = (DOCS / "openpbr.md").read_text()
    assert f"(images/openpbr-{name}.jpg)\n\n{spheres.table(name)}\n\n" in page
    assert (DOCS / f"images/openpbr-{name}.jpg").stat().st_size <= 60_000


@pytest.mark.parametrize("name", spheres.ROWS)
def test_a_row_of_spheres_is_a_scene(name):
    floor_and_lamps = 3
    assert spheres.scene(name).info()["shapes"] == 6 + floor_and_lamps
