"""What the benchmarks share: CPU time, errors, peers in processes of their own, tables, results.

Times are CPU seconds of the whole process (user and system, all threads), which a busy machine
stretches far less than wall time.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import subprocess
import sys
from pathlib import Path
from time import process_time

import numpy as np

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parent


class MissingError(Exception):
    """What a benchmark needs is not there."""


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


# ---- errors ------------------------------------------------------------------------------------


def relative_errors(image, reference) -> np.ndarray:
    """(a - r)^2 / (r^2 + 0.01) of each pixel, mean over the channels."""
    a, r = (np.asarray(x, dtype=np.float64) for x in (image, reference))
    return ((a - r) ** 2 / (r**2 + 0.01)).mean(axis=2)


def trimmed_mean(errors, dropped: float = 0.001) -> float:
    """Without the share of the pixels that are worst."""
    errors = np.sort(np.ravel(errors))
    return float(errors[: max(1, int(np.floor((1 - dropped) * errors.size)))].mean())


# ---- rendering ---------------------------------------------------------------------------------


def render_for(scene, integrator, cpu_seconds: float, *, seed: int, threads: int):
    """Render until this process has used `cpu_seconds` of CPU time; the Result, and the time used.

    Bootstrap and adaptation count, loading the scene does not.
    """
    import pymlt as mlt

    start = process_time()
    job = mlt.start(scene, integrator, spp=1e9, seed=seed, threads=threads)
    while process_time() - start < cpu_seconds and not job.wait(0.01):
        pass
    job.cancel()
    result = job.result()
    return result, process_time() - start


class Reference:
    """A long render of our own, in two halves that tell how wrong it is; made once and kept."""

    def __init__(self, name, scene, integrator, cpu_seconds, *, threads, folder: Path):
        path = folder / f"{name}-{integrator.to_dict()['type']}-{cpu_seconds:g}s.npz"
        if not path.exists():
            halves = []
            for seed in (1_000_001, 1_000_002):
                say(f"reference {name}: {cpu_seconds / 2:g} CPU seconds with seed {seed}")
                half, _ = render_for(scene, integrator, cpu_seconds / 2, seed=seed, threads=threads)
                halves.append(half.image)
            folder.mkdir(parents=True, exist_ok=True)
            np.savez(path, halves=np.stack(halves))
        self.halves = np.load(path)["halves"].astype(np.float64)
        self.image = self.halves.mean(axis=0)

    def errors(self) -> np.ndarray:
        """relMSE of the mean of the halves, by pixel: a quarter of their squared difference."""
        squared = ((self.halves[0] - self.halves[1]) ** 2) / 4
        return (squared / (self.image**2 + 0.01)).mean(axis=2)


# ---- peers -------------------------------------------------------------------------------------


class Worker:
    """A renderer in a process of its own; answers each line of JSON with one."""

    def __init__(self, python, script: str, *arguments: str, environment=None):
        command = [str(python), str(HERE / script), *arguments]
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, **(environment or {})},
        )
        self.ready = self._answer()

    def ask(self, **request):
        self.process.stdin.write(json.dumps(request) + "\n")
        self.process.stdin.flush()
        return self._answer()

    def close(self):
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.close()
        self.process.wait()

    def _answer(self):
        for line in self.process.stdout:
            if line.startswith("{"):  # libraries talk, too
                answer = json.loads(line)
                if "skip" in answer:
                    raise MissingError(answer["skip"])
                return answer
        last = self.process.stderr.read().strip().splitlines()[-1:]
        raise MissingError(f"{self.process.args[1]} ended: {' '.join(last) or 'no reason given'}")


def serve(ready: dict, answer) -> None:
    """The other side of Worker."""
    print(json.dumps(ready), flush=True)
    for line in sys.stdin:
        print(json.dumps(answer(**json.loads(line))), flush=True)


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
    document = {"benchmark": name, "machine": machine(), "settings": settings, "rows": rows}
    path.write_text(json.dumps(document, indent=1) + "\n")
    say(f"written to {path}")


def machine() -> str:
    """The class of the processor, and how many of them."""
    model = "unknown processor"
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                model = line.partition(":")[2].strip()
                break
    return f"{model}, {os.cpu_count()} logical processors"
