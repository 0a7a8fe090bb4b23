"""The page of what people ask for: each question is complete, and its Python runs."""

import importlib.util
import re
import shlex
from pathlib import Path

import pytest

import pymlt as mlt

IMAGES = Path(__file__).resolve().parents[2] / "docs" / "images"
PAGE = (IMAGES.parent / "rendered-here.md").read_text()
SECTIONS = {part.splitlines()[0]: part for part in PAGE.split("\n## ")[1:]}
IN_PYTHON = [title for title, section in SECTIONS.items() if "```python" in section]


@pytest.fixture(scope="module")
def maker():
    """The script that makes the page's pictures."""
    spec = importlib.util.spec_from_file_location("maker", IMAGES / "make_rendered_here.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("title", SECTIONS)
def test_a_question_has_a_program_a_small_picture_and_what_both_cost(title, maker):
    section = SECTIONS[title]
    (name,) = re.findall(maker.PICTURE, section)
    picture = f"here-{name}.jpg"
    assert picture in shlex.join(maker.programs(section)[-1])
    assert (IMAGES / picture).stat().st_size <= 60_000
    assert 320 <= mlt.read_image(IMAGES / picture).shape[1] <= 480
    (said,) = maker.MEASURED.findall(section)
    assert re.search(r"\d+ s of CPU time on one thread of a machine with \d+ cores; ", said)
    assert "What is not as good: " in section


def test_what_is_said_of_a_render_is_what_it_says_itself(maker):
    stats = {"error": 0.216, "spp_done": 38.3, "tours_waiting": 0.021}
    said = maker.measured(8.6, stats)
    assert "*9 s of CPU time" in said
    assert "; 38 samples per pixel, error 22 %, 2 % of the light yet to come.*" in said
    assert "error 2.9 %.*" in maker.measured(8.6, {"error": 0.0288, "spp_done": 187})


@pytest.mark.parametrize("title", IN_PYTHON)
def test_the_python_of_a_question_runs(title, maker, tmp_path, monkeypatch):
    """On small images, so that it takes no time."""
    code = re.search(r"```python\n(.*?)```", SECTIONS[title], re.DOTALL)[1]
    if ".denoise()" in code:
        pytest.importorskip("pyoidn")
    load_dict = mlt.load_dict
    monkeypatch.setattr(mlt, "load_dict", lambda scene, size: load_dict(scene, size=(24, 16)))
    monkeypatch.chdir(tmp_path)
    exec(compile(re.sub(r"(spp|time)=\d+", "spp=1", code), title, "exec"), {})
    assert [path.suffix for path in tmp_path.iterdir()] == [".jpg"]
