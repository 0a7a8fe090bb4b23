"""Packages that only some users need: the extras of pyproject.toml."""

from __future__ import annotations

import importlib
from typing import Any

from . import _core


def import_extra(module: str, extra: str, what: str) -> Any:
    """A module of an extra. Raises UsageError, with what to type, if `what` lacks it."""
    try:
        return importlib.import_module(module)
    except ImportError:
        raise _core.UsageError(f"{what} needs `pip install 'pymlt[{extra}]'`") from None
