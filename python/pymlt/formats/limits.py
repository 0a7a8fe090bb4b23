"""How much a scene of another program may hold; more is a mistake or an attack."""

from __future__ import annotations

import gzip
import io
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import _core

if TYPE_CHECKING:
    import numpy as np

NESTING = 100  #: of blocks, materials and textures, as in Mitsuba scenes
INCLUDES_DEEP, INCLUDES = 15, 10_000  #: files, as in Mitsuba scenes
PARTS = 1000  #: plug-ins and colours that one plug-in is made of; those used twice count twice
NAME = 1000  #: characters
PIXELS = 2**26  #: of an image that becomes another one here, such as one channel of it
TEXT = 2**28  #: bytes of a text, of all texts that include each other, and of what .gz unpacks to
MEMORY = 2**31  #: bytes of a whole scene; meshes and images that are used twice count twice
PART, ITEM = 1024, 64  #: bytes that a plug-in, and a value in a list, take

#: What a reader stumbles on in a file that contradicts itself.
CONTRADICTIONS = (ArithmeticError, AttributeError, LookupError, MemoryError, OSError, RuntimeError)
CONTRADICTIONS += (TypeError, ValueError)


def read_file(path: Path, largest: int = MEMORY) -> bytes:
    """A regular file, unpacked if its name ends in .gz. Raises FileError, which names it."""
    if "\0" in str(path):  # where the name would end for the system
        raise ValueError("the name of a file holds a NUL")
    content = _core.read_file(str(path), largest)
    if path.suffix != ".gz":
        return content
    try:
        with gzip.open(io.BytesIO(content)) as packed:
            unpacked = packed.read(TEXT + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise _core.FileError(f"{path}: cannot be unpacked: {error}") from None
    if len(unpacked) > TEXT:
        raise _core.FileError(f"{path}: unpacks to more than {TEXT} bytes; unpack it yourself")
    return unpacked


def check_pixels(image: np.ndarray, name: str) -> None:
    """Raises FileError for an image that is too large to be changed."""
    height, width = image.shape[:2]
    if height * width > PIXELS:
        raise _core.FileError(
            f"{name}: is {width} x {height} pixels large; at most {PIXELS} pixels are possible here"
        )


def measured(plugin: dict[str, Any]) -> int:
    """The bytes that a plug-in takes. Raises ValueError for runaway nesting."""
    parts = memory = 0
    left: list[tuple[Any, int]] = [(plugin, 1)]
    while left:
        value, depth = left.pop()
        if depth > NESTING:
            raise ValueError(f"it is nested more than {NESTING} deep")
        if isinstance(value, dict):
            parts += 1
            left += [(inner, depth + 1) for inner in value.values()]
        if isinstance(value, list):
            memory += len(value) * ITEM
        if parts > PARTS:
            raise ValueError(
                f"it has more than {PARTS} parts; those that are used twice count twice"
            )
        memory += len(value) if isinstance(value, bytes) else getattr(value, "nbytes", 0)
    return memory + parts * PART
