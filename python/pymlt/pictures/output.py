"""An image and what is known about it, as a file of any format."""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING, Any, NamedTuple

from .. import _core
from .bits import BITS, bits_of, encode
from .techniques import technique_figure, techniques_of
from .tonemapping import Exposure, check_tonemap, stops_of, straight, tonemap

if TYPE_CHECKING:
    import numpy as np

PICTURES = tuple(BITS)
EXTENSIONS = (".exr", *PICTURES, ".hdr")


class Contents(NamedTuple):
    """An image, with what its file is to hold."""

    image: np.ndarray
    layers: dict[str, np.ndarray]
    metadata: dict[str, str]


class OutputFile(NamedTuple):
    """What is to be written, and where."""

    path: str
    image: np.ndarray  #: float32, (height, width) or (height, width, channels), linear
    layers: dict[str, np.ndarray]  #: for .exr
    metadata: dict[str, str]  #: for .exr
    half: bool  #: for .exr
    exposure: Exposure  #: for pictures
    curve: str  #: for pictures
    bits: int | None = None  #: for pictures: of each sample; None: as is usual for the format

    def write(self) -> None:
        """Raises FileError if it cannot be written, UsageError for what the format cannot hold."""
        if self._is_written_here():
            _core.replace_file(self.path, self._encoded())
        else:
            _core.write_image(*self._arguments())
        self._draw_techniques(self.path)

    def save(self) -> tuple[str, str]:
        """The same, elsewhere if that fails.

        Returns where the file is, or ""; and why it is not at `path`, or "".
        """
        if self._is_written_here():
            where, problem = _core.save_text(self.path, self._encoded())
        else:
            where, problem = _core.save_image(*self._arguments())
        try:
            self._draw_techniques(where)
        except _core.Error as error:
            return where, "; ".join(filter(None, [problem, str(error)]))
        return where, problem

    def _is_written_here(self) -> bool:
        is_tiff = self.path.lower().endswith((".tif", ".tiff"))
        return bits_of(self.path, self.bits) == 16 or is_tiff

    def _encoded(self) -> bytes:
        shown, bits = self._with_alpha(), bits_of(self.path, self.bits)
        if bits != 32:
            stops = stops_of(self.exposure, self.image)
            shown = tonemap(shown, self.curve, exposure=stops)
        return encode(shown, self.path, bits)

    def _with_alpha(self) -> np.ndarray:
        """The image, with colours that are not multiplied by alpha where the format has alpha."""
        if "alpha" not in self.layers or _core.alpha_problem(self.path):
            return self.image
        return straight(self.image, self.layers["alpha"])

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
            image = tonemap(self._with_alpha(), self.curve, exposure=exposure)
            layers, exposure = {}, 0
        return self.path, image, layers, self.metadata, self.half, exposure


def check_extension(path: str) -> None:
    """Raises UsageError unless the name is that of an image that can be written."""
    extension = os.path.splitext(path)[1]
    if extension.lower() not in EXTENSIONS:
        raise _core.UsageError(
            f"{path}: cannot write an image with the extension '{extension}'; "
            f"valid are: {', '.join(EXTENSIONS)}"
        )


def check_writable(path: str, bits: int | None = None) -> None:
    """Before the work: the UsageError or FileError that writing an image would end in."""
    check_extension(path)
    bits_of(path, bits)
    _core.check_file_writable(path)
