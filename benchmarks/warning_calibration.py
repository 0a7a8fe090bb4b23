"""Do the warnings of `mlt` tell renders whose claimed error is wrong from the others?

    .venv/bin/python benchmarks/warning_calibration.py --n 40 >build/warnings.txt

Random scenes, three budgets, two seeds; the truth is the mean of long renders by `bdpt` and `mlt`,
weighted by the errors that they claim. Prints a line for each render, and then the shares that
docs/error-calibration.md names.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "python"))
import random_scene

import pymlt as mlt
from pymlt.diagnostics.error_calibration import WARNINGS
from pymlt.pictures.luminance import target_luminance

SIZE, BUDGETS, SEEDS = (32, 24), (16, 64, 256), (1, 2)
RIGHT = 0.8, 1.25  # true over claimed error


def render(scene: mlt.Scene, name: str, spp: float, seed: int) -> mlt.Result:
    return mlt.start(scene, {"type": name, "max_depth": 6}, spp=spp, seed=seed, threads=1).result()


def truth(scene: mlt.Scene) -> np.ndarray | None:
    """Brightness of each pixel; None if an image is black."""
    results = [render(scene, "bdpt", 2500, 77), render(scene, "mlt", 1000, 77)]
    errors = [result.stats["error"] for result in results]
    if not all(error and error > 0 for error in errors):
        return None
    weights = np.array(errors) ** -2.0
    return target_luminance(np.average([r.image for r in results], axis=0, weights=weights))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--n", type=int, default=40, help="how many scenes")
    counts = {right: [0, 0] for right in (True, False)}  # renders, and those that warn
    for number in range(1, parser.parse_args().n + 1):
        xml = random_scene.random_scene(number, SIZE)
        try:
            scene = mlt.load_string(xml, directory=random_scene.FOLDER)
        except mlt.Error:
            continue
        known = truth(scene)
        if known is None or any("same place" in w or "boundaries" in w for w in scene.warnings):
            continue
        for spp in BUDGETS:
            for seed in SEEDS:
                result = render(scene, "mlt", spp, seed)
                squares = (target_luminance(result.image) - known) ** 2
                true = np.sqrt((squares / (known**2 + 0.01 * known.mean() ** 2)).mean())
                ratio = true / (result.stats["error"] or np.inf)
                warns = any(w in text for text in result.stats["warnings"] for w in WARNINGS)
                counts[RIGHT[0] <= ratio <= RIGHT[1]][0] += 1
                counts[RIGHT[0] <= ratio <= RIGHT[1]][1] += warns
                print(f"{number} {spp} spp, seed {seed}: true over claimed {ratio:.2f}, "
                      f"{'warns' if warns else 'does not'}", flush=True)  # fmt: skip
    for right, (all_, warned) in counts.items():
        print(f"{warned} of {all_} renders warn whose error is {'' if right else 'not '}right")


if __name__ == "__main__":
    main()
