"""What Open Image Denoise does to the noise of each integrator, at equal CPU time.

Each integrator renders a scene with several seeds. Against a reference, the relMSE of the images
and of the denoised images are compared, both trimmed of the worst thousandth of the pixels, and
HDR-FLIP. A filter wider than a pixel makes the noise of neighbours alike, so both kinds of filter
are measured. The columns are means over the seeds:

correlation   of the relative errors of neighbouring pixels, clipped at +-1: 0 for independent noise
noisy         relMSE as it was rendered
denoised      relMSE after the filter
gain          noisy / denoised
common        the share of the denoised relMSE that all seeds have in common: what the filter has
              invented, and more time at this noise would not remove
flip, flip_denoised   what somebody would notice
"""

from __future__ import annotations

from itertools import product
from pathlib import Path

import numpy as np
from common import (
    REPOSITORY,
    Reference,
    parser,
    print_table,
    say,
    write_results,
)

import pymlt as mlt
from pymlt.diagnostics.metrics import relative_square, trimmed_mean
from pymlt.race.cpu_time import render_for

DEPTH = 8
INTEGRATORS = [mlt.Path, mlt.BDPT, mlt.PSSMLT, mlt.MLT]
FILTERS = ("box", "gaussian")
SCENES = {"cornell_box": mlt.BDPT, "door_ajar": mlt.MLT}  # with what renders the reference


def correlation(image: np.ndarray, reference: np.ndarray) -> float:
    """Of the errors of horizontal and of vertical neighbours."""
    errors = ((image - reference).mean(axis=2) / (reference.mean(axis=2) + 0.01)).clip(-1, 1)
    errors -= errors.mean()
    pairs = (errors[:, 1:] * errors[:, :-1]).mean() + (errors[1:] * errors[:-1]).mean()
    return float(pairs / 2 / (errors**2).mean())


def common_share(images: list[np.ndarray], reference: np.ndarray) -> float:
    """E[(a - r)(b - r)] over pairs of seeds, by the relMSE of one, without the worst pixels."""
    errors = [(image - reference) / np.sqrt(reference**2 + 0.01) for image in images]
    n = len(errors)
    total = sum(errors) ** 2 - sum(e**2 for e in errors)
    one = trimmed_mean(sum((e**2).mean(axis=2) for e in errors) / n)
    return max(0.0, trimmed_mean(total.mean(axis=2) / (n * (n - 1))) / one)


def scene_with_filter(name: str, filter: str, width: int):
    """A built-in scene, square if it is the Cornell box."""
    scene = getattr(mlt.scenes, name)()
    for plugin in scene.values():
        if "film" in plugin:
            plugin["film"]["rfilter"] = {"type": filter}
    height = width if name == "cornell_box" else width * 9 // 16
    return mlt.load_dict(scene, size=(width, height))


def measure(scene, integrator, reference: np.ndarray, args) -> tuple[dict, list]:
    noisy = [
        render_for(scene, integrator, args.seconds, seed=seed, threads=args.threads).result.image
        for seed in range(1, args.seeds + 1)
    ]
    clean = [mlt.denoise(image) for image in noisy]

    def mean(metric, images):
        return float(np.mean([metric(image, reference) for image in images]))

    def relmse(image, reference):
        return trimmed_mean(relative_square(image, reference))

    def flip(image, reference):
        return mlt.compare(image, reference)["flip"]

    before, after = mean(relmse, noisy), mean(relmse, clean)
    row = {
        "integrator": integrator.to_dict()["type"],
        "correlation": mean(correlation, noisy),
        "noisy": before,
        "denoised": after,
        "gain": before / after,
        "common": common_share(clean, reference),
        "flip": mean(flip, noisy),
        "flip_denoised": mean(flip, clean),
    }
    return row, [noisy[0], clean[0]]


def main() -> None:
    options = parser(__doc__)
    options.add_argument("--width", type=int, default=160, help="of the images")
    options.add_argument("--seconds", type=float, default=3, help="of CPU time for each image")
    options.add_argument("--seeds", type=int, default=4)
    options.add_argument("--threads", type=int, default=2)
    options.add_argument("--reference-seconds", type=float, default=120)
    options.add_argument("--picture", type=Path, help="images above, denoised ones below")
    args = options.parse_args()
    rows, columns = [], []
    for name, filter in product(SCENES, FILTERS):
        best = SCENES[name]
        scene = scene_with_filter(name, filter, args.width)
        reference = Reference(
            f"denoising-{name}-{filter}-{args.width}",
            scene,
            best(max_depth=DEPTH),
            args.reference_seconds,
            threads=args.threads,
            folder=REPOSITORY / "build" / "references",
        )
        say(f"{name}, {filter}: relMSE of the reference {trimmed_mean(reference.errors()):.3g}")
        for integrator in INTEGRATORS:
            say(f"{name}, {integrator.__name__} ...")
            row, pair = measure(scene, integrator(max_depth=DEPTH), reference.image, args)
            rows.append({"scene": name, "filter": filter} | row)
            if (name, filter) == ("door_ajar", "box"):
                columns.append(np.concatenate(pair))
    print_table(rows)
    if args.picture:
        mlt.write_image(args.picture, np.concatenate(columns, axis=1), tonemap="filmic")
    settings = {
        "width": args.width,
        "cpu_seconds": args.seconds,
        "seeds": args.seeds,
        "max_depth": DEPTH,
        "reference_cpu_seconds": args.reference_seconds,
    }
    write_results(args.json, "denoising", settings, rows)


if __name__ == "__main__":
    main()
