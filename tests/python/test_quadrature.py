"""Monte Carlo quadrature against closed forms, at fixed seeds and levels of significance."""

import numpy as np
import pytest
from scipy import stats

import pymlt as mlt
from pymlt.lab import quadrature

ALPHA = 1e-4


def quarter_circle(x):
    return 4 * np.sqrt(1 - x**2)


def sample_line(rng, n):
    return (3 - np.sqrt(9 - 8 * rng.random(n))) / 2


def line_pdf(x):
    return 1.5 - x


UNIFORM = quadrature.Technique.uniform((0, 1))
LINE = quadrature.Technique(sample_line, line_pdf)

METHODS = {
    "naive": lambda f, s: quadrature.naive(f, (0, 1), 200, seed=s),
    "stratified": lambda f, s: quadrature.stratified(f, (0, 1), 200, seed=s),
    "jittered": lambda f, s: quadrature.stratified(f, (0, 1), 200, per_stratum=1, seed=s),
    "unequal strata": lambda f, s: quadrature.stratified(
        f, (0, 1), strata=[0, 0.5, 0.6, 0.9, 1], per_stratum=50, seed=s
    ),
    "importance": lambda f, s: quadrature.importance(f, sample_line, line_pdf, 200, seed=s),
    **{
        f"combined, {name}": lambda f, s, name=name: quadrature.combined(
            f, [UNIFORM, LINE], [50, 150], heuristic=name, seed=s
        )
        for name in quadrature.HEURISTICS
    },
}


@pytest.fixture(params=METHODS)
def method(request):
    return METHODS[request.param]


def test_every_method_is_unbiased(method):
    estimates = [method(quarter_circle, seed).estimate for seed in range(400)]
    assert stats.ttest_1samp(estimates, np.pi).pvalue > ALPHA


def test_the_test_of_bias_would_see_a_wrong_density():
    estimates = [
        quadrature.importance(
            quarter_circle, sample_line, lambda x: 1.5 - 0.97 * x, 200, seed=seed
        ).estimate
        for seed in range(400)
    ]
    assert stats.ttest_1samp(estimates, np.pi).pvalue < ALPHA


def test_the_standard_error_is_that_of_repetitions(method):
    results = [method(quarter_circle, seed) for seed in range(400)]
    expected = np.mean([r.standard_error**2 for r in results])
    spread = np.sum((np.array([r.estimate for r in results]) - np.pi) ** 2) / expected
    low, high = stats.chi2.ppf([ALPHA / 2, 1 - ALPHA / 2], 400)
    if method is METHODS["jittered"]:  # errs on the safe side
        low = 0
    # The error itself is an estimate, from 200 samples each in 400 runs: that adds 10 % at most.
    assert 0.9 * low < spread < 1.1 * high


def test_samples_and_contributions_come_back(method):
    result = method(quarter_circle, 0)
    assert result.samples.shape == result.contributions.shape == (200,)
    assert ((result.samples >= 0) & (result.samples <= 1)).all()
    assert str(result).startswith(f"{result.estimate:.6g} ± ")


def test_strata_are_better_where_f_is_smooth():
    naive, jittered = (
        np.std([METHODS[name](quarter_circle, s).estimate for s in range(100)])
        for name in ("naive", "jittered")
    )
    assert jittered < naive / 20


def test_each_stratum_has_its_samples():
    result = quadrature.stratified(lambda x: x, (0, 1), strata=[0, 0.1, 1], per_stratum=3)
    assert (result.samples[:3] < 0.1).all()
    assert (result.samples[3:] > 0.1).all()


@pytest.mark.parametrize("name", ["naive", "stratified", "importance", "combined"])
def test_two_dimensions(name):
    """The integral of x y^2 over [0, 2] x [0, 3] is 18."""
    box = [(0, 2), (0, 3)]

    def f(x):
        return x[:, 0] * x[:, 1] ** 2

    other = quadrature.Technique(
        lambda rng, n: np.sqrt(rng.random((n, 2))) * (2, 3),
        lambda x: x[:, 0] * x[:, 1] / 9,
    )
    run = {
        "naive": lambda s: quadrature.naive(f, box, 400, seed=s),
        "stratified": lambda s: quadrature.stratified(f, box, strata=(20, 10), seed=s),
        "importance": lambda s: quadrature.importance(f, other.sample, other.pdf, 400, seed=s),
        "combined": lambda s: quadrature.combined(
            f, [quadrature.Technique.uniform(box), other], 200, seed=s
        ),
    }[name]
    assert run(0).samples.shape == (400, 2)
    assert stats.ttest_1samp([run(s).estimate for s in range(200)], 18).pvalue > ALPHA


def test_the_seed_decides():
    a, b, c = (quadrature.naive(quarter_circle, (0, 1), 100, seed=s).estimate for s in (1, 1, 2))
    assert a == b != c


@pytest.mark.parametrize("name", quadrature.HEURISTICS)
def test_heuristics_are_weights(name):
    q = np.random.default_rng(1).exponential(size=(3, 1000)) ** 3
    q[0, :100] = 0
    weights = quadrature.HEURISTICS[name](q)
    assert np.allclose(weights.sum(axis=0), 1, rtol=0, atol=1e-12)
    assert (weights[q == 0] == 0).all()
    assert (weights >= 0).all()


def test_heuristics_as_they_are_defined():
    q = np.array([[0.05], [1.0], [3.0]])
    weigh = quadrature.HEURISTICS
    assert np.allclose(weigh["balance"](q).T, np.array([0.05, 1, 3]) / 4.05)
    assert np.allclose(weigh["power"](q).T, np.array([0.0025, 1, 9]) / 10.0025)
    assert np.allclose(weigh["cutoff"](q).T, [0, 0.25, 0.75])
    assert np.allclose(weigh["maximum"](q).T, [0, 0, 1])


# ---- mistakes ----------------------------------------------------------------------------------


def half(q):
    return 0.5 * quadrature.HEURISTICS["balance"](q)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: quadrature.combined(lambda x: x, [UNIFORM, LINE], 10, heuristic=half),
            "sum to 0.5",
        ),
        (
            lambda: quadrature.combined(lambda x: x, [UNIFORM], 10, heuristic="balanse"),
            "did you mean 'balance'",
        ),
        (lambda: quadrature.combined(lambda x: x, [], 10), "at least one"),
        (lambda: quadrature.combined(lambda x: x, [UNIFORM], [10, 10]), "2 counts for 1"),
        (lambda: quadrature.naive(lambda x: x, (0, 1), 1), "n must be an integer of 2 or more"),
        (lambda: quadrature.naive(lambda x: x, (1, 0), 10), "low must be below high"),
        (lambda: quadrature.naive(lambda x: 1.0, (0, 1), 10), "take numpy arrays"),
        (lambda: quadrature.naive(lambda x: np.log(x - 2), (0, 1), 10), "f is nan at x = 0"),
        (lambda: quadrature.stratified(lambda x: x, (0, 1)), "either n or strata"),
        (lambda: quadrature.stratified(lambda x: x, (0, 1), strata=[0, 2]), "ascend from 0 to 1"),
        (
            lambda: quadrature.importance(lambda x: x, sample_line, lambda x: 0 * x, 10),
            "pdf is 0 at x",
        ),
    ],
)
def test_mistakes_are_named(call, message):
    with pytest.raises(mlt.UsageError, match=message), np.errstate(invalid="ignore"):
        call()


def test_a_technique_without_density_gets_no_weight():
    left = quadrature.Technique.uniform((0, 0.5))
    with pytest.raises(mlt.UsageError, match="where its pdf is 0"):
        quadrature.combined(
            lambda x: np.ones(len(x)),
            [left, UNIFORM],
            100,
            heuristic=lambda q: np.full(q.shape, 0.5),
        )


RIGHT = {
    "uniform": quadrature.Technique.uniform((0, 1e-6)),
    "line": LINE,
    "normal": quadrature.Technique(lambda rng, n: rng.normal(3, 0.1, n), stats.norm(3, 0.1).pdf),
    "without a mean": quadrature.Technique(lambda rng, n: rng.standard_cauchy(n), stats.cauchy.pdf),
    "infinite at an end": quadrature.Technique(
        lambda rng, n: (1 - rng.random(n)) ** 2, lambda x: 0.5 / np.sqrt(x)
    ),
    "two far peaks": quadrature.Technique(
        lambda rng, n: rng.normal(0, 1, n) + 1000 * (rng.random(n) < 0.1),
        lambda x: 0.9 * stats.norm.pdf(x) + 0.1 * stats.norm.pdf(x, 1000),
    ),
    "half of a square": quadrature.Technique(
        lambda rng, n: np.sort(rng.random((n, 2))), lambda x: 2.0 * (x[:, 0] <= x[:, 1])
    ),
    "along a diagonal": quadrature.Technique(
        lambda rng, n: rng.multivariate_normal([0, 0], [[1, 0.99], [0.99, 1]], n),
        stats.multivariate_normal([0, 0], [[1, 0.99], [0.99, 1]]).pdf,
    ),
    "in space": quadrature.Technique(
        lambda rng, n: rng.normal(0, 1, (n, 3)), stats.multivariate_normal([0, 0, 0]).pdf
    ),
}


@pytest.mark.parametrize("name", RIGHT)
def test_a_density_that_is_one_is_taken(name):
    sample, pdf = RIGHT[name].sample, RIGHT[name].pdf
    for n in (256, 1000, 10_000):
        for seed in range(20):
            quadrature.importance(lambda x: np.ones(len(x)), sample, pdf, n, seed=seed)


@pytest.mark.parametrize(
    ("sample", "pdf", "n"),
    [
        (lambda rng, n: rng.random(n), lambda x: 2 * x, 1000),
        (sample_line, lambda x: 0.5 + x, 1000),
        (lambda rng, n: rng.normal(0, 1, n), stats.norm(0.5, 1).pdf, 1000),
        (lambda rng, n: rng.normal(0, 1, n), stats.norm(0, 1.5).pdf, 10_000),
        (lambda rng, n: rng.random((n, 2)), lambda x: 4 * x[:, 0] * x[:, 1], 1000),
    ],
)
def test_samples_that_do_not_follow_their_pdf_are_refused(sample, pdf, n):
    """The pdf integrates to 1, so that nothing but the samples tells."""
    for seed in range(10):
        with pytest.raises(mlt.UsageError, match=r"does not draw from pdf: .* % of its integral"):
            quadrature.importance(lambda x: np.ones(len(x)), sample, pdf, n, seed=seed)


@pytest.mark.parametrize(
    ("name", "factor"),
    [("line", 0.9), ("line", 1.1), *((name, factor) for name in RIGHT for factor in (0.5, 2))],
)
def test_a_density_that_does_not_integrate_to_one_is_refused(name, factor):
    sample, pdf = RIGHT[name].sample, RIGHT[name].pdf
    with pytest.raises(mlt.UsageError, match="pdf integrates to"):
        quadrature.importance(
            lambda x: np.ones(len(x)), sample, lambda x: factor * pdf(x), 10_000, seed=1
        )
