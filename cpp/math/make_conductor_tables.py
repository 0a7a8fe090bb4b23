#!/usr/bin/env python3
"""Writes conductor_tables.inc: measured indices of refraction of metals, thinned.

    python3 make_conductor_tables.py mitsuba/data/ior > conductor_tables.inc

The input is a folder of <name>.eta.spd and <name>.k.spd, lines of a wavelength in nm and a value,
as in Mitsuba 3 (PyPI: mitsuba 3.9.1): tables of luxpop.com and of Palik's handbook. Kept are the
visible range with a pair on each side, and of these the fewest pairs between which linear
interpolation misses no measured value by more than 0.2 %. An eta of 0 says that there is no
measurement (AlAs from 393 to 435 nm), and is left out.
"""

import sys
import textwrap
from pathlib import Path

Pair = tuple[float, float]

FIRST, LAST = 360.0, 830.0  #: nm, the visible range
TOLERANCE = 0.002  #: of the value


def load(path: Path) -> list[Pair]:
    lines = [line.split() for line in path.read_text().splitlines()]
    pairs = [(float(x[0]), float(x[1])) for x in lines if x and not x[0].startswith("#")]
    return [p for p in pairs if p[1] > 0 or path.match("*.k.spd")]


def visible(pairs: list[Pair]) -> list[Pair]:
    start = max((i for i, (nm, _) in enumerate(pairs) if nm <= FIRST), default=0)
    end = min((i for i, (nm, _) in enumerate(pairs) if nm >= LAST), default=len(pairs) - 1)
    return pairs[start : end + 1]


def rounded(pair: Pair) -> Pair:
    return float(f"{pair[0]:.2f}"), float(f"{pair[1]:.4g}")


def stands_for(a: Pair, b: Pair, between: list[Pair]) -> bool:
    """Does the line from a to b reproduce the pairs between?"""
    slope = (b[1] - a[1]) / (b[0] - a[0])
    return all(abs(a[1] + (x - a[0]) * slope - y) <= TOLERANCE * y for x, y in between)


def thinned(pairs: list[Pair]) -> list[Pair]:
    """The fewest pairs that reproduce the others: the way from the first to the last in the
    fewest steps."""
    fewest = [(0, -1)]  # for each pair: steps from the first one, and the pair before it
    for end in range(1, len(pairs)):
        fewest.append(
            min(
                (fewest[i][0] + 1, i)
                for i in range(end)
                if stands_for(rounded(pairs[i]), rounded(pairs[end]), pairs[i + 1 : end])
            )
        )
    kept, i = [], len(pairs) - 1
    while i >= 0:
        kept.append(rounded(pairs[i]))
        i = fewest[i][1]
    return kept[::-1]


def in_cpp(pairs: list[Pair]) -> str:
    return "{" + ", ".join(f"{{{nm:g}, {value:g}}}" for nm, value in pairs) + "}"


def main(folder: Path) -> None:
    print("// Made by make_conductor_tables.py. A conductor, then eta and k: {nm, value}.")
    written: set[str] = set()
    for path in sorted(folder.glob("*.eta.spd")):
        name = path.name.removesuffix(".eta.spd")
        eta, k = (in_cpp(thinned(visible(load(folder / f"{name}.{x}.spd")))) for x in ("eta", "k"))
        row = f"{eta},\n{k}"
        # Most have one set of values under both names.
        if name.endswith("_palik") and name.removesuffix("_palik") + row in written:
            continue
        written.add(name + row)
        for line in f'{{"{name}",\n{row}}},'.split("\n"):
            print(textwrap.fill(line, 100, subsequent_indent=" ", break_on_hyphens=False))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
