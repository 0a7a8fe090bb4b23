"""Make the meshes and images of tests/python/scenes: a bump in three formats, a texture, a sky.

    python tests/python/references/make_assets.py

Needs numpy and OpenImageIO. The references depend on these files: make both, or none.
"""

import struct
import zlib
from pathlib import Path

import numpy as np

SCENES = Path(__file__).resolve().parents[1] / "scenes"


def bump(n: int = 12):
    """A square of 2 x 2 with a wave on it: positions, normals, uv, and the triangles."""
    v, u = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    x, z = 2 * u - 1, 1 - 2 * v
    height = 0.3 * np.cos(3 * x) * np.cos(2 * z)
    slope = 0.3 * np.stack(
        [-3 * np.sin(3 * x) * np.cos(2 * z), -2 * np.cos(3 * x) * np.sin(2 * z)], axis=-1
    )
    normals = np.stack([-slope[..., 0], np.ones_like(x), -slope[..., 1]], axis=-1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    corner = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    lower = np.stack([corner, corner + 1, corner + n + 1], axis=-1)
    upper = np.stack([corner, corner + n + 1, corner + n], axis=-1)
    faces = np.concatenate([lower, upper])
    grid = [np.stack([x, height, z], axis=-1), normals, np.stack([u, v], axis=-1)]
    return (*(a.reshape(n * n, -1).astype("<f4") for a in grid), faces.astype("<u4"))


def write_obj(path, positions, normals, uv, faces):
    lines = [f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in positions]
    lines += [f"vt {u:.7g} {v:.7g}" for u, v in uv]
    lines += [f"vn {x:.7g} {y:.7g} {z:.7g}" for x, y, z in normals]
    lines += ["f " + " ".join(f"{i}/{i}/{i}" for i in face) for face in faces + 1]
    path.write_text("\n".join(lines) + "\n")


def write_ply(path, positions, normals, uv, faces):
    names = ("x", "y", "z", "nx", "ny", "nz", "u", "v")
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(positions)}"]
    header += [f"property float {name}" for name in names]
    header += [f"element face {len(faces)}", "property list uchar uint vertex_indices"]
    table = np.zeros(len(faces), dtype=[("count", "u1"), ("indices", "<u4", 3)])
    table["count"], table["indices"] = 3, faces
    vertices = np.concatenate([positions, normals, uv], axis=1)
    text = "\n".join([*header, "end_header", ""]).encode()
    path.write_bytes(text + vertices.tobytes() + table.tobytes())


def write_serialized(path, positions, normals, uv, faces):
    """Version 4 of Mitsuba's format, one shape: flags, name, counts, arrays, all deflated."""
    has_normals, has_uv, single_precision = 0x0001, 0x0002, 0x1000
    flags = struct.pack("<I", has_normals | has_uv | single_precision)
    counts = struct.pack("<QQ", len(positions), len(faces))
    arrays = b"".join(a.tobytes() for a in (positions, normals, uv, faces))
    content = zlib.compress(flags + b"bump\0" + counts + arrays, 9)
    head = struct.pack("<HH", 0x041C, 4)
    path.write_bytes(head + content + struct.pack("<QI", 0, 1))


def write_image(path, pixels, kind):
    import OpenImageIO

    height, width, channels = pixels.shape
    out = OpenImageIO.ImageOutput.create(str(path))
    out.open(str(path), OpenImageIO.ImageSpec(width, height, channels, kind))
    out.write_image(pixels)
    out.close()


def sky():
    """Blue above, brown below, and a small sun."""
    theta = np.pi * (np.arange(16) + 0.5) / 16
    sky = np.where((theta < np.pi / 2)[:, None], [0.4, 0.6, 1.0], [0.3, 0.2, 0.1])
    pixels = np.repeat(sky[:, None, :], 32, axis=1)
    pixels[4:6, 10:12] = [40, 35, 25]
    return pixels.astype(np.float32)


def main():
    mesh = bump()
    write_obj(SCENES / "bump.obj", *mesh)
    write_ply(SCENES / "bump.ply", *mesh)
    write_serialized(SCENES / "bump.serialized", *mesh)
    colours = np.random.default_rng(1).integers(20, 250, (6, 8, 3)).astype(np.uint8)
    write_image(SCENES / "colours.png", colours, "uint8")
    write_image(SCENES / "sky.exr", sky(), "half")


if __name__ == "__main__":
    main()
