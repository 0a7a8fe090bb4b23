"""An image in a window of another shape: grey bars fill what it leaves."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

GREY = 40


class Frame:
    """The largest place for an image in a window; both given as width / height."""

    def __init__(self, image: float, window: float):
        window = max(window, 1e-3)
        self.width = min(1.0, image / window)  #: its share of the window's width
        self.height = min(1.0, window / image)

    def fov(self, fov: float) -> float:
        """The vertical angle of the window, given that of the image."""
        return 2 * math.atan(math.tan(fov / 2) / self.height)

    def place(self, x: float, y: float) -> tuple[float, float] | None:
        """A place of the window (0 to 1 each way) as one of the image, or None beside it."""
        x, y = (x - 0.5) / self.width + 0.5, (y - 0.5) / self.height + 0.5
        return (x, y) if 0 <= x < 1 and 0 <= y < 1 else None

    def fill(self, picture: np.ndarray) -> np.ndarray:
        """A picture (height, width, 3) with bars, in the shape of the window."""
        import numpy as np

        height, width = picture.shape[:2]
        x, y = (round(n / share) - n for n, share in ((width, self.width), (height, self.height)))
        if x <= 0 and y <= 0:
            return picture
        sides = [(n // 2, n - n // 2) for n in (max(y, 0), max(x, 0))]
        return np.pad(picture, [*sides, (0, 0)], constant_values=GREY)
