"""Rendering on many machines: bytes and CPU time of tasks and results, and 1, 2, 4 processes.

The constants of the cost model in docs/many-machines.md. A task of a render is written, run and
merged within this process, so that nothing but that is measured; a task without work shows what one
costs at least. Then a whole render on this process with one thread and on clusters of 1, 2
and 4 processes with one thread each, in turn: the quotient of their wall times is the speed-up,
that of their CPU times (all processes of the cluster) what dividing the render costs. What dask's
processes use while nothing is rendered is paid per second of wall time, so a machine that has other
work to do makes it a larger share.
"""

from __future__ import annotations

import pickle
from statistics import median
from time import perf_counter, process_time, sleep

from common import parser, print_table, say, write_results

import pymlt as mlt
from pymlt import _core
from pymlt.algorithms.integrator import as_integrator


def cpu(function, *arguments):
    start = process_time()
    result = function(*arguments)
    return result, process_time() - start


class Measured:
    """An executor that takes one task of the render some stages on and measures that."""

    def __init__(self, scene, integrator, tasks: int, rounds: int, cycles: float):
        self.helper = _core.Helper(scene, integrator)
        self.tasks, self.rounds, self.cycles = tasks, rounds, cycles
        self.times = {"task": [], "empty": [], "merge": []}

    def wanted_tasks(self) -> int:
        return self.tasks

    def run(self, job, to: int) -> None:
        units = round(self.cycles * job.units_per_cycle)
        for _ in range(self.rounds):
            position = job.position(0)
            _, seconds = cpu(self.helper.run, job.task(0, position), 1)
            self.times["empty"].append(seconds)
            task, seconds = cpu(job.task, 0, position + units)
            self.times["task"].append(seconds)
            result = self.helper.run(task, 1)
            _, seconds = cpu(job.merge, 0, result)
            self.times["merge"].append(seconds)
        self.task_bytes, self.result_bytes, self.cut_into = len(task), len(result), job.task_count
        job.cancel()

    def close(self) -> None:
        pass


def costs(scene, name: str, tasks: int, rounds: int) -> dict:
    """Of one task of a render."""
    integrator = as_integrator(scene, name)
    job = _core.Job(scene, integrator, 1e6, None, None, 1, 1)
    # A cycle of bdpt is 128 passes over the image, 8 for each group; one is enough here.
    measured = Measured(scene, integrator, tasks, rounds, 1 / 128 if name == "bdpt" else 1)
    job.attach(measured)
    job.start()
    job.wait(float("inf"))
    pixels = scene.width * scene.height
    return {
        "integrator": name,
        "size": f"{scene.width}x{scene.height}",
        "tasks": measured.cut_into,
        "task bytes": measured.task_bytes,
        "result bytes": measured.result_bytes,
        "all results, bytes/pixel": measured.result_bytes * measured.cut_into / pixels,
        "task ms": 1e3 * median(measured.times["task"]),
        "empty ms": 1e3 * median(measured.times["empty"]),
        "merge ms": 1e3 * median(measured.times["merge"]),
    }


class Cluster:
    """So many processes; counts the CPU seconds of all of them."""

    def __init__(self, processes: int):
        from distributed import Client

        from pymlt.rendering.cluster.local import local_cluster

        self.cluster = local_cluster(f"local:{processes}")
        self.client = Client(self.cluster)
        self.client.wait_for_workers(processes)

    def cpu_seconds(self) -> float:
        workers = sum(self.client.run(process_time).values())
        return workers + self.client.run_on_scheduler(process_time) + process_time()

    def idle(self, seconds: float) -> dict:
        """CPU time of each process without work, in percent of the time."""
        before = self.client.run(process_time), self.client.run_on_scheduler(process_time)
        start = perf_counter()
        sleep(seconds)
        wall = perf_counter() - start
        workers = [used - before[0][name] for name, used in self.client.run(process_time).items()]
        scheduler = self.client.run_on_scheduler(process_time) - before[1]
        return {
            "idle worker, %": 100 * median(workers) / wall,
            "idle scheduler, %": 100 * scheduler / wall,
        }

    def close(self) -> None:
        self.client.close()
        self.cluster.close()


def scaling(scene, name: str, spp: float, rounds: int) -> list[dict]:
    clusters = {n: Cluster(n) for n in (1, 2, 4)}
    measured = {n: [] for n in (0, *clusters)}
    for passes in [1, *[spp] * rounds]:  # the first ones warm up
        for n in measured:
            cluster = clusters.get(n)
            before = cluster.cpu_seconds() if cluster else process_time()
            start = perf_counter()
            where = {"cluster": cluster.client} if cluster else {"threads": 1}
            mlt.render(scene, name, spp=passes, seed=1, progress=False, **where)
            wall = perf_counter() - start
            after = cluster.cpu_seconds() if cluster else process_time()
            measured[n].append((wall, after - before))
    for cluster in clusters.values():
        cluster.close()
    rows = []
    for n, pairs in measured.items():
        pairs = pairs[1:]
        alone = measured[0][1:]
        rows.append(
            {
                "integrator": name,
                "processes": n or "this one",
                "wall s": median(wall for wall, _ in pairs),
                "CPU s": median(used for _, used in pairs),
                "speed-up": median(a[0] / p[0] for a, p in zip(alone, pairs, strict=True)),
                "CPU ratio": median(p[1] / a[1] for a, p in zip(alone, pairs, strict=True)),
            }
        )
    return rows


def main() -> None:
    options = parser(__doc__)
    options.add_argument("--rounds", type=int, default=5)
    options.add_argument("--seconds", type=float, default=20, help="of one render, alone")
    options.add_argument("--tasks", type=int, default=64)
    args = options.parse_args()
    box = mlt.scenes.cornell_box()
    small, large = (mlt.load_dict(box, size=size) for size in ((320, 180), (1920, 1080)))
    say(f"the scene travels as {len(pickle.dumps(small))} bytes")
    rows = [
        costs(scene, name, args.tasks, args.rounds)
        for scene in (small, large)
        for name in ("path", "bdpt", "pssmlt", "mlt")
    ]
    print_table(rows)
    cluster = Cluster(2)
    rows.append(cluster.idle(args.seconds))
    print_table(rows[-1:])
    cluster.close()
    for name in ("path", "mlt"):
        _, seconds = cpu(lambda name=name: mlt.render(small, name, spp=64, threads=1))
        speed_ups = scaling(small, name, round(64 * args.seconds / seconds), args.rounds)
        print_table(speed_ups)
        rows += speed_ups
    settings = {"rounds": args.rounds, "seconds": args.seconds, "tasks": args.tasks}
    write_results(args.json, "cluster", settings, rows)


if __name__ == "__main__":
    main()
