"""What the benchmarks share: scenes, references, tables, results."""

from __future__ import annotations

import argparse
import json
import os
import sys
from pathlib import Path

import numpy as np
from peers import HERE, MissingError

from pymlt.race.cpu_time import processor, render_for
from pymlt.race.score import Judge

REPOSITORY = HERE.parent


def parser(doc: str) -> argparse.ArgumentParser:
    summary, _, rest = doc.partition("\n")
    made = argparse.ArgumentParser(
        description=summary,
        epilog=rest,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    made.add_argument("--json", type=Path, help="where to write the results (benchmarks/results/)")
    return made


def shared(relative: str) -> Path:
    """A file of the external scenes."""
    root = Path(os.environ.get("PYMLT_SHARED") or REPOSITORY.parent / "shared")
    if not (root / relative).exists():
        raise MissingError(
            f"{root / relative} is not there; PYMLT_SHARED names the folder of the scenes"
        )
    return root / relative


# ---- references ---------------------------------------------------------------------------------


class Reference:
    """A long render of our own, in two halves that tell how wrong it is; made once and kept."""

    def __init__(self, name, scene, integrator, cpu_seconds, *, threads, folder: Path):
        path = folder / f"{name}-{integrator.to_dict()['type']}-{cpu_seconds:g}s.npz"
        if not path.exists():
            halves = []
            for seed in (1_000_001, 1_000_002):
                say(f"reference {name}: {cpu_seconds / 2:g} CPU seconds with seed {seed}")
                half = render_for(scene, integrator, cpu_seconds / 2, seed=seed, threads=threads)
                halves.append(half.result.image)
            folder.mkdir(parents=True, exist_ok=True)
            np.savez(path, halves=np.stack(halves))
        self.halves = np.load(path)["halves"].astype(np.float64)
        self.image = self.halves.mean(axis=0)

    def errors(self) -> np.ndarray:
        """relMSE of the mean of the halves, by pixel: a quarter of their squared difference."""
        return Judge.with_reference(self.halves).own_error


# ---- reports -----------------------------------------------------------------------------------


def say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def print_table(rows: list[dict]) -> None:
    """The rows' keys are the columns."""
    columns = list(dict.fromkeys(key for row in rows for key in row))
    cells = [[_cell(row.get(column, "")) for column in columns] for row in rows]
    widths = [max(map(len, column)) for column in zip(columns, *cells, strict=True)]
    for line in (columns, *cells):
        print("  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True)))


def _cell(value) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def write_results(path: Path | None, name: str, settings: dict, rows: list[dict]) -> None:
    path = path or HERE / "results" / f"{name}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    document = {"benchmark": name, "machine": processor(), "settings": settings, "rows": rows}
    path.write_text(json.dumps(document, indent=1) + "\n")
    say(f"written to {path}")
