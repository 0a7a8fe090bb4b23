"""ArviZ, which is an extra."""

from __future__ import annotations

import warnings

from .. import _core


def import_arviz(what: str):
    """The module; `what` needs it."""
    try:
        with warnings.catch_warnings():  # it announces its next version
            warnings.simplefilter("ignore", FutureWarning)
            import arviz
    except ImportError:
        raise _core.UsageError(f"{what} needs `pip install 'pymlt[arviz]'`") from None
    return arviz
