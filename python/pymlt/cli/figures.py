"""Figures of matplotlib as files."""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING

from .. import _core
from .._extras import import_extra
from .common import say

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def check_figure_file(path: str) -> None:
    """Raises UsageError or FileError now if a figure could not be saved there."""
    _core.check_file_writable(path)
    suffix = os.path.splitext(path)[1].lstrip(".").lower()
    figure = import_extra("matplotlib.figure", "plots", "a figure").Figure()
    known = figure.canvas.get_supported_filetypes()
    if suffix not in known:
        raise _core.UsageError(
            f"{path}: a figure cannot be saved as {suffix!r}{_core.suggestion(suffix, list(known))}"
        )


def save_figure(figure: Figure, path: str) -> int:
    """Saves it there, or elsewhere if that fails; says where. Returns the exit code."""
    picture = io.BytesIO()
    figure.savefig(picture, format=os.path.splitext(path)[1][1:].lower())
    saved, problem = _core.save_text(path, picture.getvalue())
    say(problem or saved)
    return 3 if problem else 0
