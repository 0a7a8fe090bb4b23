"""A screen on which a light of a pbrt file casts its intensities, and what it shows."""

import math
from collections.abc import Callable

import numpy as np
from pbrt_v3_files import read

import pymlt as mlt

#: From where the light is: at the side of a cube to which the wall is the opposite side.
SCREEN_V3 = """
LookAt 0 0 0  0 0 1  0 1 0
Camera "perspective" "float fov" [ 90 ]
Film "image" "integer xresolution" [ 48 ] "integer yresolution" [ 32 ]
PixelFilter "box"
WorldBegin
Material "matte" "rgb Kd" [ 1 1 1 ]
Shape "trianglemesh" "point P" [ -3 -3 1  3 -3 1  3 3 1  -3 3 1 ]
    "integer indices" [ 0 2 1 0 3 2 ]
"""
SCREEN_V4 = (
    SCREEN_V3.replace('"image"', '"rgb"')
    .replace('"matte" "rgb Kd"', '"diffuse" "rgb reflectance"')
    .replace('"point P"', '"point3 P"')
)


def cast(light: str, screen: str = SCREEN_V4) -> np.ndarray:
    made = read(screen, light)
    assert made.warnings == []
    return mlt.render(mlt.load_dict(made.scene), mlt.Path(max_depth=2), spp=64)


def shown(intensity: Callable[[np.ndarray], np.ndarray] | None = None) -> np.ndarray:
    """On a plane at unit distance the irradiance is I cos / r^2 = I cos^3; without one I is 1.

    An intensity is a function of directions, (..., 3). What comes back has one channel.
    """
    x, y = np.meshgrid((np.arange(48) + 0.5) / 16 - 1.5, 1 - (np.arange(32) + 0.5) / 16)
    d = np.stack([x, y, np.ones_like(x)], axis=-1)
    d /= np.linalg.norm(d, axis=-1, keepdims=True)
    height = intensity(d) if intensity else 1
    return (height * d[..., 2] ** 3 / math.pi)[..., None]


def smooth(d: np.ndarray) -> np.ndarray:
    """An intensity that no two sides have in common."""
    x, y, z = np.moveaxis(d, -1, 0)
    return 2 + 0.7 * x + 0.5 * y + 0.3 * z + 0.4 * x * y
