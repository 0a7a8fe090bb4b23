"""What checkpoints and error estimates cost, in CPU time of the whole process.

Renders with and without a checkpoint every few seconds take turns; the quotient of their CPU times
gives the cost of one checkpoint, and so the overhead at the default interval of 60 s on as many
threads. The error is estimated once, at the end of each render without checkpoints, over the CPU
time of that render.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from statistics import median
from time import process_time

from common import parser, print_table, say, write_results

import pymlt as mlt


def measure(scene, integrator: str, args, path: Path) -> dict:
    """Medians over the rounds, for one integrator."""
    plain, saving, estimating, written = [], [], [], []
    pilot = mlt.start(scene, integrator, time=args.seconds, threads=args.threads)
    spp = pilot.result().stats["spp_done"]
    for _ in range(args.rounds):
        start = process_time()
        job = mlt.start(scene, integrator, spp=spp, threads=args.threads)
        job.wait()
        plain.append(process_time() - start)
        start = process_time()
        job.result()
        estimating.append((process_time() - start) / plain[-1])
        job = mlt.start(scene, integrator, spp=spp, threads=args.threads, checkpoint=path, every=1)
        start, writes, seen = process_time(), 0, 0
        while not job.wait(0.05):
            if path.exists() and path.stat().st_mtime_ns != seen:
                writes, seen = writes + 1, path.stat().st_mtime_ns
        saving.append(process_time() - start)
        written.append(writes + 1)
    one = median((s - p) / w for s, p, w in zip(saving, plain, written, strict=True))
    return {
        "integrator": integrator,
        "spp": spp,
        "megabytes": path.stat().st_size / 1e6,
        "cpu_seconds_per_checkpoint": one,
        "overhead_every_60_s": one / (60 * args.threads),
        "overhead_of_the_error": median(estimating),
    }


def main() -> None:
    options = parser(__doc__)
    options.add_argument("--size", default="640x360", help="of the image")
    options.add_argument("--seconds", type=float, default=10, help="of wall time for each render")
    options.add_argument("--rounds", type=int, default=5)
    options.add_argument("--threads", type=int, default=2)
    args = options.parse_args()
    size = tuple(map(int, args.size.split("x")))
    scene = mlt.load_dict(mlt.scenes.door_ajar(), size=size)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for integrator in ("path", "bdpt", "pssmlt", "mlt"):
            say(f"{integrator} ...")
            rows.append(measure(scene, integrator, args, Path(folder) / integrator))
    print_table(rows)
    settings = {"size": args.size, "seconds": args.seconds, "threads": args.threads}
    write_results(args.json, "checkpoints", settings, rows)


if __name__ == "__main__":
    main()
