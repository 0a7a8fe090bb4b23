"""The gallery: one short script for each topic of the lecture, each of which draws a figure.

The scripts lie in docs/gallery of the repository, and in the package once it is installed. They are
meant to be read and changed; `pymlt lab NAME` runs one.
"""

from __future__ import annotations

import ast
import os
import runpy
import sys
import warnings
from pathlib import Path

from . import _core

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
    pyplot = _pyplot()
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
    pyplot = _pyplot()
    with pyplot.rc_context(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*non-interactive")
        runpy.run_path(str(script(name)), run_name="__main__")
        if not pyplot.get_fignums():
            raise _core.UsageError(f"{script(name)} draws no figure")
        return pyplot.figure(pyplot.get_fignums()[-1])


def add_command(commands, add) -> None:
    """The subcommand `pymlt lab`."""
    c = add(commands, "lab", _lab, "Run a script of the gallery: show its figure, or save it.")
    c.add_argument("name", metavar="NAME", nargs="?", help="as --list names them")
    c.add_argument("--list", action="store_true", help="list the scripts")
    c.add_argument("-o", "--output", metavar="FILE", help="save the figure, such as figure.png")


def _lab(args) -> int:
    if args.list or args.name is None:
        if args.name or args.output or not args.list:
            raise _core.UsageError("lab needs --list or the name of a script; see pymlt lab --help")
        print("\n".join(f"{name:15} {title(name)}" for name in names()))
        return 0
    script(args.name)  # known, before matplotlib is imported
    output = args.output
    if output:
        _check_output(output)
        _use_no_window()
    figure = draw(args.name)
    if not output and not _has_window():
        output = f"{args.name}.png"
    if output:
        figure.savefig(output)
        print(f"pymlt: {output}", file=sys.stderr)
    _pyplot().close(figure)
    return 0


def _check_output(path: str) -> None:
    _core.check_file_writable(path)
    suffix = os.path.splitext(path)[1].lstrip(".").lower()
    known = _pyplot().Figure().canvas.get_supported_filetypes()
    if suffix not in known:
        raise _core.UsageError(
            f"{path}: a figure cannot be saved as {suffix!r}{_core.suggestion(suffix, list(known))}"
        )


def _use_no_window() -> None:
    _pyplot().switch_backend("agg")


def _has_window() -> bool:
    from matplotlib import get_backend
    from matplotlib.backends import BackendFilter, backend_registry

    windows = backend_registry.list_builtin(BackendFilter.INTERACTIVE)
    return get_backend().lower() in [name.lower() for name in windows]


def _pyplot():
    try:
        from matplotlib import pyplot
    except ImportError:
        raise _core.UsageError("the gallery needs matplotlib: pip install 'pymlt[plots]'") from None
    return pyplot


def _directory() -> Path:
    here = Path(__file__).resolve()
    for directory in (here.parent / "gallery", here.parents[2] / "docs" / "gallery"):
        if directory.is_dir():
            return directory
    raise _core.FileError(f"{here.parent / 'gallery'}: the gallery is not installed")
