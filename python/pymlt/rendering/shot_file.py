"""The file of a shot's checkpoint: a zip file of arrays, one of which is JSON, deflated."""

from __future__ import annotations

import io
import json
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import fields
from typing import TYPE_CHECKING, Any

from .. import _core
from .result import Result
from .shot_result import Frame

if TYPE_CHECKING:
    import numpy as np

#: What the file holds besides the results of frames that fade.
TOLD = ("record", "to_come", "frames", "window", "renders", "changes", "complete")

#: What reading raises of a file that is damaged.
DAMAGED = (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile, zlib.error)


def write_shot(path: str, state: dict[str, Any]) -> None:
    """Replaces the file at once or not at all. Raises FileError."""
    import numpy as np

    arrays, results = {}, {}
    for frame, result in state["fading"].items():
        whole = {f.name: getattr(result, f.name) for f in fields(Result)}
        arrays[f"{frame}"] = whole.pop("image")
        layers = whole.pop("layers")
        arrays |= {f"{frame}/{i}": layer for i, layer in enumerate(layers.values())}
        results[frame] = {**whole, "layers": list(layers)}
    told = {name: state[name] for name in TOLD}
    told |= {"frames": [vars(frame) for frame in state["frames"]], "fading": results}
    text = np.frombuffer(zlib.compress(json.dumps(told).encode()), np.uint8)
    file = io.BytesIO()
    np.savez(file, told=text, **arrays)
    _core.replace_file(path, file.getvalue())


def read_shot(path: str) -> dict[str, Any]:
    """What `write_shot` has written. Raises FileError for other files, and damaged ones."""
    import numpy as np

    file = io.BytesIO(_core.read_file(path, 2**63))
    if not zipfile.is_zipfile(file):
        raise _core.FileError(f"{path}: is no checkpoint of a shot")
    try:
        with np.load(file, allow_pickle=False) as arrays:
            return _state_of(arrays)
    except DAMAGED:
        raise _core.FileError(f"{path}: is no checkpoint of a shot, or damaged") from None


def _state_of(arrays: Mapping[str, np.ndarray]) -> dict[str, Any]:
    told = json.loads(zlib.decompress(arrays["told"].tobytes()))
    state = {name: told[name] for name in TOLD}
    state["frames"] = [Frame(**frame) for frame in told["frames"]]
    state["changes"] = {int(frame): errors for frame, errors in told["changes"].items()}
    state["fading"] = {}
    for frame, whole in told["fading"].items():
        layers = {name: arrays[f"{frame}/{i}"] for i, name in enumerate(whole.pop("layers"))}
        state["fading"][int(frame)] = Result(arrays[frame], layers=layers, **whole)
    return state
