"""Starting: a million triangles from a binary PLY file, bytes per triangle, `import pymlt`.

The mesh is loaded by the C++ program bench_load, which can leave out the hierarchy. The time of
`import pymlt` is that of a fresh interpreter that imports it over one that does not, in turn.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from statistics import median

from common import REPOSITORY, MissingError, parser, print_table, say, write_results


def cpu_seconds_of(command: list[str]) -> float:
    before = getrusage(RUSAGE_CHILDREN)
    subprocess.run(command, check=True)
    after = getrusage(RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def import_seconds(rounds: int) -> float:
    """Median of what `import pymlt` adds to an interpreter's start; both are warm."""
    commands = {text: [sys.executable, "-c", text] for text in ("pass", "import pymlt")}
    times = {text: [] for text in commands}
    for _ in range(rounds + 1):
        for text, command in commands.items():
            times[text].append(cpu_seconds_of(command))
    return median(times["import pymlt"][1:]) - median(times["pass"][1:])


def load_mesh(program: Path, triangles: int) -> dict:
    if not program.exists():
        raise MissingError(
            f"{program} is not there; build with -DPYMLT_BENCHMARKS=ON, or give --program"
        )
    command = [str(program), "--json", "--triangles", str(triangles)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def main() -> None:
    options = parser(__doc__)
    options.add_argument(
        "--program", type=Path, default=REPOSITORY / "build" / "default" / "bench_load"
    )
    options.add_argument("--triangles", type=int, default=1_000_000)
    options.add_argument("--rounds", type=int, default=15, help="of the import")
    args = options.parse_args()

    row = {"import_seconds": import_seconds(args.rounds)}
    try:
        row |= load_mesh(args.program, args.triangles)
    except MissingError as reason:
        say(f"mesh: skipped, {reason}")
    rows = [{"what": name, "value": value} for name, value in row.items()]
    print_table(rows)
    write_results(args.json, "load", {"rounds": args.rounds}, rows)


if __name__ == "__main__":
    main()
