"""Small pbrt-v3 files, and what is seen of the scenes that they hold."""

from pathlib import Path

import numpy as np

import pymlt as mlt
from pymlt.formats.files import read_foreign

VIEW = """
LookAt 0 0 5  0 0 0  0 1 0
Camera "perspective" "float fov" [ 2 ]
Film "image" "integer xresolution" [ 8 ] "integer yresolution" [ 8 ]
Integrator "path" "integer maxdepth" [ 20 ]
WorldBegin
"""
SKY = 'LightSource "infinite" "rgb L" [ 1 1 1 ]\n'
WALL = """
Shape "trianglemesh" "point P" [ -2 -2 0  2 -2 0  2 2 0  -2 2 0 ]
    "integer indices" [ 0 1 2 0 2 3 ] """
RED, GREEN, BLUE = np.eye(3)


def written(*parts: str, name: str = "a.pbrt") -> str:
    Path(name).write_text("".join(parts))
    return name


def read(*parts: str):
    """The dict, and what was said about it."""
    return read_foreign(written(*parts))


def seen(*parts: str, spp: int = 256, warnings: int = 0, view: str = VIEW) -> np.ndarray:
    """The mean of an image that shows the middle of a wall."""
    made = read(view, *parts)
    assert len(made.warnings) == warnings, made.warnings
    return mlt.render(mlt.load_dict(made.scene), spp=spp).mean(axis=(0, 1))


def in_the_open(material: str, **options) -> np.ndarray:
    """What a wall scatters below an even sky of radiance 1."""
    return seen(SKY, material, WALL, **options)


def assert_close(found, *expected, rel=0.01):
    np.testing.assert_allclose(found, np.broadcast_to(expected, 3), rtol=rel, atol=1e-6)
