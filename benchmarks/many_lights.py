"""A hall with 1, 5, 30, 1,000 or 100,000 lamps: how noisy an image is after equal CPU time.

The lamps are small rectangles below the ceiling that face anywhere, of different power, all
together as bright whatever their number; six boxes of rough plastic stand on the floor. With
--one-mesh all lamps are triangles of one mesh, so that they have one radiance. The error
is the variance between seeds, relative as in relMSE: mean of var / (r^2 + 0.001), with r the mean
of all images. To compare two builds, run it with each. `--write FOLDER` writes the scenes as files,
for equal_time.py.
"""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
from common import parser, print_table, write_results

import pymlt as mlt
from pymlt.formats.xml_writer import to_xml
from pymlt.race.cpu_time import render_for

INTEGRATORS = {"path": mlt.Path, "bdpt": mlt.BDPT, "mlt": mlt.MLT}
WALLS = [
    mlt.Transform().rotate([1, 0, 0], -90).scale(5),
    mlt.Transform().translate([0, 3, 0]).rotate([1, 0, 0], 90).scale(5),
    *(
        mlt.Transform().rotate([0, 1, 0], turn).translate([0, 0, -5]).scale(5)
        for turn in (0, 90, 180, 270)
    ),
]


#: Of a rectangle.
CORNERS = np.array([[-1, -1, 0, 1], [1, -1, 0, 1], [1, 1, 0, 1], [-1, 1, 0, 1]], float)


def shape(kind: str, to_world: mlt.Transform, bsdf: dict, **more) -> dict:
    return {"type": kind, "to_world": to_world, "bsdf": bsdf, **more}


def rgb(*value: float) -> dict:
    return {"type": "rgb", "value": list(value)}


def hall(lamps: int, *, one_mesh: bool = False) -> dict:
    """The scene with this number of lamps."""
    draw = random.Random(lamps)
    side = 0.5 / lamps**0.5
    scene = {
        "type": "scene",
        "sensor": {
            "type": "perspective",
            "fov": 75,
            "to_world": mlt.Transform().look_at([0, 1.6, 4.8], [0, 1.1, 0], [0, 1, 0]),
            "film": {"type": "hdrfilm", "width": 160, "height": 90, "rfilter": {"type": "box"}},
        },
    }
    wall = {"type": "diffuse", "reflectance": rgb(0.6, 0.55, 0.5)}
    plastic = {"type": "roughplastic", "alpha": 0.15, "diffuse_reflectance": rgb(0.3, 0.4, 0.6)}
    for i, to_world in enumerate(WALLS):
        scene[f"wall{i}"] = shape("rectangle", to_world, wall)
    for i in range(6):
        place = mlt.Transform().translate([draw.uniform(-3.5, 3.5), 0.5, draw.uniform(-3.5, 2)])
        size = [0.4, draw.uniform(0.3, 1), 0.4]
        scene[f"box{i}"] = shape("cube", place.scale(size), plastic)
    corners: list[list[np.ndarray]] = []  # of all lamps, if they are one mesh
    for i in range(lamps):
        at = [draw.uniform(-4.8, 4.8), draw.uniform(1.5, 2.9), draw.uniform(-4.8, 4.8)]
        turn = 90 + draw.uniform(-60, 60)
        to_world = mlt.Transform().translate(at).rotate([1, 0, 0], turn).scale(side)
        power = draw.uniform(0.2, 1) * 10 / (lamps * side**2)
        colour = rgb(power, power * draw.uniform(0.4, 1), power * draw.uniform(0.3, 1))
        light = {"type": "area", "radiance": colour}
        if one_mesh:
            corners.append([to_world.matrix @ corner for corner in CORNERS])
        else:
            scene[f"lamp{i}"] = shape("rectangle", to_world, {"type": "diffuse"}, emitter=light)
    if one_mesh:
        light = {"type": "area", "radiance": rgb(*np.array([6, 4, 3]) / (lamps * side**2))}
        vertices = np.array(corners).reshape(-1, 4)[:, :3]
        faces = np.arange(4 * lamps).reshape(-1, 4)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
        mesh = {"vertices": vertices, "faces": faces, "emitter": light}
        scene["lamps"] = shape("mesh", mlt.Transform(), {"type": "diffuse"}, **mesh)
    return scene


def measure(scene, integrator, args) -> tuple[float, float]:
    """relMSE after the CPU time, and samples per pixel."""
    images, spp = [], []
    for seed in range(1, args.seeds + 1):
        done = render_for(scene, integrator, args.seconds, seed=seed, threads=1)
        images.append(done.result.image.astype(np.float64))
        spp.append(done.result.stats["spp_done"])
    mean = np.mean(images, axis=0)
    error = np.mean(np.var(images, axis=0, ddof=1) / (mean**2 + 0.001))
    return float(error), float(np.mean(spp))


def write(args) -> None:
    args.write.mkdir(parents=True, exist_ok=True)
    for lamps in args.lamps:
        text = to_xml(hall(lamps, one_mesh=args.one_mesh), args.write)
        (args.write / f"hall-{lamps}.xml").write_text(text)


def main() -> None:
    options = parser(__doc__)
    options.add_argument("--lamps", type=int, nargs="+", default=[1, 5, 30, 1000, 100_000])
    options.add_argument("--integrators", nargs="+", choices=INTEGRATORS, default=list(INTEGRATORS))
    options.add_argument("--seconds", type=float, default=5)
    options.add_argument("--seeds", type=int, default=4)
    options.add_argument("--one-mesh", action="store_true", help="of which all lamps are a part")
    options.add_argument("--write", metavar="FOLDER", type=Path, help="and do not measure")
    args = options.parse_args()
    if args.write:
        write(args)
        return
    rows = []
    for lamps in args.lamps:
        scene = mlt.load_dict(hall(lamps, one_mesh=args.one_mesh))
        for name in args.integrators:
            error, spp = measure(scene, INTEGRATORS[name](max_depth=6), args)
            rows.append({"lamps": lamps, "integrator": name, "relMSE": error, "spp": spp})
    print_table(rows)
    settings = {"seconds": args.seconds, "seeds": args.seeds, "one_mesh": args.one_mesh}
    write_results(args.json, "many_lights", settings, rows)


if __name__ == "__main__":
    main()
