"""Random scenes, rendered by random integrators, stopped and killed at random, for hours.

    make soak HOURS=1                                  with the address sanitizer
    .venv/bin/python tests/soak.py --hours 0.1         with the build that is installed
    .venv/bin/python tests/soak.py --seed 7 --first 31 --rounds 1      one round again

Each round renders a scene in one go, and again with interruptions: jobs that are cancelled and
resumed, processes that are killed with SIGKILL, workers of a cluster that are. Both must end with
the same bits, none of them NaN, and the memory of this process must not grow. Everything is drawn
from the seed and the number of the round, which are printed with a failure.
"""

from __future__ import annotations

import argparse
import faulthandler
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent / "python"))
import random_scene

import pymlt as mlt

SETTINGS = {
    "mlt": [{}, {"two_stage": False}, {"adaptive": False}, {"direct_samples": 4}, {"parts": True}],
    "pssmlt": [{}, {"independent_share": 0.2}, {"estimator": "bdpt"}, {"estimator": "ptracer"}],
    "mmlt": [{}, {"independent_share": 0}],
    "rjmlt": [{}, {"independent_share": 0}],
    "erpt": [{"tour_length": 5}],
    "bdpt": [{}, {"techniques": True, "max_depth": 3}],
}
HANG = 600  # seconds of one round, after which it says where it stands, and ends
GROWTH = 64 << 20  # bytes that may come after the first third of the rounds: caches, fragments


class SoakError(Exception):
    pass


class Round:
    """One scene and one integrator, with what is to happen to them."""

    def __init__(self, seed: int, number: int):
        self.draw = random.Random(f"{seed} {number}")
        self.seed, self.number = seed, number
        self.name = self.draw.choice(mlt.available("integrator"))
        self.integrator = {"type": self.name, **self.draw.choice(SETTINGS.get(self.name, [{}]))}
        if self.name in ("mlt", "pssmlt"):
            self.integrator |= {"chains": 64, "luminance_samples": 1000}
        self.options = {"spp": self.draw.randint(2, 60), "seed": self.draw.randrange(1000)}
        size = self.draw.randint(4, 20), self.draw.randint(4, 16)
        self.xml = random_scene.random_scene(self.draw.randrange(2**32), size)
        self.scene = mlt.load_string(self.xml, directory=random_scene.FOLDER)

    def start(self, **options) -> mlt.Job:
        return mlt.start(self.scene, self.integrator, **self.options, **options)

    def resume(self, path: Path, **options) -> mlt.Job:
        return mlt.resume(path, scene=self.scene, spp=self.options["spp"], **options)

    def go_on(self, path: Path, **options) -> mlt.Job:
        """With the checkpoint, if there was time to write one."""
        return self.resume(path, **options) if path.exists() else self.start(**options)

    def sleep(self, longest: float) -> None:
        time.sleep(self.draw.uniform(0, longest))

    def check(self, folder: Path, interrupt) -> str:
        """How it went, in a word; SoakError if it went wrong."""
        before = time.monotonic()
        try:
            whole = self.start().result()
        except mlt.Error as error:
            return f"refused: {error}"
        seconds = time.monotonic() - before
        again = interrupt(self, folder / "state.mlt", seconds)
        layers = {"image": (whole.image, again.image)}
        layers |= {name: (layer, again.layers[name]) for name, layer in whole.layers.items()}
        for name, (expected, found) in layers.items():
            if np.isnan(expected).any() and name != "error":  # an error that is not known is NaN
                raise SoakError(f"{name} has NaN")
            if not np.array_equal(expected, found, equal_nan=True):
                raise SoakError(f"{name} differs after {interrupt.__name__}")
        return interrupt.__name__


# ---- interruptions -------------------------------------------------------------------------------


def pauses(work: Round, path: Path, seconds: float) -> mlt.Result:
    """Cancelled here and resumed here, with other numbers of threads."""
    job = work.start(threads=2)
    for _ in range(work.draw.randint(1, 3)):
        work.sleep(seconds / 2)
        job.checkpoint(path)
        job.cancel()
        job.wait()
        job = work.resume(path, threads=work.draw.randint(1, 3))
    return job.result()


CHILD = "import sys; sys.path.insert(0, {folder!r}); import soak; soak.child({arguments})"


def child(seed: int, number: int, path: str) -> None:
    """In a process of its own: goes on with a checkpoint, or begins it."""
    work = Round(seed, number)
    work.go_on(Path(path), checkpoint=path, every=0.01).wait()


def kills(work: Round, path: Path, seconds: float) -> mlt.Result:
    """Killed in the middle, several times."""
    arguments = f"{work.seed}, {work.number}, {str(path)!r}"
    code = CHILD.format(folder=str(Path(__file__).parent), arguments=arguments)
    for _ in range(work.draw.randint(1, 3)):
        process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True)
        work.sleep(1 + seconds)
        process.send_signal(signal.SIGKILL)
        _, errors = process.communicate()
        if process.returncode not in (0, -signal.SIGKILL):
            raise SoakError(f"the child ended with {process.returncode}: {errors}")
    Path(f"{path}.lock").unlink(missing_ok=True)
    return work.go_on(path).result()


WORKER = "-m distributed.cli.dask_worker --no-nanny --no-dashboard --nthreads 1 --memory-limit 0"


class Workers:
    """A cluster of two processes. Without dask's guards, which give up a process that is killed
    while it starts."""

    def __enter__(self):
        import distributed

        self.cluster = distributed.LocalCluster(
            n_workers=0, dashboard_address="127.0.0.1:0", silence_logs=60
        )
        self.client = distributed.Client(self.cluster)
        self.processes: list[subprocess.Popen] = []
        self.complete()
        return self

    def __exit__(self, *_):
        for process in self.processes:
            process.kill()
            process.wait()
        self.client.close()
        self.cluster.close()

    def complete(self) -> None:
        """There are two again; SoakError if one has ended of itself."""
        ended = [process for process in self.processes if process.poll() is not None]
        if any(process.returncode != -signal.SIGKILL for process in ended):
            raise SoakError("a worker has ended of itself")
        self.processes = [process for process in self.processes if process not in ended]
        command = [sys.executable, *WORKER.split(), self.cluster.scheduler_address]
        quiet = os.environ | {"DASK_LOGGING__DISTRIBUTED": "critical"}
        while len(self.processes) < 2:
            self.processes.append(subprocess.Popen(command, env=quiet))

    def deaths(self, work: Round, path: Path, seconds: float) -> mlt.Result:
        """Workers are killed, the render is cancelled and resumed on the cluster or here."""
        job = work.start(cluster=self.client, checkpoint=path, every=0.1)
        for _ in range(work.draw.randint(1, 3)):
            work.sleep(0.5 + seconds)
            work.draw.choice(self.processes).kill()
            if work.draw.random() < 0.5:
                self.complete()
        job.cancel()
        job.wait()
        self.complete()
        return work.go_on(path, cluster=work.draw.choice([None, self.client])).result()


# ---- the soak ------------------------------------------------------------------------------------


def memory() -> int:
    """Bytes that this process has in memory."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def soak(seed: int, first: int, rounds: int | None, seconds: float, cluster: bool) -> None:
    """Prints a line for each round. Raises SoakError at the first that goes wrong."""
    end = time.monotonic() + seconds
    sizes = []
    counts: dict[str, int] = {}
    with Workers() if cluster else open(os.devnull) as workers:
        number = first
        while number - first != rounds and time.monotonic() < end:
            work = Round(seed, number)
            faulthandler.dump_traceback_later(HANG, exit=True)
            ways = [pauses, kills, *([workers.deaths] if cluster else [])]
            with tempfile.TemporaryDirectory() as folder:
                try:
                    how = work.check(Path(folder), work.draw.choice(ways))
                except Exception as error:
                    raise SoakError(f"seed {seed}, round {number}: {error}") from error
            sizes.append(memory())
            faulthandler.cancel_dump_traceback_later()
            counts[how.split(":")[0]] = counts.get(how.split(":")[0], 0) + 1
            print(f"{number}: {work.integrator}, {how}, {sizes[-1] >> 20} MiB", flush=True)
            number += 1
    print(f"seed {seed}: {counts}, {sizes[0] >> 20} to {sizes[-1] >> 20} MiB")
    if sizes[-1] > sizes[len(sizes) // 3] + GROWTH:
        raise SoakError("memory grows")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--hours", type=float, default=1)
    parser.add_argument("--seed", type=int, default=random.randrange(2**32))
    parser.add_argument("--first", type=int, default=0, help="number of the first round")
    parser.add_argument("--rounds", type=int, help="no more than these")
    parser.add_argument("--no-cluster", action="store_true")
    args = parser.parse_args()
    print(f"seed {args.seed}", flush=True)
    soak(args.seed, args.first, args.rounds, 3600 * args.hours, not args.no_cluster)
    return 0


if __name__ == "__main__":
    sys.exit(main())
