"""The files that a scene of another program names and that are not there, all in one error."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from .. import _core
from .imported import Imported

ABSENT = "there is no such file"
MOST = 20  #: files that an error names


def refuse_missing(made: Imported, source: Path) -> None:
    """Raises FileError if files are missing: those that the reader has met, and the scene's."""
    found = dict(made.missing)
    for name, place in files_of(made.scene, made.places):
        if is_missing(name):
            found.setdefault(f"{name}: {ABSENT}", place)
    if found:
        raise _core.FileError(message(found, str(source)))


def is_missing(name: str | os.PathLike[str]) -> bool:
    """Whether there is nothing; what cannot be looked at is left to those who read it."""
    try:
        os.stat(name)
    except (FileNotFoundError, NotADirectoryError):
        return True
    except (OSError, ValueError):
        return False
    return False


def files_of(plugin: dict[str, Any], places: Mapping[str, str], place: str = "") -> Iterator[Any]:
    """The name of each file in a scene dict, and the place of what it belongs to."""
    for key, value in plugin.items():
        if key == "filename":
            yield value, place
        elif isinstance(value, dict):
            yield from files_of(value, places, places.get(key, place))


def message(found: Mapping[str, str], source: str) -> str:
    """By file and line, which are given in full for the first one and where the file changes."""
    texts = []
    last = ""
    for text, place in sorted(found.items(), key=lambda item: _split(item[1]))[:MOST]:
        file, line = _split(place)
        where = f"line {line}: " if file and file == last else f"{place or source}: "
        texts.append((where if place or not texts else "") + text)
        last = file
    if len(found) > MOST:
        texts.append(f"and {len(found) - MOST} more")
    return "; ".join(texts)


def _split(place: str) -> tuple[str, int]:
    """The file and the line of file:line."""
    file, _, line = place.rpartition(":")
    return file, int(line or 0)
