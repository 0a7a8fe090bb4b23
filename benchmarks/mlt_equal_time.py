"""Equal-time error of all algorithms, and of other programs, on scenes of many kinds.

Some are Metropolis's own ground (doors that let little light in, a torus in a glass block, light
through water), some are caustics, and in some, as the Cornell box, chains alone have nothing to
win. `mlt` and `pssmlt` are also measured without independent samples, as "chains". Each image gets
`--seconds` on each of `--threads` threads, measured as CPU time; see docs/race.md for what is
measured. References are two long halves of our own, whose error is subtracted, but for veachdoor's,
which has a relMSE of about 0.002, and those of a folder that is given. With --reference-seconds 0
there are no others, and the spread of the seeds tells, which does not see light that nobody finds.

--page also writes a page of the documentation, with a picture for each scene beside it.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from common import HERE, REPOSITORY, Reference, parser, say, shared
from peers import MissingError
from race_page import write_page

import pymlt as mlt
from pymlt.race.algorithm import contestants

ALONE = "independent_share=0"
ALGORITHMS = {
    "path": "path",
    "bdpt": "bdpt",
    "pssmlt, chains": f"pssmlt:{ALONE}",
    "pssmlt": "pssmlt",
    "pssmlt over bdpt": "pssmlt:bidirectional=true",
    "mmlt": "mmlt",
    "rjmlt": "rjmlt",
    "erpt": "erpt",
    "mlt, chains": f"mlt:{ALONE},two_stage=false",
    "mlt": "mlt",
}


class Case(NamedTuple):
    """A scene and what its images are compared with."""

    file: str  #: of the repository, or of the external scenes
    size: tuple[int, int]
    #: The integrator that finds all of its light and renders it with the least noise, or a file of
    #: the external references.
    reference: str
    max_depth: int = 8

    def path(self) -> Path:
        own = REPOSITORY / self.file
        return own if own.exists() else shared(self.file)


CASES = {
    name: Case(f"scenes/{name}/scene.xml", size, reference, *max_depth)
    for name, size, reference, *max_depth in (
        ("veachdoor", (320, 180), "veachdoor-320x180.exr"),
        ("torus-lmc", (320, 240), "mlt"),
        ("ring-caustic", (320, 240), "mlt"),
        ("cornell-box", (256, 256), "bdpt"),
        ("veach-bidir", (320, 180), "bdpt"),
        ("glass-ball", (256, 256), "mlt"),
        ("door-ajar", (320, 240), "mlt"),
        ("pool", (320, 240), "mlt"),
        ("goblets", (320, 180), "mlt"),
        ("temple", (320, 180), "mlt"),
        ("living-room", (320, 180), "path"),
        ("ring", (256, 256), "mlt"),
        ("bulb", (256, 256), "bdpt"),
        ("orrery", (320, 180), "path"),
        ("motion", (320, 180), "mlt"),
        ("dof", (256, 256), "mlt"),
        ("furnace", (128, 128), "path"),
        ("cbox-ppg", (256, 256), "bdpt"),
        ("matpreview", (256, 256), "path"),
        ("veach-mi", (320, 180), "path"),
        ("fog", (320, 180), "mlt"),
        ("volcaustic", (320, 180), "mlt"),
        ("smoke", (320, 180), "path", 16),
        ("milk", (320, 180), "bdpt", 64),
        ("candle", (320, 180), "bdpt", 64),
        ("skin", (320, 180), "bdpt", 64),
        ("prism", (320, 180), "bdpt", 10),
        ("diamond", (320, 180), "bdpt", 16),
        ("rainbow", (320, 180), "mlt", 6),
    )
}


def is_known(text: str) -> bool:
    """Whether this build has the algorithm, with these parameters."""
    try:
        contestants([text], mlt.load_dict(mlt.scenes.furnace()))
    except mlt.SceneError:
        return False
    return True


def reference(name: str, scene: mlt.Scene, case: Case, args):
    """A file, or two images of our own."""
    if args.references and (kept := args.references / f"{name}.exr").exists():
        return kept
    if case.reference.endswith(".exr"):
        return shared(f"references/{case.reference}")
    if not args.reference_seconds:
        return None
    # Light that one candidate in 100,000 finds must be there as well.
    many = {"luminance_samples": 1_000_000, "independent_share": 0.3}
    kinds = {"path": (mlt.Path, {}), "bdpt": (mlt.BDPT, {}), "mlt": (mlt.MLT, many)}
    kind, parameters = kinds[case.reference]
    made = kind(max_depth=case.max_depth, **parameters)
    long = args.reference_seconds
    return list(Reference(name, scene, made, long, threads=args.threads, folder=args.cache).halves)


def entrants(max_depth: int, args) -> list:
    """Labels and algorithms; depths are part of the names."""
    chosen = []
    for label in args.algorithms:
        name, _, parameters = ALGORITHMS[label].partition(":")
        depth = f"max_depth={max_depth}"
        chosen.append((label, f"{name}:{depth}" + (f",{parameters}" if parameters else "")))
    return [*chosen, *args.programs]


def program(text: str) -> mlt.Program:
    label, _, command = text.partition("=")
    return mlt.Program(command, label)


def race_on(name: str, args) -> mlt.RaceResult:
    case = CASES[name]
    path = case.path()
    scene = mlt.load_file(path, size=case.size)
    result = mlt.equal_time(
        entrants(case.max_depth, args),
        scene,
        reference(name, scene, case, args),
        seconds=args.seconds,
        repeats=args.repeats,
        threads=args.threads,
        name=name,
        scene_file=path,
    )
    print(result, end="\n\n", flush=True)
    return result


def main() -> None:
    there = [label for label, text in ALGORITHMS.items() if is_known(text)]
    options = parser(__doc__)
    options.add_argument("--seconds", type=float, default=20, help="for each image and thread")
    options.add_argument("--threads", type=int, default=2)
    options.add_argument("--repeats", type=int, default=3, help="with other seeds")
    options.add_argument("--reference-seconds", type=float, default=1200)
    options.add_argument("--scenes", nargs="+", choices=list(CASES), default=list(CASES))
    options.add_argument("--algorithms", nargs="+", choices=there, default=there)
    options.add_argument(
        "--program",
        dest="programs",
        metavar="LABEL=COMMAND",
        type=program,
        action="append",
        default=[],
        help="another renderer, as for pymlt race",
    )
    options.add_argument("--references", type=Path, help="a folder with images SCENE.exr")
    options.add_argument("--cache", type=Path, default=REPOSITORY / "build" / "references")
    options.add_argument("--html", type=Path, help="the page with everything")
    options.add_argument("--page", type=Path, help="a page of the documentation, in Markdown")
    args = options.parse_args()

    race = mlt.Race([])
    for name in args.scenes:
        try:
            race.results.append(race_on(name, args))
        except MissingError as reason:
            say(f"{name}: skipped, {reason}")
            continue
        race.save_json(args.json or HERE / "results" / "mlt_equal_time.json")  # hours of work
        if args.html:
            race.save_html(args.html)
        if args.page:
            write_page(race, args.page)
    if not race.results:
        raise SystemExit("no scene to measure")
    print(race.table())


if __name__ == "__main__":
    main()
