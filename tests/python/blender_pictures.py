"""Pictures that the extension for Blender makes, beside those of Cycles."""

from pathlib import Path

import numpy as np

import pymlt as mlt

BLOCK = 6  #: pixels, of which the means are compared


def picture(path: Path) -> np.ndarray:
    return mlt.read_image(path)[..., :3]


def blocks(image: np.ndarray, side: int = BLOCK) -> np.ndarray:
    """Means over blocks, in which noise and edges count little."""
    rows, columns = (length // side for length in image.shape[:2])
    cut = image[: rows * side, : columns * side]
    return cut.reshape(rows, side, columns, side, 3).mean(axis=(1, 3))


def assert_alike(ours: np.ndarray, theirs: np.ndarray) -> None:
    """The means differ by less than 5 %, and those of blocks by less than 8 %."""
    np.testing.assert_allclose(ours.mean(axis=(0, 1)), theirs.mean(axis=(0, 1)), rtol=0.05)
    # A thing that is elsewhere, or turned, would change blocks by more than that.
    assert np.abs(blocks(ours) - blocks(theirs)).mean() / theirs.mean() < 0.08
