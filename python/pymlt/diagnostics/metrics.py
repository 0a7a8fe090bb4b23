"""How far an image is from a reference."""

from __future__ import annotations

import os
from importlib.util import find_spec
from typing import TYPE_CHECKING

from .. import _core
from .._extras import import_extra
from ..images import read_image
from ..pictures.luminance import target_luminance

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike


def compare(
    image: ArrayLike | str | os.PathLike[str],
    reference: ArrayLike | str | os.PathLike[str],
    *,
    flip: bool | None = None,
) -> dict[str, float]:
    """Errors of an image against a reference; arrays or file names.

    With a the image and r the reference, over all pixels and channels:

    mse, rmse
        mean (a - r)^2, and its root.
    relmse
        mean (a - r)^2 / (r^2 + 0.01).
    relmse_trimmed
        the same without the 0.1 % of the pixels that are worst: what is left without fireflies.
    relmse_median, relmse_p90
        median and 90th percentile over the pixels of the same, the mean of a pixel's channels: half
        of the pixels, and nine of ten, are no worse. Fireflies do not move them.
    mape
        mean `|a - r| / (|r| + 0.01)`, as a fraction.
    bias_z
        the mean of a - r over its standard error, from the spread between the blocks of a grid. Of
        two unbiased images it is about a standard normal number, as long as pixels farther apart
        than a block are independent.
    flip
        mean perceptual error (HDR-FLIP, Andersson et al. 2021); needs flip-evaluator. None: if it
        is installed.

    Raises UsageError for images of different sizes, FileError for files that cannot be read.
    """
    import numpy as np

    a, r = image_pair(image, reference)
    error = a - r
    squared = error**2
    relative = relative_square(a, r)
    metrics = {
        "mse": squared.mean(),
        "rmse": np.sqrt(squared.mean()),
        "relmse": relative.mean(),
        "relmse_trimmed": trimmed_mean(relative),
        "relmse_median": np.median(relative),
        "relmse_p90": percentile_90(relative),
        "mape": relative_error(a, r).mean(),
        "bias_z": _bias_z(error.mean(axis=2)),
    }
    perceptual = _flip(a, r, flip)
    if perceptual is not None:
        metrics["flip"] = perceptual
    return {name: float(value) for name, value in metrics.items()}


def image_pair(image, reference) -> tuple[np.ndarray, np.ndarray]:
    """Two arrays or files of one size as float64, (height, width, 1 or 3). Raises as `compare`."""
    a, r = (_pixels(x) for x in (image, reference))
    if a.shape != r.shape:
        raise _core.UsageError(
            f"the images differ in size: {_describe(a.shape)} and {_describe(r.shape)}",
        )
    return a, r


def _pixels(image) -> np.ndarray:
    """RGB (or grey) in float64, without alpha."""
    import numpy as np

    name = "the image"
    if isinstance(image, str | os.PathLike):
        name = os.fspath(image)
        image = read_image(image)
    pixels = np.asarray(getattr(image, "image", image), dtype=np.float64)
    pixels = pixels[..., None] if pixels.ndim == 2 else pixels
    if pixels.ndim != 3 or pixels.size == 0:
        raise _core.UsageError(
            f"{name} has the shape {pixels.shape}, but should have (height, width, channels)",
        )
    return pixels[..., : 3 if pixels.shape[2] >= 3 else 1]


def relative_error(a: np.ndarray, r: np.ndarray) -> np.ndarray:
    """`|a - r| / (|r| + 0.01)` of each pixel, the mean of its channels: (height, width)."""
    return (abs(a - r) / (abs(r) + 0.01)).mean(axis=2)


def relative_square(a: np.ndarray, r: np.ndarray, scale: np.ndarray | None = None) -> np.ndarray:
    """(a - r)^2 / (s^2 + 0.01) of each pixel, the mean of its channels: (height, width).

    s is `scale`, by default r.
    """
    return ((a - r) ** 2 / ((r if scale is None else scale) ** 2 + 0.01)).mean(axis=2)


def trimmed_mean(errors: np.ndarray, dropped: float = 0.001) -> float:
    """The mean without the share of the errors that are largest; one stays at least."""
    import numpy as np

    kept = max(1, int(np.floor((1 - dropped) * errors.size)))
    return float(np.sort(errors, axis=None)[:kept].mean())


def percentile_90(errors: np.ndarray) -> float:
    """What nine of ten errors do not exceed; between two of them, it is interpolated."""
    import numpy as np

    return float(np.quantile(errors, 0.9))


def sparks(image: np.ndarray) -> np.ndarray:
    """Which pixels of an image, (height, width, 3), are more than five times as bright as the
    median of the 5 x 5 around them: bool, (height, width). Those near the border count as none.
    """
    import numpy as np

    found = np.zeros(image.shape[:2], bool)
    brightness = target_luminance(np.asarray(image, np.float64))
    if min(found.shape) >= 5:
        around = np.lib.stride_tricks.sliding_window_view(brightness, (5, 5))
        for y, row in enumerate(around):
            found[y + 2, 2:-2] = brightness[y + 2, 2:-2] > 5 * np.median(row, axis=(1, 2))
    return found


def _describe(shape) -> str:
    return f"{shape[1]} x {shape[0]} with {shape[2]} channels"


def _bias_z(error) -> float:
    import numpy as np

    blocks = [
        block.mean()
        for rows in np.array_split(error, min(16, error.shape[0]), axis=0)
        for block in np.array_split(rows, min(16, error.shape[1]), axis=1)
    ]
    spread = np.std(blocks, ddof=1) if len(blocks) > 1 else 0.0
    mean = np.mean(blocks)
    if spread == 0:
        return 0.0 if mean == 0 else float(np.copysign(np.inf, mean))
    return mean / (spread / np.sqrt(len(blocks)))


def _flip(a, r, wanted: bool | None) -> float | None:
    if wanted is False or (wanted is None and not find_spec("flip_evaluator")):
        return None
    return flip_map(a, r)[1]


def flip_map(a: np.ndarray, r: np.ndarray) -> tuple[np.ndarray, float]:
    """HDR-FLIP of a against r, linear: the error of each pixel, (height, width), and its mean.

    Andersson et al. 2021, Visualizing Errors in Rendered High Dynamic Range Images; seen from where
    a degree has 67 pixels. Raises UsageError without flip-evaluator.
    """
    import numpy as np

    flip = import_extra("flip_evaluator", "flip", "FLIP")

    def prepare(x: np.ndarray) -> np.ndarray:
        rgb = np.broadcast_to(np.maximum(x, 0), (*x.shape[:2], 3))
        return np.array(rgb, dtype=np.float32, order="C")  # one that may be written to

    errors, mean, _ = flip.evaluate(prepare(r), prepare(a), "HDR", applyMagma=False)
    return np.asarray(errors).reshape(a.shape[:2]), float(mean)
