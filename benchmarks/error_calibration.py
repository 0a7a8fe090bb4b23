"""The error that renders claim over the error that they have: docs/error-calibration.md.

Each integrator renders each built-in scene, small, with several seeds by its default settings. The
page's further sections stay as they are.
"""

from __future__ import annotations

from common import REPOSITORY, parser, print_table, say, write_results

import pymlt as mlt
from pymlt.diagnostics.error_calibration import Calibration, calibrate

INTEGRATORS = ["path", "bdpt", "pssmlt", "mmlt", "mlt"]
SIZE = (48, 32)
LOW, HIGH = 0.8, 1.25
PAGE = REPOSITORY / "docs" / "error-calibration.md"

TEXT = """# How true the claimed error is

`stats["error"]` is an [estimate](long-renders.md) from one render. Here it is compared with the
error that the same renders have: each of the built-in scenes at {width} x {height}, by the default
settings of each integrator, {spp} spp, {seeds} seeds. The first number is the claimed error over
the true one (roots of mean squares over the seeds); the second, in brackets, the true error, root
of relMSE: how much the renders of an integrator differ from each other; where long tours of `mlt`
wait, also how much their mean differs from that of the others, beyond the noise of both. With a
star: most of the mean square of the claims is of renders that warn that their error may be larger
than they say, since a few pixels carry it, or since the brightness of the image is not known yet.
Of {count} cells {good} lie between {low} and {high}, and {rest} of the others have a star. Where a
few pixels of a few renders decide, the true error is itself known only roughly from so few seeds.
`path` and `pssmlt` are left out where they say that they cannot find some light.

Made by `python benchmarks/error_calibration.py`.

{table}
"""


def cell(one: Calibration) -> str:
    return f"{one.ratio:.2f}{'*' if one.warned >= 0.5 else ''} ({one.true:.3f})"


def cells(row: list[Calibration]) -> list[str]:
    """One for each integrator, empty for those that cannot find all light."""
    known = {one.integrator: cell(one) for one in row}
    return [known.get(integrator, "") for integrator in INTEGRATORS]


def page(found: dict[str, list[Calibration]], spp: int, seeds: int) -> str:
    every = [one for row in found.values() for one in row]
    outside = [one for one in every if not LOW <= one.ratio <= HIGH]
    lines = ["| scene | " + " | ".join(INTEGRATORS) + " |", "|---" * (len(INTEGRATORS) + 1) + "|"]
    lines += [
        f"| {name.replace('_', '-')} | " + " | ".join(cells(row)) + " |"
        for name, row in found.items()
    ]
    return TEXT.format(
        width=SIZE[0],
        height=SIZE[1],
        spp=spp,
        seeds=seeds,
        count=len(every),
        good=len(every) - len(outside),
        rest=sum(one.warned >= 0.5 for one in outside),
        low=LOW,
        high=HIGH,
        table="\n".join(lines),
    )


def main() -> None:
    arguments = parser(__doc__)
    arguments.add_argument("--scenes", nargs="*", default=mlt.scenes.names())
    arguments.add_argument("--seeds", type=int, default=12)
    arguments.add_argument("--spp", type=int, default=128)
    arguments.add_argument("--threads", type=int, default=0)
    args = arguments.parse_args()
    found = {}
    for name in args.scenes:
        say(name)
        scene = mlt.load_dict(getattr(mlt.scenes, name)(), size=SIZE)
        seeds = range(1, args.seeds + 1)
        found[name] = calibrate(scene, INTEGRATORS, seeds=seeds, spp=args.spp, threads=args.threads)
        print_table([{"scene": name} | {c.integrator: cell(c) for c in found[name]}])
    rows = [
        {"scene": name, "integrator": c.integrator, "true": c.true, "claimed": c.claimed}
        | {"warned": c.warned}
        for name, row in found.items()
        for c in row
    ]
    write_results(args.json, "error_calibration", {"seeds": args.seeds, "spp": args.spp}, rows)
    further = PAGE.read_text().partition("\n## ")
    PAGE.write_text(page(found, args.spp, args.seeds) + "".join(further[1:]))


if __name__ == "__main__":
    main()
