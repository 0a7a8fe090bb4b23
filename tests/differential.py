"""Do all algorithms make the same image of random scenes? Does Mitsuba 3?

    make differential N=60                               sixty scenes
    .venv/bin/python tests/differential.py --seed 17 --n 1             one of them again
    .venv/bin/python tests/differential.py --scene build/differential/17.xml   a file

Each scene is rendered by every algorithm with six seeds. The means over the image and over blocks
of 8 x 8 pixels are compared with those of `bdpt`, by Welch's t with Holm's correction, as in
tests/python/same_image.py: a difference counts when it comes again with other seeds and four times
the samples. Mitsuba 3 joins in where it is installed and can read the scene. A scene in which two
differ is made smaller as long as they do, and left in build/differential.

An algorithm may be darker where it says that it finds some light rarely or never, `mlt` and `erpt`
where tours wait, and `ptracer` wherever it is; none may be brighter.
"""

from __future__ import annotations

import argparse
import importlib.util
import re
import sys
import time
import xml.etree.ElementTree as Tree
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests" / "python"))
import random_scene  # noqa: E402
import same_image  # noqa: E402

import pymlt as mlt  # noqa: E402

SIZE = (24, 16)
SCALES = ((1, 1), (SIZE[1] // 8, SIZE[0] // 8))
RUNS = 6
DEPTH = {"max_depth": 6}
ALGORITHMS = {
    "path": {"type": "path"},
    "ptracer": {"type": "ptracer"},
    "pssmlt": {"type": "pssmlt"},
    "pssmlt over bdpt": {"type": "pssmlt", "estimator": "bdpt"},
    "mmlt": {"type": "mmlt"},
    "rjmlt": {"type": "rjmlt"},
    "erpt": {"type": "erpt"},
    "mlt": {"type": "mlt"},
    "mlt over bdpt": {"type": "mlt", "independent": "bdpt"},
}
MITSUBA = "Mitsuba 3"
UNBOUNDED = "bdpt, unbounded"  # which Mitsuba is compared with: it counts edges in another way


class Scene:
    """A scene and its images; those that are made once are kept."""

    def __init__(self, xml: str, spp: float):
        # Mitsuba looks filters up in a table of 31 values: 1 % of an image beside a bright lamp.
        self.boxed = re.sub(r'<rfilter type="\w+"', '<rfilter type="box"', xml)
        self.spp = spp
        self.loaded = mlt.load_string(xml, directory=random_scene.FOLDER)
        self.measured: dict[tuple[str, int], same_image.Blocks] = {}
        self.blind: set[str] = set()

    def scene(self, name: str) -> mlt.Scene:
        if name != UNBOUNDED:
            return self.loaded
        return mlt.load_string(self.boxed, directory=random_scene.FOLDER)

    def ambiguous(self) -> bool:
        """Whether what is seen is left to rounding, or to which of two media is meant."""
        return any("same place" in w or "boundaries" in w for w in self.loaded.warnings)

    def blocks(self, name: str, attempt: int = 0) -> same_image.Blocks:
        if (name, attempt) not in self.measured:
            seeds = range(1 + 1000 * attempt, 1 + 1000 * attempt + RUNS)
            spp = self.spp * 4**attempt

            def render(seed):
                return self.image(name, spp, seed)

            self.measured[name, attempt] = same_image.measure(render, SCALES, seeds)
        return self.measured[name, attempt]

    def image(self, name: str, spp: float, seed: int) -> np.ndarray:
        if name == MITSUBA:
            return by_mitsuba(self.boxed, int(spp), seed)
        algorithm = ALGORITHMS.get(name, {"type": "bdpt"}) | ({} if name == UNBOUNDED else DEPTH)
        try:
            result = mlt.start(self.scene(name), algorithm, spp=spp, seed=seed, threads=1).result()
        except mlt.RenderError as error:
            if "no light path was found" not in str(error):
                raise
            return np.zeros((SIZE[1], SIZE[0], 3))
        signs = "cannot find", "true error may be"  # of light that it never finds, or rarely
        misses = any(sign in text for text in result.stats["warnings"] for sign in signs)
        if name == "ptracer" or misses or result.stats["tours_waiting"] > 0.01:
            self.blind.add(name)
        return result.image

    def difference(self, name: str) -> str:
        """How the images of an algorithm differ from those of `bdpt`; "" if they do not."""
        for attempt in (0, 1):
            reference = UNBOUNDED if name == MITSUBA else "bdpt"
            mine, theirs = self.blocks(name, attempt), self.blocks(reference, attempt)
            # What it does not find, it need not have: Mitsuba's path tracing as ours.
            if name in self.blind or (name == MITSUBA and "path" in self.blind):
                mine = replace(mine, mean=np.maximum(mine.mean, theirs.mean))
            if not theirs.mean.any():
                return "finds light where the other finds none" if mine.mean.any() else ""
            verdict = same_image.compare(mine, theirs)
            if not verdict.rejected:
                return ""
        return str(verdict)

    def differences(self, names) -> dict[str, str]:
        return {name: text for name in names if (text := self.difference(name))}


def by_mitsuba(xml: str, spp: int, seed: int) -> np.ndarray:
    import mitsuba as mi

    mi.set_variant("scalar_rgb")
    mi.file_resolver().append(str(random_scene.FOLDER))
    scene = mi.load_string(xml)
    kind = "volpath" if "<medium" in xml else "path"
    integrator = mi.load_dict({"type": kind, "max_depth": -1})
    return np.array(mi.render(scene, integrator=integrator, spp=spp, seed=seed))[..., :3]


def read_by_mitsuba(xml: str) -> bool:
    """Whether Mitsuba is here and can read the scene."""
    if importlib.util.find_spec("mitsuba") is None:
        return False
    try:
        by_mitsuba(xml, 1, 0)
    except Exception:
        return False
    return True


# ---- smaller scenes ------------------------------------------------------------------------------


def smaller(xml: str):
    """Scenes with one element less, the largest elements first."""
    count = len(list(Tree.fromstring(xml).iter()))
    for index in range(1, count):
        root = Tree.fromstring(xml)
        parents = {child: parent for parent in root.iter() for child in parent}
        element = list(root.iter())[index]
        if element.tag in ("film", "sensor", "rfilter"):
            continue
        parents[element].remove(element)
        yield Tree.tostring(root, encoding="unicode")


def shrink(xml: str, name: str, spp: float, seconds: float = 120) -> str:
    """A smaller scene in which the algorithm still differs from `bdpt`."""
    end = time.monotonic() + seconds

    def still_differs(candidate: str) -> bool:
        try:
            scene = Scene(candidate, spp)
            return not scene.ambiguous() and bool(scene.difference(name))
        except mlt.Error:
            return False

    while time.monotonic() < end:
        for candidate in smaller(xml):
            if time.monotonic() > end or still_differs(candidate):
                break
        else:
            return xml
        if time.monotonic() < end:
            xml = candidate
    return xml


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--n", type=int, default=60, help="how many scenes")
    parser.add_argument("--seed", type=int, default=1, help="number of the first scene")
    parser.add_argument("--spp", type=float, default=128, help="samples per pixel of one image")
    parser.add_argument("--scene", type=Path, help="this file instead")
    args = parser.parse_args()
    folder = ROOT / "build" / "differential"
    folder.mkdir(parents=True, exist_ok=True)
    different = compared = 0
    for seed in range(args.seed, args.seed + args.n) if not args.scene else [0]:
        xml = args.scene.read_text() if args.scene else random_scene.random_scene(seed, SIZE)
        start = time.monotonic()
        try:
            scene = Scene(xml, args.spp)
        except mlt.Error as error:
            print(f"{seed}: refused: {error}", flush=True)
            continue
        if scene.ambiguous():
            print(f"{seed}: ambiguous: {scene.loaded.warnings[-1]}", flush=True)
            continue
        names = [*ALGORITHMS, *([MITSUBA] if read_by_mitsuba(xml) else [])]
        found = scene.differences(names)
        compared += 1
        mean = scene.blocks("bdpt").mean[0].mean()
        print(f"{seed}: {len(names)} algorithms, mean {mean:.4g}, blind: {sorted(scene.blind)}, "
              f"{time.monotonic() - start:.0f} s", flush=True)  # fmt: skip
        for name, text in found.items():
            print(f"  {name} and bdpt: {text}", flush=True)
        if found:
            different += 1
            small = shrink(xml, next(iter(found)), args.spp)
            path = folder / f"{seed}.xml"
            path.write_text(small)
            print(f"  a smaller scene that shows it: {path}", flush=True)
    print(f"{different} of {compared} scenes differ")
    return 1 if different or not compared else 0


if __name__ == "__main__":
    sys.exit(main())
