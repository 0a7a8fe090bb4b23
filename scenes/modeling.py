"""Small tools with which the scenes' meshes and textures are made: numpy in, PLY and PNG out.

A mesh is (positions, normals, uvs, triangles); normals and uvs may be None.
"""

import struct
import zlib
from pathlib import Path

import numpy as np


def grid_triangles(rows: int, columns: int, wrap: bool = False) -> np.ndarray:
    """The triangles of a grid of vertices; with `wrap`, the last column is joined to the first."""
    i, j = np.mgrid[0 : rows - 1, 0 : columns if wrap else columns - 1]
    k = (j + 1) % columns
    a, b, c, d = (q.ravel() for q in (i * columns + j, i * columns + k, i * columns + columns + k,
                                      i * columns + columns + j))  # fmt: skip
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def lathe(profile, segments: int = 48, smooth: int = 8):
    """A surface of revolution about y. `profile` lists (radius, height); a Catmull-Rom spline with
    `smooth` pieces per interval goes through it, and a point given twice makes a sharp edge. The
    normals point to the right of the profile: outward, if it is drawn upward."""
    curve, tangents = _spline(np.asarray(profile, float), smooth)
    angle = np.linspace(0, 2 * np.pi, segments, endpoint=False)
    around = np.stack([np.cos(angle), np.sin(angle)], 1)
    normal = np.stack([tangents[:, 1], -tangents[:, 0]], 1)
    points = _turn(curve, around)
    normals = _turn(normal / np.linalg.norm(normal, axis=1, keepdims=True), around)
    triangles = grid_triangles(len(curve), segments, wrap=True)[:, ::-1]
    corners = points[triangles]
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    return points, normals, None, triangles[area > 1e-14]


def _turn(radial, around):
    r, y = radial[:, :1, None], radial[:, 1:, None]
    x, z = around[None, :, 0, None], around[None, :, 1, None]
    out = np.concatenate([r * x, np.broadcast_to(y, r.shape[:1] + x.shape[1:2] + (1,)), r * z], 2)
    return out.reshape(-1, 3)


def _spline(points, pieces):
    """Points on a Catmull-Rom spline and its tangents, in runs that end at doubled points."""
    breaks = [0, *(i for i in range(1, len(points)) if (points[i] == points[i - 1]).all())]
    curve, tangents = [], []
    for first, last in zip(breaks, [*breaks[1:], len(points)], strict=True):
        p = points[first:last]
        p = np.concatenate([2 * p[:1] - p[1:2], p, 2 * p[-1:] - p[-2:-1]])
        for i in range(1, len(p) - 2):
            t = np.linspace(0, 1, pieces + 1)[: pieces + (i == len(p) - 3), None]
            a, b = p[i + 1] - p[i - 1], p[i + 2] - p[i]
            u, v = 2 * p[i] - 2 * p[i + 1], 3 * (p[i + 1] - p[i])
            c3, c2, c1 = u / 1 + a / 2 + b / 2, v - a - b / 2, a / 2
            curve.append(p[i] + t * (c1 + t * (c2 + t * c3)))
            tangents.append(c1 + t * (2 * c2 + 3 * t * c3))
    return np.concatenate(curve), np.concatenate(tangents)


def smooth_normals(positions, triangles):
    """Normals of vertices: the mean of those of the triangles about them, by area."""
    corners = positions[triangles]
    faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(positions)
    for k in range(3):
        np.add.at(normals, triangles[:, k], faces)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)


def boxes(corners):
    """Boxes given as (lowest corner, highest corner); u runs along y, v across, in metres."""
    positions, normals, uvs, triangles = [], [], [], []
    for low, high in corners:
        low, high = np.array(low, float), np.array(high, float)
        for axis in range(3):
            for side in (low, high):
                first = len(positions)
                u, v = (axis + 1) % 3, (axis + 2) % 3
                for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                    point = low.copy()
                    point[axis], point[u], point[v] = (
                        side[axis],
                        (low, high)[a][u],
                        (low, high)[b][v],
                    )
                    positions.append(point)
                    normals.append(np.eye(3)[axis] * (1 if side is high else -1))
                    uvs.append((point[1], point[0] + point[2]))
                order = (0, 1, 2, 3) if side is high else (0, 3, 2, 1)
                triangles += [[first + order[k] for k in t] for t in ((0, 1, 2), (0, 2, 3))]
    return np.array(positions), np.array(normals), np.array(uvs), np.array(triangles)


def height_field(height, slope, half_width: float, half_depth: float, rows: int, columns: int):
    """The surface y = height(x, z) over a rectangle, facing +y; slope(x, z) is its gradient."""
    z, x = (
        q.ravel()
        for q in np.meshgrid(
            np.linspace(-half_depth, half_depth, rows),
            np.linspace(-half_width, half_width, columns),
            indexing="ij",
        )
    )
    dx, dz = slope(x, z)
    normals = np.stack([-dx, np.ones_like(x), -dz], 1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return np.stack([x, height(x, z), z], 1), normals, None, grid_triangles(rows, columns)[:, ::-1]


def write_ply(path: Path, mesh) -> None:
    """Binary PLY; 16-bit indices keep the files small."""
    positions, normals, uvs, triangles = mesh
    columns = [("x y z", positions), ("nx ny nz", normals), ("u v", uvs)]
    columns = [(names.split(), data) for names, data in columns if data is not None]
    assert len(positions) < 1 << 16
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(positions)}"]
    head += [f"property float {name}" for names, _ in columns for name in names]
    head += [
        f"element face {len(triangles)}",
        "property list uchar ushort vertex_indices",
        "end_header",
    ]
    faces = np.empty(len(triangles), np.dtype([("n", "u1"), ("v", "<u2", 3)]))
    faces["n"], faces["v"] = 3, triangles
    data = np.concatenate([d for _, d in columns], axis=1).astype("<f4")
    path.write_bytes(("\n".join(head) + "\n").encode() + data.tobytes() + faces.tobytes())


def write_png(path: Path, rgb) -> None:
    """An 8-bit sRGB PNG of encoded values in [0, 1]."""
    pixels = np.clip(np.asarray(rgb) * 255 + 0.5, 0, 255).astype(np.uint8)
    rows, columns = pixels.shape[:2]
    raw = np.concatenate([np.zeros((rows, 1), np.uint8), pixels.reshape(rows, -1)], 1).tobytes()

    def chunk(kind: bytes, data: bytes) -> bytes:
        return (
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        )

    header = struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)
    body = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + body)


def waves(trains):
    """(height, slope) of a sea; each train has direction (degrees), length, height (m), phase."""

    def each(x, z):
        for degrees, length, amplitude, phase in trains:
            k = (
                2
                * np.pi
                / length
                * np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
            )
            yield k, amplitude, k[0] * x + k[1] * z + phase

    def height(x, z):
        return sum(a * np.sin(t) for _, a, t in each(x, z))

    def slope(x, z):
        return tuple(sum(a * k[i] * np.cos(t) for k, a, t in each(x, z)) for i in (0, 1))

    return height, slope
