"""Files of MaterialX and what they include, with the nodes that the standard library defines."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

from ... import _core
from ..._extras import import_extra
from ..limits import INCLUDES, INCLUDES_DEEP, TEXT, read_file

TRANSLATIONS = Path(__file__).parent / "translations.mtlx"


def library() -> Any:
    """The package MaterialX. Raises UsageError if it is not installed."""
    return import_extra("MaterialX", "materialx", "reading MaterialX")


@functools.cache
def standard_nodes() -> Any:
    """The document that defines the standard nodes, with our translations between shaders."""
    mx = library()
    made = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), made)
    ours = mx.createDocument()
    mx.readFromXmlString(ours, TRANSLATIONS.read_text(encoding="utf-8"))
    made.importLibrary(ours)
    return made


def read_document(path: Path) -> Any:
    """A file with what it includes. Raises FileError and SceneError, which name the file."""
    mx = library()
    document = mx.createDocument()
    document.setDataLibrary(standard_nodes())
    budget = {"files": INCLUDES, "bytes": TEXT}
    read_into(document, path, budget, INCLUDES_DEEP)
    return document


def read_into(document: Any, path: Path, budget: dict[str, int], deep: int) -> None:
    """Adds the content of one file to a document; includes are relative to the file."""
    mx = library()
    content = read_file(path, TEXT)
    budget["files"] -= 1
    budget["bytes"] -= len(content)
    if min(*budget.values(), deep) < 0:
        raise _core.SceneError(f"{path}: too many files, or too large ones, include each other")

    def included(inner: Any, name: Any, *_: Any) -> None:
        read_into(inner, path.parent / name.asString(), budget, deep - 1)

    options = mx.XmlReadOptions()
    options.readXIncludeFunction = included
    document.setSourceUri(str(path))
    try:
        text = content.decode("utf-8-sig")
        mx.readFromXmlString(document, text, mx.FileSearchPath(), options)
    except (_core.SceneError, _core.FileError):
        raise
    except Exception as error:  # those of MaterialX have no class of their own in common
        raise _core.SceneError(f"{path}: this is no MaterialX: {error!s:.200}") from None
