"""The notebooks of the documentation run from top to bottom, and warn of nothing.

Exercises say that nothing is filled in yet, and solutions that all is right.
"""

import json
import re
import warnings
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
EXERCISES = sorted(DOCS.glob("course/exercises/*.ipynb"))
NOTEBOOKS = sorted(DOCS.glob("notebooks/*.ipynb")) + EXERCISES

shell_module = pytest.importorskip("IPython.core.interactiveshell")


@pytest.fixture
def shell(tmp_path, monkeypatch):
    """Such as a notebook has, without its front end."""
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    made = shell_module.InteractiveShell()
    made.history_manager.enabled = False
    yield made
    made.reset(new_session=False)


def test_there_are_notebooks():
    assert len(NOTEBOOKS) >= 2
    names = {path.stem for path in EXERCISES}
    assert {f"{name}-solution" for name in names if not name.endswith("-solution")} <= names


def code_cells(path) -> list[dict]:
    cells = json.loads(path.read_text())["cells"]
    return [cell for cell in cells if cell["cell_type"] == "code"]


def test_the_first_light_path_is_worth_seeing(shell):
    """As the text beside it says: floor, wall and ball, which more than one technique finds."""
    for cell in code_cells(DOCS / "notebooks" / "light-paths.ipynb")[:2]:
        shell.run_cell("".join(cell["source"])).raise_error()
    path = shell.user_ns["path"]
    assert path.signature == "LDDSSE"
    assert sorted(path.weights())[-2] > 0.1


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_a_notebook_runs_without_warnings(path, shell, capsys):
    cells = code_cells(path)
    assert all(cell["outputs"] == [] for cell in cells)  # nothing that can be out of date
    if any("mlt.view" in "".join(cell["source"]) for cell in cells):
        pytest.importorskip("viser", reason="the notebook shows the live view")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for cell in cells:
            shell.run_cell("".join(cell["source"])).raise_error()
    said = capsys.readouterr()
    assert "Warning" not in said.err
    if path in EXERCISES:
        answers = re.findall(r": (not yet|right|WRONG)$", said.out, re.MULTILINE)
        expected = "right" if path.stem.endswith("-solution") else "not yet"
        assert set(answers) == {expected}, said.out
