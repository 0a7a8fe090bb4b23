"""Films: the frames of a shot in one file."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import closing, contextmanager
from itertools import chain
from typing import TYPE_CHECKING, Any

from .. import _core
from .._extras import import_extra
from ..images import read_image
from ..pictures.tonemapping import Exposure, encode_srgb, stops_of
from ..pictures.tonemapping import tonemap as toned

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

EXTENSION = ".mp4"


def is_film(path: str | os.PathLike[str]) -> bool:
    return os.fspath(path).lower().endswith(EXTENSION)


def write_film(
    path: str | os.PathLike[str],
    frames: Iterable[ArrayLike | str | os.PathLike[str]],
    *,
    fps: float = 24,
    exposure: Exposure = 0,
    tonemap: str = "srgb",
) -> None:
    """Write frames as a film: an .mp4 with H.264, which browsers play.

    frames
        linear images of shape (height, width, 3), float, or the names of their files; all of one
        size. A line or column of black is added where the size is odd.
    exposure, tonemap
        as for `Result.write`; "auto" is what suits the first frame, for all of them.

    Raises UsageError without the extra `video`, for no frames and for frames of several sizes,
    FileError if the film cannot be written or a frame not be read.
    """
    path = os.fspath(path)
    if not is_film(path):
        raise _core.UsageError(f"{path} is no film; write {os.path.splitext(path)[0]}{EXTENSION}")
    encoder = import_extra("imageio_ffmpeg", "video", "a film")
    _core.check_file_writable(path)
    unfinished = f"{path}.part{EXTENSION}"
    with _removed(unfinished):
        try:
            _encode(encoder, unfinished, frames, fps, exposure, tonemap)
            os.replace(unfinished, path)
        except OSError as error:
            raise _core.FileError(f"{path}: cannot be written: {error}") from error


@contextmanager
def _removed(path: str) -> Iterator[None]:
    """Removes the file in the end, if it is there."""
    try:
        yield
    finally:
        if os.path.exists(path):
            os.remove(path)


def _encode(
    encoder: Any, path: str, frames: Iterable, fps: float, exposure: Exposure, curve: str
) -> None:
    images = map(_image_of, frames)
    first = next(images, None)
    if first is None:
        raise _core.UsageError("a film has at least one frame; give some")
    stops = stops_of(exposure, first)
    with closing(_started(encoder, path, first.shape, fps)) as writer:
        for image in chain([first], images):
            if image.shape != first.shape:
                raise _core.UsageError(
                    f"frames are {first.shape} and {image.shape}, but should be alike"
                )
            writer.send(_samples(image, curve, stops))


def _image_of(frame: ArrayLike | str | os.PathLike[str]) -> NDArray[np.float32]:
    import numpy as np

    if isinstance(frame, str | os.PathLike):
        frame = read_image(frame)
    image = np.asarray(frame, np.float32)
    if image.ndim != 3 or image.shape[2] < 3:
        raise _core.UsageError(f"a frame is {image.shape}, but should be (height, width, 3)")
    return image[..., :3]


def _samples(image: NDArray[np.float32], curve: str, stops: float) -> NDArray[np.uint8]:
    import numpy as np

    shown = encode_srgb(toned(image, curve, exposure=stops))
    return np.ascontiguousarray((255 * shown + 0.5).astype(np.uint8))


def _started(encoder: Any, path: str, size: tuple[int, ...], fps: float) -> Any:
    even = "pad=ceil(iw/2)*2:ceil(ih/2)*2"  # what H.264 asks for
    writer = encoder.write_frames(
        path,
        (size[1], size[0]),
        fps=fps,
        quality=8,
        macro_block_size=1,
        output_params=["-vf", even],
    )
    writer.send(None)
    return writer
