"""Small pbrt-v4 files, and what is seen of the scenes that they hold."""

import functools

import pbrt_v3_files
from pbrt_v3_files import SKY

VIEW = pbrt_v3_files.VIEW.replace('"image"', '"rgb"')
WALL = pbrt_v3_files.WALL.replace('"point P"', '"point3 P"')
seen = functools.partial(pbrt_v3_files.seen, view=VIEW)


def in_the_open(material: str, **options):
    """What a wall scatters below an even sky of radiance 1."""
    return seen(SKY, material, WALL, **options)
