"""pbrt (Pharr, Jakob & Humphreys 2023; https://pbrt.org/fileformat-v4), and its third version."""

from pathlib import Path

from ..imported import Imported
from .version import is_v3


def read_pbrt(path: Path, made: Imported) -> None:
    """Adds what a .pbrt file, with those that it includes, holds to a scene.

    Raises FileError for files that cannot be read, SceneError (with file and line) for what is
    wrong in them.
    """
    if is_v3(path):
        from .v3.reader import ReaderOfV3

        ReaderOfV3(path, made).read()
    else:
        from .reader import Reader

        Reader(path, made).read()


__all__ = ["read_pbrt"]
