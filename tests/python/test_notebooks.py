"""The notebooks of the documentation run from top to bottom, and warn of nothing."""

import json
import warnings
from pathlib import Path

import pytest

NOTEBOOKS = sorted((Path(__file__).parents[2] / "docs" / "notebooks").glob("*.ipynb"))

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


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda p: p.stem)
def test_a_notebook_runs_without_warnings(path, shell, capsys):
    notebook = json.loads(path.read_text())
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert all(cell["outputs"] == [] for cell in cells)  # nothing that can be out of date
    if any("mlt.view" in "".join(cell["source"]) for cell in cells):
        pytest.importorskip("viser", reason="the notebook shows the live view")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for cell in cells:
            shell.run_cell("".join(cell["source"])).raise_error()
    assert "Warning" not in capsys.readouterr().err
