"""An image as a notebook shows it."""

from __future__ import annotations

import base64
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from .. import _core
from .tonemapping import Exposure, stops_of

if TYPE_CHECKING:
    import numpy as np


def figure(image: np.ndarray, caption: str, exposure: Exposure = 0) -> str:
    """HTML of a linear image, brightened by `exposure` stops, with a caption of plain text."""
    data = base64.b64encode(png(image, exposure)).decode()
    return (
        f'<figure><img src="data:image/png;base64,{data}"/>'
        f"<figcaption>{escape(caption)}</figcaption></figure>"
    )


def png(image: np.ndarray, exposure: Exposure = 0) -> bytes:
    """A PNG file of a linear image."""
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "image.png"
        _core.write_image(str(path), image, {}, {}, False, stops_of(exposure, image))
        return path.read_bytes()
