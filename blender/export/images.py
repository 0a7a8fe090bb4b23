"""Images of Blender as arrays; their rows begin at the bottom."""

import numpy as np

from pymlt.formats.imported import Imported


def samples(image, made: Imported) -> np.ndarray | None:
    """What an image holds, as (height, width, channels): uint8 (encoded) or float32 (linear).

    None, and a warning, where Blender cannot load its file.
    """
    width, height = image.size
    values = np.empty(width * height * image.channels, np.float32)
    if not values.size:
        made.warn(f"the image {image.name!r} cannot be loaded")
        return None
    image.pixels.foreach_get(values)
    values = values.reshape(height, width, image.channels)
    return values if image.is_float else np.round(values * 255).astype(np.uint8)


def colours(values: np.ndarray) -> np.ndarray:
    """The colours of such an array, without its alpha."""
    return values[..., :3] if values.shape[2] == 4 else values[..., :1]
