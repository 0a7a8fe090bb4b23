"""Makes the pictures of the README and the docs: python docs/images/make.py [NAME ...]

motion        the scene of the page on motion blur
equal-time    the same scene by path, bdpt and mlt, with equal CPU time
samples-and-chains  what independent samples and chains show of an image
clamped       glasses by path tracing, by chains alone, and by chains beside clamped samples
strategies    the techniques of bidirectional path tracing
manifolds     light through water without and with manifold sampling
tone-curves   one render by each tone curve
light-layers  one render, its direct light, its caustics and all other light
comparison    what pymlt compare --picture draws
race          what pymlt race -o race.png draws
"""

import sys
from pathlib import Path

import numpy as np

import pymlt as mlt
from pymlt.pictures.techniques import technique_figure
from pymlt.pictures.tonemapping import CURVES
from pymlt.race.cpu_time import render_for

HERE = Path(__file__).parent


def render(name, integrator, cpu_seconds, size, seed=1):
    """Renders for so many seconds of CPU time, over all threads and with all preparations."""
    scene = mlt.load_dict(getattr(mlt.scenes, name)(), size=size)
    result = render_for(scene, integrator, cpu_seconds, seed=seed, threads=0).result
    print(f"{name}, {result.integrator['type']}: {result.stats['spp_done']:.1f} spp", flush=True)
    return result.image


def motion():
    image = mlt.render(mlt.load_dict(mlt.scenes.motion()), mlt.BDPT(max_depth=8), spp=100, seed=1)
    mlt.write_image(HERE / "motion.png", image)


def equal_time():
    integrators = [mlt.Path(max_depth=10), mlt.BDPT(max_depth=10), mlt.MLT(max_depth=10)]
    images = [render("door_ajar", i, 30, (240, 135)) for i in integrators]
    mlt.write_image(HERE / "equal-time.png", np.concatenate(images, axis=1))


def samples_and_chains():
    scene = mlt.load_dict(mlt.scenes.ring(), size=(240, 180))
    result = mlt.start(scene, mlt.MLT(max_depth=8, parts=True), spp=600).result()
    parts = [result.layers["samples"], result.layers["chains"], result.image]
    mlt.write_image(HERE / "samples-and-chains.png", np.concatenate(parts, axis=1))


def clamped():
    chains = mlt.MLT(max_depth=8, independent_share=0)
    integrators = [mlt.Path(max_depth=8), chains, mlt.MLT(max_depth=8)]
    images = [render("goblets", i, 40, (320, 180)) for i in integrators]
    mlt.write_image(HERE / "clamped.jpg", np.concatenate(images, axis=1))


def strategies():
    scene = mlt.load_dict(mlt.scenes.glass_ball(), size=(96, 96))
    result = mlt.start(scene, mlt.BDPT(max_depth=5, techniques=True), spp=192).result()
    technique_figure(result.techniques, exposure=1).savefig(HERE / "strategies.png", dpi=100)


def manifolds():
    integrators = [mlt.MLT(max_depth=8, manifolds=used) for used in (False, True)]
    images = [render("pool", i, 30, (400, 225)) for i in integrators]
    mlt.write_image(HERE / "manifolds.jpg", np.concatenate(images, axis=1))


def tone_curves():
    image = render("glass_ball", mlt.BDPT(max_depth=8), 20, (200, 200))
    shown = [mlt.tonemap(image, curve, exposure=3) for curve in CURVES]
    mlt.write_image(HERE / "tone-curves.png", np.concatenate(shown, axis=1))


def light_layers():
    scene = mlt.load_dict(mlt.scenes.glass_ball(), size=(200, 200))
    classes = {"direct": "LDE", "caustics": "LS+DE"}
    result = mlt.start(scene, mlt.MLT(), spp=400, light_layers=classes).result()
    layers = [result.layers[name] for name in classes]
    images = [result.image, *layers, result.image - sum(layers)]
    mlt.write_image(HERE / "light-layers.jpg", np.concatenate(images, axis=1), exposure=1)


def comparison():
    image = render("glass_ball", mlt.Path(max_depth=8), 3, (200, 200))
    reference = render("glass_ball", mlt.BDPT(max_depth=8), 30, (200, 200), seed=2)
    mlt.comparison_figure(image, reference).savefig(HERE / "comparison.png", dpi=60)


def race():
    scene = mlt.load_dict(mlt.scenes.glass_ball(), size=(160, 160))
    algorithms = [f"{name}:max_depth=8" for name in ("path", "bdpt", "mlt")]
    result = mlt.equal_time(
        [(text.partition(":")[0], text) for text in algorithms],
        scene,
        render("glass_ball", mlt.MLT(max_depth=8), 60, (160, 160), seed=9),
        seconds=4,
        name="glass-ball",
    )
    result.figure().savefig(HERE / "race.png", dpi=80)


if __name__ == "__main__":
    pictures = {
        "motion": motion,
        "equal-time": equal_time,
        "samples-and-chains": samples_and_chains,
        "clamped": clamped,
        "strategies": strategies,
        "manifolds": manifolds,
        "tone-curves": tone_curves,
        "light-layers": light_layers,
        "comparison": comparison,
        "race": race,
    }
    for name in sys.argv[1:] or pictures:
        pictures[name]()
