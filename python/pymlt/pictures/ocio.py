"""Views of OpenColorIO as tone curves, by OpenImageIO, whose wheels have it."""

from __future__ import annotations

import functools
import os
from typing import TYPE_CHECKING, NamedTuple

from .. import _core

if TYPE_CHECKING:
    import numpy as np

PREFIX = "ocio:"
BUILT_IN = "ocio://default"
OLDEST = 30200  #: version of OpenImageIO; before 3.2 it takes the light of some files for another
ACES2 = f"{PREFIX}sRGB - Display/ACES 2.0 - SDR 100 nits (Rec.709)@{BUILT_IN}"


class View(NamedTuple):
    """A view of a display, in a configuration."""

    display: str
    name: str
    config: str  #: its file, or a built-in one such as ocio://default


def view_of(curve: str) -> View:
    """What "ocio:DISPLAY/VIEW@FILE" means; without a display the default one.

    Without a file it is that of $OCIO, or else OpenColorIO's own configuration for ACES. Raises
    UsageError for a file that cannot be read, for an unknown view, and with an old OpenImageIO.
    """
    name, _, file = curve.removeprefix(PREFIX).partition("@")
    config = os.path.expanduser(file or os.environ.get("OCIO") or BUILT_IN)
    known = _views(config)
    if name not in known:
        meant = _core.suggestion(name, list(known))
        raise _core.UsageError(f"{config} has no view {name!r}{meant}")
    return View(*known[name], config)


@functools.lru_cache(maxsize=8)
def _views(config: str) -> dict[str, tuple[str, str]]:
    """Displays and views, by all names that they have here."""
    import OpenImageIO

    if OpenImageIO.VERSION < OLDEST:
        raise _core.UsageError(
            "aces2 and views of OpenColorIO need `pip install 'OpenImageIO>=3.2'`, but here is "
            f"{OpenImageIO.VERSION_STRING}"
        )
    read = OpenImageIO.ColorConfig(config)
    if problem := read.geterror():
        raise _core.UsageError(f"{problem}; use an OpenColorIO configuration such as config.ocio")
    displays = read.getDisplayNames()
    known = {f"{d}/{v}": (d, v) for d in displays for v in read.getViewNames(d)}
    default = read.getDefaultDisplayName()
    return known | {v: (default, v) for v in read.getViewNames(default)}


def codes(light: np.ndarray, view: View) -> np.ndarray:
    """What is sent to the display for linear light of Rec. 709, (height, width, 3).

    Raises UsageError for a configuration that does not say what that light is in it.
    """
    import numpy as np
    import OpenImageIO

    image = OpenImageIO.ImageBuf(np.ascontiguousarray(light, dtype=np.float32))
    shown = OpenImageIO.ImageBufAlgo.ociodisplay(
        image, view.display, view.name, "lin_rec709_scene", colorconfig=view.config
    )
    if shown.has_error:
        raise _core.UsageError(f"{view.config}: {shown.geterror()}")
    found: np.ndarray = shown.get_pixels(OpenImageIO.FLOAT)
    return found
