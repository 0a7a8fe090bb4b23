"""Scenes as people have them: loads and renders each of a folder, and tells what has changed.

    python benchmarks/public_scenes.py FOLDER --json now.json
    python benchmarks/public_scenes.py FOLDER --json new.json --against now.json

Places are scenes, folders that are searched for them, or text files with one place in each line.
Every scene is rendered in a process of its own, small and with few samples, by path tracing: what
counts is whether it loads, what is said, and how bright it is. `--pictures` keeps the images.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import numpy as np

import pymlt as mlt

KINDS = (".xml", ".pbrt", ".gltf", ".glb")
SETTINGS = [
    "--integrator",
    "path",
    "--size",
    "64x48",
    "--spp",
    "16",
    "--threads",
    "1",
    "--seed",
    "1",
]


def scenes_in(place: Path) -> list[Path]:
    """Files that a place names; includes, which are no scenes by themselves, are left out."""
    if place.is_dir():
        return sorted(f for kind in KINDS for f in place.rglob(f"*{kind}") if is_scene(f))
    if place.suffix != ".txt":
        return [place]
    lines = [line.strip() for line in place.read_text().splitlines()]
    return [f for line in lines if line for f in scenes_in(place.parent / line)]


def is_scene(file: Path) -> bool:
    return file.suffix != ".xml" or b"<scene" in file.read_bytes()[:100_000]


def tried(file: Path, picture: Path, seconds: float) -> dict:
    """What became of a scene: its state, what was said, and the mean colour of its image."""
    command = [sys.executable, "-m", "pymlt", "render", file, *SETTINGS, "-o", picture]
    row = {"scene": str(file), "state": "rendered", "mean": None, "seconds": seconds}
    start = time.monotonic()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return row | {"state": "too slow", "said": []}
    row["seconds"] = round(time.monotonic() - start, 2)
    said = [line.removeprefix("pymlt: ") for line in done.stderr.splitlines()]
    row["said"] = [line for line in said if not line.startswith("path, ")]
    if done.returncode < 0:
        row["state"] = "crashed"
    elif done.returncode > 0:
        row["state"] = "refused"
    else:
        row["mean"] = [float(f"{x:.4g}") for x in mlt.read_image(picture).mean(axis=(0, 1))]
        if not np.isfinite(row["mean"]).all() or max(row["mean"]) == 0:
            row["state"] = "black"
    return row


def changes(old: dict, new: dict, tolerance: float) -> list[str]:
    """How a scene differs from before, in words."""
    if old["state"] != new["state"]:
        return [f"{old['state']} before, {new['state']} now", *new["said"][-1:]]
    found = [f"says now: {line}" for line in new["said"] if line not in old["said"]]
    if new["mean"] and not np.allclose(old["mean"], new["mean"], rtol=tolerance):
        found.append(f"mean {old['mean']} before, {new['mean']} now")
    return found


def main() -> None:
    summary, _, rest = __doc__.partition("\n")
    options = argparse.ArgumentParser(
        description=summary, epilog=rest, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    options.add_argument("places", nargs="+", type=Path, metavar="PLACE")
    options.add_argument("--json", type=Path, help="where to write what became of them")
    options.add_argument("--against", type=Path, help="such a file of before")
    options.add_argument("--pictures", type=Path, help="a folder for the images")
    options.add_argument("--seconds", type=float, default=120, help="for each scene")
    options.add_argument("--tolerance", type=float, default=0.05, help="of means, relative")
    args = options.parse_args()

    rows = []
    with tempfile.TemporaryDirectory() as folder:
        pictures = args.pictures or Path(folder)
        pictures.mkdir(parents=True, exist_ok=True)
        for i, file in enumerate(f for place in args.places for f in scenes_in(place)):
            picture = pictures / f"{i:03}-{file.parent.name}-{file.stem}.exr"
            rows.append(tried(file, picture, args.seconds))
            print(f"{rows[-1]['state']:9} {file}", *rows[-1]["said"][-1:], sep="  ", flush=True)
    counts = Counter(row["state"] for row in rows)
    print(f"{len(rows)} scenes:", ", ".join(f"{n} {state}" for state, n in counts.items()))
    if args.json:
        args.json.write_text(json.dumps(rows, indent=1) + "\n")
    if args.against:
        before = {row["scene"]: row for row in json.loads(args.against.read_text())}
        for row in rows:
            for change in changes(before.get(row["scene"], row), row, args.tolerance):
                print(f"changed: {row['scene']}: {change}")


if __name__ == "__main__":
    main()
