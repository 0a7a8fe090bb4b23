"""Our images and those of Mitsuba 3: materials, shapes, lights, cameras, filters, and rooms.

The references lie beside the tests; references/make_references.py made them. The quick tests look
at blocks of 4 x 4 pixels and more, the long ones at each pixel.
"""

import itertools
import re

import pytest
from mitsuba_cases import BIDIR, BOXES, CASES, SHARED, SIZE, STAGES, Case, read_reference
from same_image import FULL, QUICK, assert_same_image

import pymlt as mlt


def renderer(scene, integrator):
    return lambda spp, seed: mlt.render(scene, integrator, spp=spp, seed=seed, threads=1)


def load(case: Case):
    size = None if "crop_" in case.text() else SIZE
    return mlt.load_file(case.path, size=size, **case.defines)


def max_depth(case: Case) -> int:
    text = case.text()
    value = re.search(r'name="max_?[dD]epth" value="([^"]*)"', text)[1]
    if not value.startswith("$"):
        return int(value)
    defaults = dict(re.findall(r'<default name="(\w+)" value="([^"]*)"', text))
    return int((defaults | case.defines)[value[1:]])


def check(case: Case, make=mlt.Path, *, spp, runs, scales, **parameters):
    integrator = make(max_depth=max_depth(case), **parameters)
    return assert_same_image(
        renderer(load(case), integrator),
        read_reference(case),
        spp=spp,
        runs=runs,
        scales=scales,
        systematic=case.systematic,
    )


def cases(*lists):
    """As parameters; those that need the external scenes are marked."""
    return [
        pytest.param(case, id=case.name, marks=[pytest.mark.shared] if case.shared else [])
        for case in itertools.chain(*lists)
    ]


# ---- path --------------------------------------------------------------------------------------


@pytest.mark.parametrize("case", cases(STAGES))
def test_path(case):
    check(case, spp=case.spp, runs=48, scales=QUICK)


@pytest.mark.long
@pytest.mark.parametrize("case", cases(STAGES))
def test_path_pixel_by_pixel(case):
    check(case, spp=4 * case.spp, runs=96, scales=FULL)


@pytest.mark.long
@pytest.mark.parametrize("case", cases(BOXES, SHARED))
def test_path_on_larger_scenes(case):
    check(case, spp=case.spp, runs=96, scales=FULL)


@pytest.mark.parametrize("missing", ["the longest paths", "the filter"])
def test_what_is_missing_is_noticed(missing):
    """The comparison can fail: each of these leaves out a little."""
    reference = read_reference(CASES["filter-gaussian"])
    scene = load(CASES["material-diffuse" if missing == "the filter" else "filter-gaussian"])
    path = mlt.Path(max_depth=3 if missing == "the longest paths" else 4)
    with pytest.raises(AssertionError, match="blocks differ"):
        assert_same_image(renderer(scene, path), reference, spp=32, runs=16, scales=FULL)


# ---- the other integrators ---------------------------------------------------------------------

SOME = ["material-diffuse", "material-roughconductor-ggx", "material-dielectric", "light-envmap"]
SOME += ["light-point", "camera-thinlens", "bitmap-on-ply", "filter-gaussian"]


@pytest.mark.parametrize("name", ["material-diffuse", "material-dielectric"])
def test_bdpt(name):
    check(CASES[name], mlt.BDPT, spp=32, runs=48, scales=QUICK)


@pytest.mark.long
@pytest.mark.parametrize("case", cases([CASES[name] for name in SOME]))
def test_bdpt_pixel_by_pixel(case):
    check(case, mlt.BDPT, spp=4 * case.spp, runs=96, scales=FULL)


@pytest.mark.long
@pytest.mark.parametrize("case", cases(BOXES, SHARED))
def test_bdpt_on_larger_scenes(case):
    check(case, mlt.BDPT, spp=case.spp, runs=96, scales=FULL)


@pytest.mark.long
@pytest.mark.parametrize("case", cases([BIDIR]))
def test_bdpt_where_paths_are_rare(case):
    """Not pixel by pixel: some light comes so rarely to a path tracer that the 260,000 samples
    which the reference has of a pixel miss some of it, and its standard error is too small."""
    check(case, mlt.BDPT, spp=2 * case.spp, runs=96, scales=QUICK)


@pytest.mark.long
@pytest.mark.parametrize("case", cases([CASES[name] for name in SOME], BOXES, SHARED[:1]))
def test_pssmlt(case):
    few = {"luminance_samples": 100_000, "chains": 64}
    check(case, mlt.PSSMLT, spp=8 * case.spp, runs=48, scales=QUICK, **few)
