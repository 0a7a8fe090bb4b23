"""What the targets in Python share: bytes that are read as a scene of another program."""

import contextlib
import sys
import tempfile
import warnings
from collections.abc import Callable
from importlib.machinery import PathFinder
from pathlib import Path
from typing import Any


def survive(content: bytes, extension: str) -> None:
    """Reads a file of these bytes; it may raise our errors only, which end here."""
    from pymlt import _core
    from pymlt.formats.files import load_foreign

    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("error")
        path = Path(folder) / f"input{extension}"
        path.write_bytes(content)
        with contextlib.suppress(_core.Error):
            load_foreign(path, size=(4, 4))


def fuzz(read: Callable[[bytes], None], **options: Any) -> None:
    """Gives a target what libFuzzer makes up; the arguments of the program are libFuzzer's."""
    import atheris

    # Modules that an editable installation finds are not instrumented, those of a folder are.
    sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
    sys.meta_path.insert(0, PathFinder)
    with atheris.instrument_imports(include=["pymlt"], enable_loader_override=False):
        import pymlt.formats.files
        import pymlt.formats.gltf
        import pymlt.formats.materialx.reader
        import pymlt.formats.pbrt  # noqa: F401
    atheris.Setup(sys.argv, read, **options)
    atheris.Fuzz()
