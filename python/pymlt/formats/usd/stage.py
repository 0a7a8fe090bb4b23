"""A USD file, with all that it is composed of, as a stage."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from ... import _core
from ..._extras import import_extra
from ..imported import Imported
from ..limits import MEMORY, TEXT, read_file
from ..missing import ABSENT

#: What USD says of a layer that a file refers to and that is not there.
ABSENT_LAYER = re.compile(r"Could not open asset @([^@]*)@")


def read_usd(path: Path, made: Imported) -> None:
    """Adds what a .usd, .usda, .usdc or .usdz file holds to a scene.

    Raises FileError for files that cannot be read, SceneError for what is wrong in them, UsageError
    without the extra `usd`.
    """
    usd = import_extra("pxr.Usd", "usd", "reading USD")
    utils = import_extra("pxr.UsdUtils", "usd", "reading USD")
    read_file(path, TEXT if path.suffix.lower() == ".usda" else MEMORY)  # or it is refused here
    # As long as it is there, what USD warns of is not printed.
    diagnostics = utils.CoalescingDiagnosticDelegate()
    try:
        stage = opened(usd, path)
        note_missing(stage, path, made)
        from .reader import Reader

        Reader(stage, made).read()
    except (_core.SceneError, _core.FileError) as error:
        raise type(error)(f"{path}: {error}") from None
    finally:
        diagnostics.TakeUncoalescedDiagnostics()
        del diagnostics


def opened(usd: Any, path: Path) -> Any:
    """The stage of a file. Raises SceneError, with USD's own words, if it is none."""
    try:
        return usd.Stage.Open(str(path))
    except Exception as error:  # that of pxr.Tf, which tells lines of its own source
        text = " ".join(re.findall(r" : '(.*?)'\s*$", str(error), re.MULTILINE | re.DOTALL))
        said = re.sub(r"\s+", " ", text) or "it cannot be parsed"
        raise _core.SceneError(f"this is no USD file: {said:.300}") from None


def note_missing(stage: Any, path: Path, made: Imported) -> None:
    """Names the layers that are not there, and warns of other errors of composition."""
    texts = {re.sub(r"\s+", " ", str(error)) for error in stage.GetCompositionErrors()}
    for text in sorted(texts):
        if absent := ABSENT_LAYER.search(text):
            named = Path(absent[1])
            found = named.relative_to(path.parent) if named.is_relative_to(path.parent) else named
            made.missing[f"{found}: {ABSENT}"] = ""
        else:
            made.warn(f"USD says: {text:.300}")
