"""ArviZ, which is an extra."""

from __future__ import annotations

import warnings
from typing import Any

from .._extras import import_extra


def import_arviz(what: str) -> Any:
    """The module; `what` needs it."""
    with warnings.catch_warnings():  # it announces its next version
        warnings.simplefilter("ignore", FutureWarning)
        return import_extra("arviz", "arviz", what)
