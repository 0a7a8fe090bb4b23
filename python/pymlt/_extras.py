"""Packages that only some users need: the extras of pyproject.toml."""

from __future__ import annotations

import importlib
import shlex
from importlib.metadata import requires
from typing import Any

from . import _core


def import_extra(module: str, extra: str, what: str) -> Any:
    """A module of an extra. Raises UsageError, with what to type, if `what` lacks it."""
    try:
        return importlib.import_module(module)
    except ImportError:
        packages = shlex.join(requirements(extra))
        raise _core.UsageError(f"{what} needs `pip install {packages}`") from None


def requirements(extra: str) -> list[str]:
    """The packages of an extra. `pymlt[extra]` itself may not be on an index."""
    marked = [given.split("; ") for given in requires("pymlt") or []]
    return [package for package, *marker in marked if marker == [f'extra == "{extra}"']]
