"""Time to equal error: `path` against Mitsuba 3 (scalar and llvm_ad) on scene files, by default the
Cornell box, in RGB or with wavelengths (`--spectral`).

Each renderer runs on one thread in a process of its own, in turn with the others; the first round
(which compiles LLVM's kernels) is not counted. The error of an image is relMSE against the
reference, if --references has one; else it is the spread of the rounds, which does not see light
that nobody finds. *trimmed* leaves out the worst .1 % of the pixels; half of them, and nine of ten,
do not exceed *median pixel* and *90 % of pixels*. No renderer's image is the reference of another,
and *level*, the mean brightness over that of the reference or of the median, is a check of bias.

error x time does not depend on the number of samples, as long as samples are independent; its
quotient is the time to equal error; the columns from *trimmed* to *90 % of pixels* are the same by
their errors. Stratified samples do better the more there are: ours are stratified within each of 16
groups, Mitsuba's with its `multijitter` sampler, which runs as well.
"""

from __future__ import annotations

import ctypes.util
import os
import sys
import tempfile
from pathlib import Path
from statistics import median

import numpy as np
from common import REPOSITORY, parser, print_table, say, write_results
from peers import MissingError, Worker

from pymlt.race.score import Judge, reference_images

CORNELL_BOX = REPOSITORY / "scenes" / "cornell-box" / "scene.xml"
KINDS = ["scalar", "llvm_ad"]
PEERS = [
    ("scalar", "independent"),
    ("scalar", "multijitter"),
    ("llvm_ad", "independent"),
    ("llvm_ad", "multijitter"),
]


def llvm_environment() -> dict[str, str]:
    """Where Dr.Jit finds LLVM: it wants to be told if there are only versioned files."""
    if os.environ.get("DRJIT_LIBLLVM_PATH"):
        return {}
    for folder in (Path("/usr/lib/x86_64-linux-gnu"), Path("/usr/lib/aarch64-linux-gnu")):
        versions = sorted(folder.glob("libLLVM*.so*"), key=_version)
        if versions:
            return {"DRJIT_LIBLLVM_PATH": str(versions[-1])}
    if ctypes.util.find_library("LLVM"):
        return {}
    raise MissingError("no LLVM library; apt-get install libllvm19, or set DRJIT_LIBLLVM_PATH")


def _version(path: Path) -> int:
    digits = "".join(c if c.isdigit() else " " for c in path.name).split()
    return int(digits[0]) if digits else 0


def start_workers(path: Path, args) -> dict[str, Worker]:
    scene = (str(path), *map(str, args.size), str(args.max_depth))
    colours = "spectral" if args.spectral else "rgb"
    workers = {"pymlt": Worker(sys.executable, "worker_pymlt.py", *scene, colours)}
    for kind, sampler in PEERS:
        if kind not in args.kinds:
            continue
        variant = f"{kind}_{colours}"
        name = f"Mitsuba {variant}" + (", multijitter" if sampler == "multijitter" else "")
        try:
            environment = llvm_environment() if "llvm" in variant else {}
            workers[name] = Worker(
                args.mitsuba_python,
                "worker_mitsuba.py",
                *scene,
                variant,
                sampler,
                environment=environment,
            )
        except (MissingError, OSError) as reason:
            say(f"{name}: skipped, {reason}")
    return workers


def measure(path: Path, workers: dict[str, Worker], args) -> list[dict]:
    scene = path.parent.name if path.stem == "scene" else path.stem
    kept = reference(scene, args)
    if not kept and args.rounds < 2:
        raise SystemExit(f"{scene}: without a reference there is no error of one round")
    seconds = {name: [] for name in workers}
    images = {name: [] for name in workers}
    with tempfile.TemporaryDirectory() as folder:
        output = f"{folder}/image.npy"
        for round_ in range(args.rounds + 1):
            for name, worker in workers.items():
                answer = worker.ask(spp=args.spp, seed=round_, output=output)
                if round_ == 0:
                    continue
                seconds[name].append(answer["seconds"])
                images[name].append(np.load(output).astype(np.float64))
    judge = Judge.with_reference(kept) if kept else Judge.between_seeds(list(images.values()))
    samples = args.size[0] * args.size[1] * args.spp
    rows = []
    for name, own in images.items():
        time = median(seconds[name])
        score = judge.score(own, time)
        rows.append(
            {
                "scene": scene,
                "renderer": name,
                "against": "reference" if kept else "spread",
                "Msamples/s": samples / time / 1e6,
                "relMSE": score.relmse.value,
                "relMSE x s": score.relmse.value * time,
                "time to equal error": score.relmse.value * time,
                "trimmed": score.trimmed.value * time,
                "median pixel": score.pixel_median.value * time,
                "90 % of pixels": score.percentile_90.value * time,
                "level": score.level.value,
            }
        )
    ours = dict(rows[0])
    for row in rows:
        for column in ("time to equal error", "trimmed", "median pixel", "90 % of pixels"):
            row[column] /= ours[column]
    return rows


def reference(scene: str, args) -> list[np.ndarray]:
    """Of the folder that is given; empty if it has none."""
    if args.references and (kept := args.references / f"{scene}.exr").exists():
        return reference_images(kept, args.size)
    return []


def race(path: Path, args) -> list[dict]:
    workers = start_workers(path, args)
    try:
        return measure(path, workers, args)
    finally:
        for worker in workers.values():
            worker.close()


def main() -> None:
    options = parser(__doc__)
    options.add_argument("scenes", metavar="SCENE.xml", nargs="*", type=Path, default=[CORNELL_BOX])
    options.add_argument("--mitsuba-python", default=sys.executable, help="one that has mitsuba")
    options.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS)
    options.add_argument("--size", type=int, nargs=2, default=[512, 512], help="width and height")
    options.add_argument("--max-depth", type=int, default=8)
    options.add_argument("--spp", type=int, default=64)
    options.add_argument("--rounds", type=int, default=5)
    options.add_argument("--references", type=Path, help="a folder with SCENE.exr, box-filtered")
    options.add_argument("--spectral", action="store_true", help="light has wavelengths")
    args = options.parse_args()

    rows = []
    for path in args.scenes:
        rows += race(path.resolve(), args)
    print_table(rows)
    settings = {
        key: getattr(args, key) for key in ("size", "max_depth", "spp", "rounds", "spectral")
    }
    write_results(args.json, "equal_time", settings, rows)


if __name__ == "__main__":
    main()
