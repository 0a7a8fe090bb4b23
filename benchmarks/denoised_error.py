"""How wrong denoised renders are, and how wrong they say they are.

    python benchmarks/denoised_error.py SCENE ... --json results.json

Each scene, by its name or as a file, is rendered with several seeds, for several budgets of CPU
time, with `denoise=True`. With the halves R1 and R2 of a reference and an image I, the mean of
(I - R1) (I - R2) is its error without that of the reference. Errors are those of `stats["error"]`:
the root of the mean over pixels of the squared error of L over L^2 + 0.01 M^2. The columns are
roots of means over the seeds:

noisy      the image as it was rendered
plain      without fireflies, and denoised as a whole
denoised   the mixture of denoised halves and of the image
gain       denoised over the better of the other two
claimed    stats["denoised_error"] over denoised
...99.9    each without the thousandth of the pixels that are worst
"""

from __future__ import annotations

from pathlib import Path
from time import process_time as cpu_seconds
from time import sleep

import numpy as np
from common import REPOSITORY, Reference, parser, print_table, say, write_results

import pymlt as mlt
from pymlt.pictures.luminance import target_luminance

ENDLESS = 1e6  # samples per pixel
INTEGRATORS = {"path": mlt.Path(), "bdpt": mlt.BDPT(), "mlt": mlt.MLT()}


def loaded(name: str, pixels: int):
    """A scene in about so many pixels, with the filter that denoising needs."""
    width, height = mlt.load(name).info()["size"]
    scale = np.sqrt(pixels / (width * height))
    return mlt.load(name, filter="box", size=(round(scale * width), round(scale * height)))


def render_for(scene, integrator, seconds: float, seed: int) -> mlt.Result:
    job = mlt.start(
        scene, integrator, spp=ENDLESS, seed=seed, threads=1, fireflies="groups", denoise=True
    )
    end = cpu_seconds() + seconds
    while cpu_seconds() < end and not job.ended:
        sleep(0.01)
    job.cancel()
    return job.result()


def terms(image: np.ndarray, reference: Reference) -> np.ndarray:
    """Of each pixel, the square of its relative error; of single pixels it may be negative."""
    first, second = (target_luminance(half) for half in reference.halves)
    brightness = (first + second) / 2
    found = target_luminance(image.astype(float))
    scale = brightness**2 + 0.01 * brightness.mean() ** 2
    return ((found - first) * (found - second) / scale).ravel()


def with_most(terms: np.ndarray) -> list[float]:
    """Their mean, and that without the worst thousandth."""
    kept = np.argsort(abs(terms))[: -max(1, terms.size // 1000)]
    return [float(terms.mean()), float(terms[kept].mean())]


def squares(result: mlt.Result, reference: Reference) -> list[list[float]]:
    guides = {"albedo": result.layers["albedo"], "normal": result.layers["sh_normal"]}
    plain = mlt.denoise(result.layers["noisy"], **guides)
    found = [
        with_most(terms(image, reference))
        for image in (result.layers["unfiltered"], plain, result.image)
    ]
    claimed = result.stats.get("denoised_error", np.nan)
    return [*found, [claimed**2, claimed**2]]


def measured(scene, name: str, reference: Reference, seconds: float, args) -> dict:
    seeds = range(1, args.seeds + 1)
    integrator = INTEGRATORS[args.integrator]
    found = [squares(render_for(scene, integrator, seconds, s), reference) for s in seeds]
    row = {"scene": name, "seconds": seconds}
    for i, suffix in enumerate(("", " 99.9")):
        noisy, plain, denoised, claimed = np.sqrt(np.mean(found, axis=0)[:, i].clip(0))
        row |= {
            f"noisy{suffix}": noisy,
            f"plain{suffix}": plain,
            f"denoised{suffix}": denoised,
            f"gain{suffix}": denoised / min(noisy, plain),
            f"claimed{suffix}": claimed / denoised,
        }
    return row


def main() -> None:
    options = parser(__doc__)
    options.add_argument("scenes", nargs="+", help="names of built-in scenes, or files")
    options.add_argument("--integrator", choices=INTEGRATORS, default="mlt")
    options.add_argument("--pixels", type=int, default=96 * 72, help="of each image")
    options.add_argument("--seconds", type=float, nargs="+", default=[2, 10, 60])
    options.add_argument("--seeds", type=int, default=4)
    options.add_argument("--reference-seconds", type=float, default=120)
    args = options.parse_args()
    rows = []
    for place in args.scenes:
        path = Path(place)
        name = path.parent.name if path.suffix else place
        scene = loaded(place, args.pixels)
        reference = Reference(
            f"denoised-{name}-{args.pixels}{'-file' if path.suffix else ''}",
            scene,
            INTEGRATORS["mlt"],
            args.reference_seconds,
            threads=1,
            folder=REPOSITORY / "build" / "references",
        )
        for seconds in args.seconds:
            say(f"{name}, {seconds:g} s ...")
            rows.append(measured(scene, name, reference, seconds, args))
            settings = {k: v for k, v in vars(args).items() if k not in ("scenes", "json")}
            write_results(args.json, "denoised_error", settings, rows)
    print_table(rows)


if __name__ == "__main__":
    main()
