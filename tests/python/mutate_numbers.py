"""Renders scenes in which one number at a time is another one; run by test_magnitudes.py.

mutate_numbers.py EVERY FIRST FILE... takes every EVERY-th of all mutations, from FIRST on.
"""

import re
import sys
from pathlib import Path

import pymlt as mlt

OTHERS = ["1e20", "-1e20", "1e-30", "1e38", "nan", "inf"]
NUMBER = re.compile(r"(?<=[\"', ])-?\d+\.?\d*(?:e-?\d+)?(?=[\"', ])")
FEW = {"chains": 16, "luminance_samples": 16}
ALONE = FEW | {"independent_share": 0}
INTEGRATORS = [
    mlt.Path(max_depth=4),
    mlt.BDPT(max_depth=4),
    mlt.PTracer(max_depth=4),
    mlt.MLT(max_depth=4, adaptive=False, **ALONE),
    mlt.PSSMLT(max_depth=4, **ALONE),
    mlt.MMLT(max_depth=4, **ALONE),
    mlt.ERPT(max_depth=4, **FEW),
]


def mutations(files: list[str]):
    for file in files:
        text = Path(file).read_text()
        for number in list(NUMBER.finditer(text))[1:]:  # but for the version
            for other in OTHERS:
                line = text.count("\n", 0, number.start()) + 1
                where = f"{file}:{line}: {number[0]} -> {other}"
                yield where, file, text[: number.start()] + other + text[number.end() :]


def render(file: str, text: str, which: int) -> str:
    try:
        scene = mlt.load_string(text, directory=Path(file).parent, size=(6, 4))
        mlt.render(scene, INTEGRATORS[which % len(INTEGRATORS)], spp=1, threads=1)
    except mlt.Error as error:
        return f"{type(error).__name__}: {error}"
    return "rendered"


if __name__ == "__main__":
    every, first, *files = sys.argv[1:]
    for i, (where, file, text) in enumerate(mutations(files)):
        if i % int(every) == int(first):
            print(where, end=" ", flush=True)
            print(render(file, text, i // int(every)), flush=True)
