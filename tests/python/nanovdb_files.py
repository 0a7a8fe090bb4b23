"""NanoVDB files for tests: one leaf of 8 x 8 x 8 floats, compressed."""

import struct
import zlib

import numpy as np

VERSION = 32 << 21 | 3 << 10 | 3
MAGIC = b"NanoVDB0"
FOG, FLOAT, ZIP = 2, 1, 1


def padded(size: int, *parts: bytes) -> bytes:
    return b"".join(parts).ljust(size, b"\0")


def internal(edge: int) -> bytes:
    """A node whose first child follows it, and whose other ones are 0."""
    mask = (1).to_bytes(edge**3 // 8, "little")
    head = padded(-(-(48 + 2 * len(mask)) // 32) * 32, bytes(32), mask, mask)
    return head + padded(8 * edge**3, struct.pack("<q", len(head) + 8 * edge**3))


def nanovdb(values: np.ndarray, name: str = "density", voxel: float = 1, low=(0, 0, 0)) -> bytes:
    """`values` along x, y and z; the first is at `low` in the world."""
    leaf = padded(96, bytes(16), b"\xff" * 64) + values.astype("<f4").tobytes()
    tile = struct.pack("<QqIf", 0, 96, 1, 0)
    root = padded(64, struct.pack("<6iIf", 0, 0, 0, 7, 7, 7, 1, 0)) + padded(32, tile)
    tree = struct.pack("<4Q6IQ", 0, 0, 0, 64, 1, 1, 1, 0, 0, 0, 512)
    nodes = tree + root + internal(32) + internal(16) + leaf
    scale, inverse = (np.diag([x] * 3).ravel().tolist() for x in (voxel, 1 / voxel))
    place = struct.pack("<22f22d", *scale, *inverse, *low, 1, *scale, *inverse, *low, 1)
    size = 672 + len(nodes)
    head = padded(40, MAGIC, b"\xff" * 8, struct.pack("<4IQ", VERSION, 0, 0, 1, size))
    head += padded(256, name.encode()) + place
    grid = padded(672, head, bytes(72), struct.pack("<2I", FOG, FLOAT)) + nodes
    packed = zlib.compress(grid)
    kind = struct.pack("<4Q2I", size, 8 + len(packed), 0, 512, FLOAT, FOG)
    meta = padded(176, kind, bytes(96), struct.pack("<I", len(name) + 1))
    segment = MAGIC + struct.pack("<IHH", VERSION, 1, ZIP) + meta + name.encode() + b"\0"
    return segment + struct.pack("<Q", len(packed)) + packed
