"""Equal-time error of path, bdpt, pssmlt and mlt on eight scenes.

Some are Metropolis's own ground (doors that let little light in, a torus in a glass block, light
through water), some are caustics, and in some, as the Cornell box, chains alone have nothing to
win. `mlt` and `pssmlt` are also measured without independent samples, as "chains". Each image gets
`--seconds` on each of `--threads` threads, measured as CPU time; bootstrap and adaptation count.

relMSE is the mean of (a - r)^2 / (r^2 + 0.01); "trimmed" leaves out the worst 0.1 % of the pixels.
The reference's own error is subtracted where it is known: a reference of our own is the mean of two
independent halves, which tell it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from statistics import median

import numpy as np
from common import (
    REPOSITORY,
    MissingError,
    Reference,
    parser,
    print_table,
    relative_errors,
    render_for,
    say,
    shared,
    trimmed_mean,
    write_results,
)

ALGORITHMS = ("path", "bdpt", "pssmlt, chains", "pssmlt", "mlt, chains", "mlt")


@dataclass
class Case:
    """A scene and what its images are compared with."""

    name: str
    scene: object
    reference: np.ndarray
    error: float  #: relMSE of the reference itself
    trimmed_error: float


def integrator(name: str, max_depth: int = 8, **parameters):
    import pymlt as mlt

    kind, _, chains = name.partition(", ")
    made = {"path": mlt.Path, "bdpt": mlt.BDPT, "pssmlt": mlt.PSSMLT, "mlt": mlt.MLT}[kind]
    alone = {"independent_share": 0} if chains else {}
    if name == "mlt, chains":
        alone["two_stage"] = False
    return made(max_depth=max_depth, **alone, **parameters)


def own_reference(name: str, scene, args, algorithm: str) -> Case:
    # Light that one candidate in 100,000 finds must be there as well.
    many = {"luminance_samples": 1_000_000, "independent_share": 0.3} if algorithm == "mlt" else {}
    reference = Reference(
        name,
        scene,
        integrator(algorithm, **many),
        args.reference_seconds,
        threads=args.threads,
        folder=args.cache,
    )
    errors = reference.errors()
    return Case(name, scene, reference.image, float(errors.mean()), trimmed_mean(errors))


def veachdoor(args) -> Case:
    """The stored reference has a relMSE of about 0.002, mostly low-frequency: none is trimmed."""
    import pymlt as mlt

    scene = mlt.load_file(shared("scenes/veachdoor/scene.xml"), size=(320, 180))
    image = mlt.read_image(shared("references/veachdoor-320x180.exr"))[..., :3]
    return Case("veachdoor", scene, image, 0.002, 0.002)


def torus(args) -> Case:
    """The stored reference is rough inside the glass, but its mean is good to 1 %."""
    import pymlt as mlt

    scene = mlt.load_file(shared("scenes/torus-lmc/scene.xml"), size=(320, 240))
    case = own_reference("torus-lmc", scene, args, "mlt")
    stored = mlt.read_image(shared("references/torus-lmc-320x240.exr"))[..., :3]
    ratio = case.reference.mean() / stored.mean()
    say(f"torus-lmc: mean of our reference over that of the stored one: {ratio:.4f}")
    return case


def ring(args) -> Case:
    import pymlt as mlt

    scene = mlt.load_file(shared("scenes/ring-caustic/scene.xml"), size=(320, 240))
    return own_reference("ring-caustic", scene, args, "mlt")


def cornell_box(args) -> Case:
    import pymlt as mlt

    description = mlt.scenes.cornell_box()
    description["sensor"]["film"]["rfilter"] = {"type": "box"}
    scene = mlt.load_dict(description, size=(256, 256))
    return own_reference("cornell-box", scene, args, "bdpt")


def own_scene(name: str, size, algorithm: str):
    def case(args) -> Case:
        import pymlt as mlt

        path = REPOSITORY / "scenes" / name / "scene.xml"
        return own_reference(name, mlt.load_file(path, size=size), args, algorithm)

    return case


def veach_bidir(args) -> Case:
    import pymlt as mlt

    scene = mlt.load_file(shared("scenes/veach-bidir/scene.xml"), size=(320, 180))
    return own_reference("veach-bidir", scene, args, "bdpt")


CASES = {
    "veachdoor": veachdoor,
    "torus-lmc": torus,
    "ring-caustic": ring,
    "cornell-box": cornell_box,
    "veach-bidir": veach_bidir,
    "glass-ball": own_scene("glass-ball", (256, 256), "mlt"),
    "door-ajar": own_scene("door-ajar", (320, 240), "mlt"),
    "pool": own_scene("pool", (320, 240), "mlt"),
}


def measure(case: Case, args) -> list[dict]:
    images = {name: [] for name in args.integrators}
    rates = {name: [] for name in args.integrators}
    pixels = case.scene.width * case.scene.height
    for seed in range(args.repeats):
        for name in args.integrators:
            result, used = render_for(
                case.scene,
                integrator(name),
                args.seconds * args.threads,
                seed=seed,
                threads=args.threads,
            )
            images[name].append(result.image)
            rates[name].append(result.stats["spp_done"] * pixels / used / 1e6)
    rows = []
    for name in args.integrators:
        errors = [relative_errors(image, case.reference) for image in images[name]]
        raw = median(float(e.mean()) for e in errors)
        rows.append(
            {
                "scene": case.name,
                "integrator": name,
                "Msamples/CPU s": median(rates[name]),
                "relMSE": raw - case.error,
                "trimmed": median(trimmed_mean(e) for e in errors) - case.trimmed_error,
                "reference's own": case.error,
                "mean / reference": float(np.mean(images[name]) / case.reference.mean()),
            }
        )
    others = [row["relMSE"] for row in rows if row["integrator"] != "mlt"]
    for row in rows:
        if others and row["integrator"] == "mlt":
            row["over the best other"] = row["relMSE"] / min(others)
    return rows


def main() -> None:
    options = parser(__doc__)
    options.add_argument("--seconds", type=float, default=20, help="for each image and thread")
    options.add_argument("--threads", type=int, default=2)
    options.add_argument("--repeats", type=int, default=3, help="with other seeds; medians count")
    options.add_argument("--reference-seconds", type=float, default=1200)
    options.add_argument("--scenes", nargs="+", choices=list(CASES), default=list(CASES))
    options.add_argument("--integrators", nargs="+", choices=ALGORITHMS, default=list(ALGORITHMS))
    options.add_argument("--cache", type=Path, default=REPOSITORY / "build" / "references")
    args = options.parse_args()

    rows = []
    for name in args.scenes:
        try:
            case = CASES[name](args)
        except MissingError as reason:
            say(f"{name}: skipped, {reason}")
            continue
        rows += measure(case, args)
    if not rows:
        raise SystemExit("no scene to measure")
    print_table(rows)
    settings = {
        key: getattr(args, key) for key in ("seconds", "threads", "repeats", "reference_seconds")
    }
    write_results(args.json, "mlt_equal_time", settings, rows)


if __name__ == "__main__":
    main()
