"""Gradient noise and cells of texture coordinates, with the values that MaterialX specifies.

These are Perlin's noise (2002, "Improving noise") over a lattice whose gradients are chosen by the
last rounds of Jenkins' hash (2006, lookup3), as in the Open Shading Language.
"""

from __future__ import annotations

import numpy as np

ROTATIONS = (14, 11, 25, 16, 4, 14, 24)
SCALE = 0.6616  #: makes the values reach from -1 to 1
OTHER = np.array([19, 73])  #: where the fourth channel of noise is another one
OTHER_FRACTAL = np.array([19, 193])  #: where the last of two or four channels of a fractal is


def lattice_hash(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """32 bits for each pair of integers."""
    start = np.uint32(0xDEADBEEF + (2 << 2) + 13)
    a, b, c = start + x.astype(np.uint32), start + y.astype(np.uint32), np.full_like(x, start)
    c = c.astype(np.uint32)
    mixed = [a, b, c]
    for index, bits in enumerate(ROTATIONS):
        # The hash changes c by b, a by c, b by a, and so on.
        to, by = (2 - 2 * index) % 3, (1 - 2 * index) % 3
        turned = (mixed[by] << np.uint32(bits)) | (mixed[by] >> np.uint32(32 - bits))
        mixed[to] = (mixed[to] ^ mixed[by]) - turned
    return mixed[2]


def gradient(bits: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The product of (x, y) with one of eight vectors such as (1, 2) and (-2, 1)."""
    first = bits & 4 == 0
    u, v = np.where(first, x, y), 2 * np.where(first, y, x)
    return np.where(bits & 1, -u, u) + np.where(bits & 2, -v, v)


def perlin(points: np.ndarray, channels: int) -> np.ndarray:
    """Noise at points (..., 2): up to four channels, the first of which has the bits of one."""
    if channels == 4:
        return np.concatenate([perlin(points, 3), perlin(points + OTHER, 1)], axis=-1)
    corner = np.floor(points)
    x, y = np.moveaxis(points - corner, -1, 0)
    i, j = np.moveaxis(corner.astype(np.int64), -1, 0)
    shifts = np.arange(channels, dtype=np.uint32) * np.uint32(8)

    def at(right: int, up: int) -> np.ndarray:
        bits = lattice_hash(i + right, j + up)[..., None] >> shifts
        return gradient(bits, (x - right)[..., None], (y - up)[..., None])

    u, v = (fade(one)[..., None] for one in (x, y))
    low = (1 - u) * at(0, 0) + u * at(1, 0)
    high = (1 - u) * at(0, 1) + u * at(1, 1)
    noise: np.ndarray = SCALE * ((1 - v) * low + v * high)
    return noise


def fade(t: np.ndarray) -> np.ndarray:
    """From 0 to 1 with first and second derivatives that are 0 at both ends."""
    return t * t * t * (t * (6 * t - 15) + 10)


def fractal(
    points: np.ndarray, channels: int, octaves: int, lacunarity: float, diminish: float
) -> np.ndarray:
    """A sum of noises, each `lacunarity` times as fine and `diminish` times as strong."""
    if channels in (2, 4):
        parts = [
            fractal(at, count, octaves, lacunarity, diminish)
            for at, count in ((points, channels - 1), (points + OTHER_FRACTAL, 1))
        ]
        return np.concatenate(parts, axis=-1)
    return np.sum(
        [diminish**i * perlin(points * lacunarity**i, channels) for i in range(octaves)], axis=0
    )


def cells(points: np.ndarray) -> np.ndarray:
    """A number from 0 to 1 for each square of side 1, (..., 1)."""
    i, j = np.moveaxis(np.floor(points).astype(np.int64), -1, 0)
    return (lattice_hash(i, j) / np.float64(2**32 - 1))[..., None]
