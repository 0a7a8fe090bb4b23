"""The mutations of MLT as objects, and their audit."""

import json
import pickle

import numpy as np
import pytest
import tiny

import pymlt as mlt
from pymlt import _core
from pymlt.algorithms import mutations

CLASSES = [getattr(mlt, name) for name in sorted(mutations.__all__)]
ALL = [made() for made in CLASSES]


def settings_of(integrator) -> dict:
    return json.loads(_core.integrator_from_dict(integrator.to_dict()).settings)


def test_there_is_a_class_for_each_mutation():
    names = {c.__name__ for c in CLASSES}
    veach = {"Bidirectional", "Lens", "Caustic", "MultiChain", "LensSubpath"}
    others = {
        "Multiplexed": "Otsu et al. 2017",
        "Manifold": "Jakob & Marschner 2012, sec. 5",
        "Propagation": "Pauly et al. 2000, sec. 4.2",
        "Translucent": "Gruson et al. 2018",
        "Wavelength": "dispersive chains",
    }
    assert names == veach | others.keys()
    for made in CLASSES:
        source = others.get(made.__name__, "sec. 11.3")
        assert source in " ".join(made.__doc__.split())


@pytest.mark.parametrize("mutation", ALL, ids=repr)
def test_a_mutation_is_a_value(mutation):
    copy = pickle.loads(pickle.dumps(mutation))
    assert copy == mutation
    assert {copy: 1}[mutation] == 1
    assert repr(mutation) == f"{type(mutation).__name__}()"
    assert sum(mutation == other for other in ALL) == 1


def test_a_mixture_is_a_value():
    algo = mlt.MLT(max_depth=5, mutations=[(mlt.Bidirectional(), 0.4), (mlt.Lens(), 0.6)])
    assert pickle.loads(pickle.dumps(algo)) == algo
    assert repr(algo) == "MLT(max_depth=5, mutations=[(Bidirectional(), 0.4), (Lens(), 0.6)])"
    assert algo != mlt.MLT(max_depth=5)


def test_a_mixture_means_the_parameters():
    mixture = [(mlt.Bidirectional(), 0.4), (mlt.Caustic(), 2)]
    settings = settings_of(mlt.MLT(mutations=mixture))
    assert settings["bidirectional_mutation"]
    assert settings["bidirectional_weight"] == 0.4
    assert settings["caustic_perturbation"]
    assert settings["caustic_weight"] == 2
    assert not settings["lens_perturbation"]
    assert not settings["multi_chain_perturbation"]
    assert not settings["lens_subpath_mutation"]
    assert not settings["adaptive"]
    assert settings_of(mlt.MLT(mutations=mixture, adaptive=True))["adaptive"]
    assert settings_of(mlt.MLT())["adaptive"]


def test_mutations_without_weights_have_their_defaults():
    settings = settings_of(mlt.MLT(mutations=[mlt.Bidirectional(), mlt.Lens()]))
    assert settings["lens_weight"] == settings_of(mlt.MLT())["lens_weight"]


def test_a_render_by_a_mixture_uses_these_mutations_alone():
    mixture = [(mlt.Bidirectional(), 0.5), (mlt.Lens(), 0.5)]
    algo = mlt.MLT(
        max_depth=4, chains=16, luminance_samples=1000, independent_share=0.1, mutations=mixture
    )
    stats = mlt.start(tiny.scene(), algo, spp=8).result().stats
    used = {row["name"] for row in stats["mutations"] if row["proposed"] > 0}
    assert used == {"bidirectional", "lens"}


@pytest.mark.parametrize(
    ("mixture", "message"),
    [
        ([mlt.Lens], r"write Lens\(\)"),
        (["lens"], "is not a mutation"),
        ([mlt.Lens(), (mlt.Lens(), 2)], "twice"),
        ([(mlt.Lens(), -1)], "lens_weight"),
        ([], "at least one"),
    ],
)
def test_a_mixture_that_makes_no_sense_is_refused(mixture, message):
    with pytest.raises(mlt.Error, match=message):
        mlt.start(tiny.scene(), mlt.MLT(mutations=mixture), spp=1)


def test_a_mixture_and_its_parameters_contradict_each_other():
    algo = mlt.MLT(mutations=[mlt.Lens()], lens_weight=0.3)
    with pytest.raises(mlt.UsageError, match="lens_weight is given beside mutations"):
        mlt.start(tiny.scene(), algo, spp=1)


# ---- audit --------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def scene():
    return mlt.load_string(tiny.XML)


@pytest.mark.parametrize("what", [mlt.Bidirectional(), mlt.Lens(), mlt.MLT(max_depth=5)], ids=repr)
def test_mutations_pass_their_audit(scene, what):
    audit = mlt.audit(what, scene, paths=10_000, seed=1, max_depth=5)
    assert audit, audit.summary()
    assert audit.verdict == "nothing found"
    assert audit.accepted > 200
    p = [test.p for test in audit.tests]
    assert p == sorted(p)
    assert all(test.z == pytest.approx(test.change / test.error) for test in audit.tests[:5])
    assert audit.tests[0].function in audit.summary()
    assert repr(audit).startswith("Audit('nothing found'; a ")


def test_an_audit_says_what_it_would_have_found(scene):
    few, many = (mlt.audit(mlt.Lens(), scene, paths=n, max_depth=5) for n in (5_000, 40_000))
    assert few.limits[0].edges == 0
    assert 0 < many.limits[0].pixels < 0.5 * few.limits[0].pixels
    assert len(many.limits) > 2
    assert f"{many.limits[0].pixels:.2g} pixel would have been" in many.summary()
    assert "right" not in many.summary()


def test_an_audit_is_a_function_of_its_seed(scene):
    tests = [
        mlt.audit(mlt.Lens(), scene, paths=2000, seed=s, threads=n).tests
        for s, n in ((1, 1), (1, 2), (2, 1))
    ]
    z = [sorted((t.function, t.expected, t.z) for t in found) for found in tests]
    assert z[0] == z[1]
    assert z[0] != z[2]


def test_too_few_paths_prove_nothing(scene):
    audit = mlt.audit(mlt.Lens(), scene, paths=50)
    assert audit.verdict == "inconclusive"
    assert not audit


@pytest.mark.parametrize("wrong", [mlt.Lens, "lens", mlt.Path(), None])
def test_what_cannot_be_audited_is_refused(scene, wrong):
    with pytest.raises(mlt.UsageError, match="neither a mutation nor an MLT"):
        mlt.audit(wrong, scene)


def test_the_lens_perturbation_scales_its_steps(scene):
    paths = (scene.sample_path(seed=s, max_depth=4) for s in range(100))
    x = next(path for path in paths if path.signature == "LDE")
    proposals = scene.propose(x, mlt.Lens(), count=500)
    distances = np.linalg.norm([np.subtract(y.raster, x.raster) for y in proposals], axis=1)
    assert distances.min() >= 0.1
    assert distances.max() <= 0.1 * np.hypot(16, 12)


def step_sizes(scene, algorithm):
    stats = mlt.start(scene, algorithm, spp=4, seed=1).result().stats
    return {m["step_size"] for m in stats["mutations"] if m["name"] == "lens"}


def test_a_mutation_has_parameters_of_its_own():
    scene = mlt.load_string(tiny.XML)
    small = {"chains": 16, "luminance_samples": 1000, "independent_share": 0.1}
    lens = mlt.Lens(largest_share=0.05)
    assert repr(lens) == "Lens(largest_share=0.05)"
    assert lens != mlt.Lens()
    assert lens == mlt.Lens(largest_share=0.05)
    mixture = mlt.MLT(mutations=[(mlt.Bidirectional(), 0.5), (lens, 0.5)], **small)
    assert mixture.to_dict()["lens_largest_share"] == 0.05
    assert step_sizes(scene, mixture) == {0.05}
    # Adaptation chooses among several sizes, but not where one is given.
    assert len(step_sizes(scene, mlt.MLT(**small))) > 1
    assert step_sizes(scene, mlt.MLT(lens_largest_share=0.3, **small)) == {0.3}
    with pytest.raises(TypeError, match="has no parameter 'size'"):
        mlt.Lens(size=1)
    with pytest.raises(mlt.SceneError, match=r"'largest_share' is 2\.0"):
        mlt.audit(mlt.Lens(largest_share=2), scene, paths=500)
    with pytest.raises(mlt.UsageError, match="twice in mutations"):
        mlt.render(scene, mlt.MLT(mutations=[mlt.Lens(), lens]), spp=1)
