"""An image and what is known about it, as a file of any format."""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING, Any, NamedTuple

from .. import _core
from . import tiff
from .techniques import technique_figure, techniques_of
from .tonemapping import Exposure, check_tonemap, stops_of, straight, tonemap

if TYPE_CHECKING:
    import numpy as np

PICTURES = (".png", ".jpg", ".jpeg", *tiff.EXTENSIONS)
EXTENSIONS = (".exr", *PICTURES, ".hdr")


class OutputFile(NamedTuple):
    """What is to be written, and where."""

    path: str
    image: np.ndarray  #: float32, (height, width) or (height, width, channels), linear
    layers: dict[str, np.ndarray]  #: for .exr
    metadata: dict[str, str]  #: for .exr
    half: bool  #: for .exr
    exposure: Exposure  #: for pictures
    curve: str  #: for pictures

    def write(self) -> None:
        """Raises FileError if it cannot be written, UsageError for what the format cannot hold."""
        if self._is_tiff():
            _core.replace_file(self.path, self._tiff())
        else:
            _core.write_image(*self._arguments())
        self._draw_techniques(self.path)

    def save(self) -> tuple[str, str]:
        """The same, elsewhere if that fails.

        Returns where the file is, or ""; and why it is not at `path`, or "".
        """
        if self._is_tiff():
            return _core.save_text(self.path, self._tiff())
        where, problem = _core.save_image(*self._arguments())
        try:
            self._draw_techniques(where)
        except _core.Error as error:
            return where, "; ".join(filter(None, [problem, str(error)]))
        return where, problem

    def _is_tiff(self) -> bool:
        return self.path.lower().endswith(tiff.EXTENSIONS)

    def _tiff(self) -> bytes:
        shown = tonemap(self.image, self.curve, exposure=self.exposure)
        return tiff.encode_tiff(shown)

    def _draw_techniques(self, path: str) -> None:
        """Beside NAME.png writes NAME.techniques.png, if there are techniques among the layers."""
        stem, extension = os.path.splitext(path)
        if extension.lower() == ".png" and (techniques := techniques_of(self.layers)):
            picture = io.BytesIO()
            stops = stops_of(self.exposure, self.image)
            technique_figure(techniques, stops).savefig(picture, format="png")
            _core.replace_file(f"{stem}.techniques.png", picture.getvalue())

    def _arguments(self) -> tuple[Any, ...]:
        check_extension(self.path)
        image, layers, exposure = self.image, self.layers, stops_of(self.exposure, self.image)
        check_tonemap(self.curve)
        if self.curve != "srgb" and self.path.lower().endswith(PICTURES):
            if "alpha" in layers and not _core.alpha_problem(self.path):
                image, layers = straight(image, layers["alpha"]), {}
            image, exposure = tonemap(image, self.curve, exposure=exposure), 0
        return self.path, image, layers, self.metadata, self.half, exposure


def check_extension(path: str) -> None:
    """Raises UsageError unless the name is that of an image that can be written."""
    extension = os.path.splitext(path)[1]
    if extension.lower() not in EXTENSIONS:
        raise _core.UsageError(
            f"{path}: cannot write an image with the extension '{extension}'; "
            f"valid are: {', '.join(EXTENSIONS)}"
        )


def check_writable(path: str) -> None:
    """Before the work: the UsageError or FileError that writing an image would end in."""
    check_extension(path)
    _core.check_file_writable(path)
