"""A scene in a notebook: a picture that takes a second."""

from __future__ import annotations

from html import escape

from .. import _core
from ..pictures.notebook import figure
from .start import start

SECONDS = 1.0
SPP = 16


def preview(scene: _core.Scene) -> str:
    """HTML of a quick render by `path`, at most `SPP` samples per pixel, and what the scene holds.

    The words alone, if there is not one sample of the image in time, or it cannot be rendered.
    """
    caption = repr(scene)
    try:
        result = start(scene, "path", spp=SPP, time=SECONDS).result()
        return figure(result.image, f"{caption}: {result._summary()}")
    except _core.Error:
        return f"<p>{escape(caption)}</p>"
