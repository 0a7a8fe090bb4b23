"""The gallery: one short script for each topic of the lecture, each of which draws a figure.

The scripts lie in docs/gallery of the repository, and in the package once it is installed. They are
meant to be read and changed; `pymlt lab NAME` runs one.
"""

from __future__ import annotations

import ast
import runpy
import warnings
from pathlib import Path
from typing import Any

from .. import _core
from .._extras import import_extra

BLUE, ORANGE, GREEN, RED, GREY = "#2f6db5", "#d9822b", "#3a9a62", "#c23b34", "#7a7a7a"


def names() -> list[str]:
    """The names of the scripts."""
    return sorted(file.stem for file in _directory().glob("*.py"))


def script(name: str) -> Path:
    """The file of a script."""
    known = names()
    if name not in known:
        raise _core.UsageError(f"unknown figure {name!r}{_core.suggestion(name, known)}")
    return _directory() / f"{name}.py"


def title(name: str) -> str:
    """What a script is about: the first line of its documentation."""
    return ast.get_docstring(ast.parse(script(name).read_text())).splitlines()[0]


def style() -> None:
    """The look of the figures; each script calls it first."""
    pyplot = pyplot_module()
    pyplot.rcParams.update(
        {
            "axes.grid": True,
            "axes.prop_cycle": pyplot.cycler(color=[BLUE, ORANGE, GREEN, RED, GREY]),
            "axes.spines.right": False,
            "axes.spines.top": False,
            "axes.titlesize": 11,
            "figure.constrained_layout.use": True,
            "figure.dpi": 100,
            "font.size": 10,
            "grid.alpha": 0.25,
            "legend.frameon": False,
            "savefig.dpi": 150,
        }
    )


def draw(name: str):
    """Run a script and return its (last) figure."""
    pyplot = pyplot_module()
    with pyplot.rc_context(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*non-interactive")
        runpy.run_path(str(script(name)), run_name="__main__")
        if not pyplot.get_fignums():
            raise _core.UsageError(f"{script(name)} draws no figure")
        return pyplot.figure(pyplot.get_fignums()[-1])


def pyplot_module() -> Any:
    return import_extra("matplotlib.pyplot", "plots", "the gallery")


def _directory() -> Path:
    here = Path(__file__).resolve()
    installed = here.parents[1] / "gallery"
    for directory in (installed, here.parents[3] / "docs" / "gallery"):
        if directory.is_dir():
            return directory
    raise _core.FileError(f"{installed}: the gallery is not installed")
