"""Targets of light paths that are not L*: one class, a weight, a power."""

import re

import numpy as np
import pytest
import tiny

import pymlt as mlt
from pymlt.lab import metropolis

MOVES = [(mlt.Bidirectional(), 1.0), (mlt.Lens(), 1.0), (mlt.Caustic(), 1.0)]
DEPTH = 5


@pytest.fixture(scope="module")
def scene():
    return mlt.load_string(tiny.XML)


@pytest.fixture(scope="module")
def target(scene):
    return scene.path_target(max_depth=DEPTH)


def chains(target, seed):
    start = target.bootstrap(60_000, chains=2000, seed=seed)
    return metropolis.run(target, MOVES, start, n=20, seed=seed, expected_values=True)


@pytest.fixture(scope="module")
def plain(target):
    return chains(target, 1)


def half(scene) -> np.ndarray:
    image = np.full((scene.height, scene.width), 0.5)
    image[:, : scene.width // 2] = 3
    return image


def of_half(scene):
    return lambda x: half(scene)[int(x.raster[1]), int(x.raster[0])]


def shorter(x) -> float:
    return 1 / x.edges**2


#: What path_target is given, and T' / L* as a function of the path.
TARGETS = {
    "class": (lambda _: {"paths": "LD+E"}, lambda s, t: lambda x: "S" not in x.signature),
    "weight": (lambda _: {"weight": shorter}, lambda s, t: shorter),
    "image": (lambda s: {"weight": half(s)}, lambda s, t: of_half(s)),
    "power": (lambda _: {"power": 0.5}, lambda s, t: lambda x: t(x) ** -0.5),
    "all": (
        lambda s: {"paths": "L[DS]+E", "weight": half(s), "power": 0.7},
        lambda s, t: lambda x: (x.edges > 1) * of_half(s)(x) * t(x) ** -0.3,
    ),
}


@pytest.mark.parametrize("name", TARGETS)
def test_a_mean_is_that_under_l_star_of_the_quotient(name, scene, target, plain):
    given, quotient_of = TARGETS[name]
    quotient = quotient_of(scene, target)
    other = scene.path_target(max_depth=DEPTH, **given(scene))
    run = chains(other, 2)
    functions = {
        "integral": lambda x: 1.0,
        "edges": lambda x: x.edges,
        "height": lambda x: x.raster[1],
        "specular": lambda x: x.signature.count("S"),
    }
    for label, g in functions.items():
        found = run.estimate(g)
        expected = plain.estimate(lambda x, g=g: g(x) * quotient(x))
        error = np.hypot(found.standard_error, expected.standard_error)
        assert abs(found.estimate - expected.estimate) < 4.5 * error + 1e-12, label
        assert expected.estimate == 0 or error < 0.2 * abs(expected.estimate), label


def test_l_star_comes_back_from_a_power(scene, target, plain):
    run = chains(scene.path_target(max_depth=DEPTH, power=0.5), 3)
    found = run.estimate(lambda x: target(x) ** 0.5)
    assert abs(found.estimate - plain.b) < 4.5 * np.hypot(found.standard_error, plain.b_error)


def test_all_paths_are_of_the_class(scene):
    caustics = scene.path_target(max_depth=DEPTH, paths="LS+DE")
    run = metropolis.run(caustics, MOVES, n=300, seed=1)
    assert {bool(re.fullmatch("LS+DE", x.signature)) for x in run.states} == {True}
    assert caustics(run.states[0]) > 0
    assert scene.path_target(paths="LDE")(run.states[0]) == 0


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"paths": "L("}, "no regular expression for signatures"),
        ({"power": 0}, "power is 0, but should be above 0"),
        ({"weight": np.ones((3, 3))}, r"an array of the shape \(12, 16\)"),
        ({"weight": "bright"}, "weight should be a function"),
        ({"weight": np.full((12, 16), -1.0)}, "should not be negative"),
    ],
)
def test_factors_that_make_no_sense_are_refused(given, message, scene):
    with pytest.raises(mlt.UsageError, match=message):
        scene.path_target(**given)


def test_a_weight_that_is_no_number_is_an_error_that_names_the_path(scene):
    target = scene.path_target(weight=lambda x: -1)
    with pytest.raises(mlt.UsageError, match=r"weight\(x\) is -1 for x = LightPath"):
        metropolis.run(target, MOVES, n=10)


def test_an_error_of_the_weight_is_passed_on(scene):
    def broken(x):
        raise ZeroDivisionError("here")

    with pytest.raises(ZeroDivisionError, match="here"):
        metropolis.run(scene.path_target(weight=broken), MOVES, n=10)


def test_no_path_of_a_class_is_an_error(scene):
    with pytest.raises(mlt.RenderError, match="no light path was found"):
        metropolis.run(scene.path_target(paths="LX"), MOVES, n=10)
