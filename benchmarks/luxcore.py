"""Equal-time error of our bdpt and of LuxCore's BIDIRCPU on the Cornell box with a glass ball.

The light is a tenth as wide as usual and a hundred times as bright. Both renderers get the same
triangles (the ball has 65,000, flat), no filter, no roulette that matters, one thread and the same
CPU seconds. The error is relMSE against a long run of our bdpt over the pixels in which the ball
is not seen directly, nothing dropped; the reference's own error, known from its two halves, is
subtracted. LuxCore's rows lie one lower than ours.
"""

from __future__ import annotations

import json
import math
import sys
import tempfile
from pathlib import Path
from statistics import median

import numpy as np
from common import (
    REPOSITORY,
    Reference,
    parser,
    print_table,
    say,
    write_results,
)
from peers import MissingError, Worker

from pymlt.diagnostics.metrics import percentile_90, relative_square, trimmed_mean
from pymlt.race.cpu_time import render_for

CAMERA = {"origin": [0, 0, 3.9], "target": [0, 0, 0], "up": [0, 1, 0], "fov": 39.3077}


# ---- the scene, for both -------------------------------------------------------------------------


def ball_mesh(center, radius: float, rows: int = 128) -> tuple[np.ndarray, np.ndarray]:
    """A sphere of 4 rows^2 triangles; no vertex lies on the poles' axis twice."""
    columns = 2 * rows
    theta, phi = np.meshgrid(
        np.linspace(1e-3, math.pi - 1e-3, rows + 1),
        np.linspace(0, 2 * math.pi, columns, endpoint=False),
        indexing="ij",
    )
    normals = [np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)]
    vertices = np.stack(normals, axis=-1).reshape(-1, 3)
    a = (np.arange(rows)[:, None] * columns + np.arange(columns)).ravel()
    b = (np.arange(rows)[:, None] * columns + np.roll(np.arange(columns), -1)).ravel()
    faces = np.concatenate(
        [np.stack([a, b, a + columns], axis=1), np.stack([b, b + columns, a + columns], axis=1)]
    )
    north, south = len(vertices), len(vertices) + 1
    first, last = np.arange(columns), rows * columns + np.arange(columns)
    caps = [
        np.stack([np.full(columns, north), np.roll(first, -1), first], axis=1),
        np.stack([np.full(columns, south), last, np.roll(last, -1)], axis=1),
    ]
    vertices = np.concatenate([vertices, [[0, 1, 0], [0, -1, 0]]])
    return vertices * radius + np.asarray(center), np.concatenate([faces, *caps])


def write_ply(path: Path, vertices, triangles) -> None:
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    faces = np.zeros(len(triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, triangles
    path.write_bytes(header.encode() + vertices.astype("<f4").tobytes() + faces.tobytes())


RECTANGLE = (
    np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float),
    np.array([[0, 1, 2], [0, 2, 3]]),
)


def cube() -> tuple[np.ndarray, np.ndarray]:
    """Six rectangles, looking outwards."""
    vertices, triangles = [], []
    for axis in range(3):
        for sign in (-1, 1):
            corners = np.roll(RECTANGLE[0] * [sign, 1, 1] + [0, 0, sign], axis + 1, axis=1)
            triangles.append(RECTANGLE[1] + 4 * len(vertices))
            vertices.append(corners)
    return np.concatenate(vertices), np.concatenate(triangles)


def triangles_of(description: dict, ball) -> list[dict]:
    """The shapes of a scene dict of rectangles, cubes and the ball."""
    meshes = []
    for shape in description.values():
        if not isinstance(shape, dict) or shape.get("type") not in ("rectangle", "cube", "ply"):
            continue
        if shape["type"] == "ply":
            vertices, triangles = ball
            meshes.append({"ior": shape["bsdf"]["int_ior"]})
        else:
            vertices, triangles = RECTANGLE if shape["type"] == "rectangle" else cube()
            matrix = shape["to_world"].matrix
            vertices = vertices @ matrix[:3, :3].T + matrix[:3, 3]
            bsdf = next(v for v in shape.values() if isinstance(v, dict) and v["type"] == "ref")
            meshes.append({"reflectance": description[bsdf["id"]]["reflectance"]["value"]})
        if "emitter" in shape:
            meshes[-1]["radiance"] = shape["emitter"]["radiance"]["value"]
        meshes[-1] |= {"vertices": vertices.tolist(), "triangles": triangles.tolist()}
    return meshes


def no_glass(size: int, center, radius: float) -> np.ndarray:
    """Pixels whose rays pass the ball, with a margin of two pixels."""
    half = math.tan(math.radians(CAMERA["fov"] / 2))
    x = (2 * (np.arange(size) + 0.5) / size - 1) * half
    rays = np.stack(np.broadcast_arrays(x[None, :], -x[:, None], -1.0), axis=-1)
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    to_ball = np.asarray(center) - CAMERA["origin"]
    distance = np.linalg.norm(np.cross(rays, to_ball), axis=-1)
    margin = 2 * (2 * half / size) * np.linalg.norm(to_ball)
    return distance > radius + margin


# ---- the comparison ------------------------------------------------------------------------------


def luxcore_image(path) -> np.ndarray:
    """Row 0 on top, and one row up; the last row, which then is missing, is repeated."""
    flipped = np.load(path)[::-1]
    return np.concatenate([flipped[1:], flipped[-1:]])


def row_of(name: str, images, seconds, samples, reference, pixels) -> dict:
    known = reference.errors()[pixels]
    errors = [relative_square(image, reference.image)[pixels] for image in images]
    bright = np.mean([image[pixels].mean() for image in images])
    return {
        "renderer": name,
        "CPU s": median(seconds),
        "spp": median(samples),
        "relMSE": median(float(e.mean()) for e in errors) - float(known.mean()),
        "trimmed": median(trimmed_mean(e) for e in errors) - trimmed_mean(known),
        "median pixel": median(float(np.median(e)) for e in errors),
        "90 % of pixels": median(percentile_90(e) for e in errors),
        "mean / reference": float(bright / reference.image[pixels].mean()),
    }


def main() -> None:
    options = parser(__doc__)
    options.add_argument("--luxcore-python", default=sys.executable, help="one that has pyluxcore")
    options.add_argument("--seconds", type=float, default=20, help="CPU seconds of each image")
    options.add_argument("--reference-seconds", type=float, default=1200)
    options.add_argument("--repeats", type=int, default=3)
    options.add_argument("--size", type=int, default=512)
    options.add_argument("--max-depth", type=int, default=16)
    options.add_argument("--threads", type=int, default=2, help="of the reference")
    options.add_argument("--cache", type=Path, default=REPOSITORY / "build" / "references")
    args = options.parse_args()

    import pymlt as mlt

    description = mlt.scenes.glass_ball()
    center, radius = description["ball"]["center"], description["ball"]["radius"]
    ball = ball_mesh(center, radius)
    description["sensor"]["film"]["rfilter"] = {"type": "box"}
    bdpt = mlt.BDPT(max_depth=args.max_depth)
    ours, theirs = ([], [], []), ([], [], [])
    with tempfile.TemporaryDirectory() as folder:
        write_ply(Path(folder) / "ball.ply", *ball)
        description["ball"] = {
            "type": "ply",
            "filename": f"{folder}/ball.ply",
            "face_normals": True,
            "bsdf": description["ball"]["bsdf"],
        }
        scene = mlt.load_dict(description, size=(args.size, args.size))
        scene_file = Path(folder) / "scene.json"
        meshes = triangles_of(description, ball)
        scene_file.write_text(json.dumps({"camera": CAMERA, "meshes": meshes}))
        worker = None
        try:
            worker = Worker(
                args.luxcore_python,
                "worker_luxcore.py",
                str(scene_file),
                str(args.size),
                str(args.max_depth),
            )
        except (MissingError, OSError) as reason:
            say(f"LuxCore: skipped, {reason}")
        reference = Reference(
            f"glass-ball-{args.size}",
            scene,
            bdpt,
            args.reference_seconds,
            threads=args.threads,
            folder=args.cache,
        )
        for seed in range(args.repeats):
            result, seconds, _ = render_for(scene, bdpt, args.seconds, seed=seed, threads=1)
            for values, value in zip(
                ours, (result.image, seconds, result.stats["spp_done"]), strict=True
            ):
                values.append(value)
            if worker is None:
                continue
            output = f"{folder}/luxcore.npy"
            answer = worker.ask(seconds=args.seconds, seed=seed, output=output)
            image = luxcore_image(output)
            for values, value in zip(
                theirs, (image, answer["seconds"], answer["spp"]), strict=True
            ):
                values.append(value)
        if worker is not None:
            worker.close()

    pixels = no_glass(args.size, center, radius)
    rows = [row_of("pymlt bdpt", *ours, reference, pixels)]
    if worker is not None:
        rows.append(row_of("LuxCore BIDIRCPU", *theirs, reference, pixels))
    for row in rows:
        row["relMSE / ours"] = row["relMSE"] / rows[0]["relMSE"]
    print_table(rows)
    settings = {
        key: getattr(args, key)
        for key in ("seconds", "reference_seconds", "repeats", "size", "max_depth")
    }
    write_results(args.json, "luxcore", settings, rows)


if __name__ == "__main__":
    main()
