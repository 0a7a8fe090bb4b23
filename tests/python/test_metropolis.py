"""The Metropolis lab against closed forms, at fixed seeds and levels of significance.

Histograms are made of the last states of independent chains, so that chi-square tests apply.
"""

import itertools
import pickle
import time
import warnings

import numpy as np
import pytest
from scipy import stats

import pymlt as mlt
from pymlt.lab import metropolis

ALPHA = 1e-4
BINS = np.linspace(0, 1, 21)
PARABOLA = np.diff(4 * (BINS - 0.5) ** 3)  # of 12 (x - 1/2)^2 in each bin
MIXTURE = [(metropolis.Uniform(0, 1), 0.1), (metropolis.RandomWalk(0.1), 0.9)]


def f(x):
    return (x - 0.5) ** 2 if 0 <= x <= 1 else 0


def f_of_array(x):
    return np.where((x >= 0) & (x <= 1), (x - 0.5) ** 2, 0)


class Anywhere(metropolis.Move):
    """Uniform on [0, 1], with its density."""

    def propose(self, x, rng):
        return rng.random()

    def density(self, x, y):
        return 1.0


class Nearby(metropolis.Move):
    symmetric = True

    def propose(self, x, rng):
        return x + 0.1 * (rng.random() - 0.5)


class Downhill(metropolis.Move):
    """Sizes that depend on x: not symmetric. For numbers and for arrays."""

    def __init__(self, broken=False):
        self.broken = broken

    @staticmethod
    def size(x):
        return 0.1 + 0.4 * abs(x)

    def propose(self, x, rng):
        return x + self.size(x) * (rng.random(np.shape(x)) - 0.5)

    def density(self, x, y):
        if self.broken:
            return np.ones(np.shape(x))
        return (abs(y - x) <= self.size(x) / 2) / self.size(x)


PYTHON_MIXTURE = [(Anywhere(), 0.1), (Nearby(), 0.9)]


def sample_parabola(n, seed):
    """From 12 (x - 1/2)^2, by inversion."""
    return 0.5 + np.cbrt(0.25 * (np.random.default_rng(seed).random(n) - 0.5))


def p_value(states):
    """Chi-square of independent states against the parabola."""
    counts = np.histogram(states, BINS)[0]
    return stats.chisquare(counts, PARABOLA * len(states)).pvalue


# ---- the two states ----------------------------------------------------------------------------


def test_acceptances_of_the_fair_coin():
    table = metropolis.detailed_balance([9, 1], [1 / 2, 1 / 2], "ab")
    assert np.allclose(table.a, [[1, 1 / 9], [1, 1]], rtol=1e-15)
    assert table.holds()
    assert np.allclose(table.stationary @ table.K, table.stationary)
    assert "a -> b         9    0.5000    0.1111    0.5000" in str(table)


def test_acceptances_of_the_better_proposal():
    table = metropolis.detailed_balance([9, 1], [9 / 10, 1 / 10], "ab")
    assert np.allclose(table.a, 1, rtol=1e-15)
    assert table.holds()
    assert np.allclose(table.K, [[0.9, 0.1], [0.9, 0.1]])


@pytest.mark.parametrize("T", [[1 / 2, 1 / 2], [9 / 10, 1 / 10], [[0.2, 0.8], [0.6, 0.4]]])
@pytest.mark.parametrize("start", [0, 1])
def test_two_states_have_their_stationary_distribution(T, start):
    # The second eigenvalue is 0.6 or less in size: 60 steps leave less than 1e-13 of the start.
    run = metropolis.run(metropolis.Table([9, 1]), metropolis.Discrete(T), start, 60, chains=20_000)
    in_a = int((run.states[:, -1] == 0).sum())
    assert stats.binomtest(in_a, 20_000, 0.9).pvalue > ALPHA
    assert run.states.dtype == np.int64


def test_the_chain_makes_the_transitions_of_the_table():
    table = metropolis.detailed_balance([9, 1], [1 / 2, 1 / 2])
    run = metropolis.run(
        metropolis.Table([9, 1]), metropolis.Discrete(table.T), 0, 1, chains=50_000
    )
    moved = int(run.states.sum())
    assert stats.binomtest(moved, 50_000, table.K[0, 1]).pvalue > ALPHA


def test_both_algorithms_have_the_same_mean_and_one_has_less_noise():
    shares = {}
    start = np.random.default_rng(3).random(4000) < 0.1
    for expected_values in (False, True):
        run = metropolis.run(
            metropolis.Table([9, 1]),
            metropolis.Discrete([0.5, 0.5]),
            start.astype(int),
            50,
            chains=4000,
            expected_values=expected_values,
        )
        shares[expected_values] = (run.samples * run.weights).sum(axis=1) / 50
        assert stats.ttest_1samp(shares[expected_values], 0.1).pvalue > ALPHA
    assert stats.levene(shares[False], shares[True]).pvalue < ALPHA
    assert shares[True].var() < shares[False].var()


# ---- the parabola ------------------------------------------------------------------------------

# From anywhere, a step goes to the target itself with probability 1/30 at least: 600 steps leave
# less than 2e-9 of the start.


def test_built_in_moves_sample_the_parabola():
    run = metropolis.run(metropolis.Parabola(), MIXTURE, 0.9, 600, chains=5000)
    assert p_value(run.states[:, -1]) > ALPHA


def test_python_moves_sample_the_parabola():
    run = metropolis.run(f, PYTHON_MIXTURE, 0.9, 600, chains=1000)
    assert p_value(run.states[:, -1]) > ALPHA


def test_the_small_moves_alone_stay_in_their_branch():
    run = metropolis.run(metropolis.Parabola(), metropolis.RandomWalk(0.01), 0.9, 10_000)
    assert run.samples.min() > 0.5
    assert p_value(run.samples[::100]) < ALPHA


@pytest.mark.parametrize("expected_values", [False, True])
def test_a_step_leaves_the_target_as_it_is(expected_values):
    """One step of each of many chains that start from the target."""
    start = sample_parabola(100_000, 1)
    run = metropolis.run(
        f_of_array,
        [(metropolis.Uniform(0, 1), 0.2), (Downhill(), 0.8)],
        start,
        1,
        chains=len(start),
        vectorized=True,
        expected_values=expected_values,
    )
    shares = np.stack(
        [
            ((run.samples >= low) & (run.samples < high)) @ np.ones(run.samples.shape[1])
            if not expected_values
            else (((run.samples >= low) & (run.samples < high)) * run.weights).sum(axis=1)
            for low, high in itertools.pairwise(BINS)
        ]
    )
    p = stats.ttest_1samp(shares, PARABOLA[:, None], axis=1).pvalue
    assert p.min() * len(p) > ALPHA


def test_a_wrong_density_is_seen():
    start = sample_parabola(100_000, 1)
    run = metropolis.run(
        f_of_array, Downhill(broken=True), start, 1, chains=len(start), vectorized=True
    )
    assert p_value(run.states[:, -1]) < ALPHA


def test_weights_are_a_and_one_minus_a():
    run = metropolis.run(metropolis.Parabola(), MIXTURE, 0.9, 1000, expected_values=True)
    a = run.acceptance_probability
    assert np.array_equal(run.weights[0::2], a)
    assert np.allclose(run.weights[1::2], 1 - a, rtol=0, atol=1e-15)
    before = np.r_[0.9, run.states[:-1]]
    assert np.array_equal(run.samples[1::2], before)
    moved = run.accepted
    assert np.array_equal(run.samples[0::2][moved], run.states[moved])
    expected = np.minimum(1, f_of_array(run.samples[0::2]) / f_of_array(before))
    assert np.allclose(a[a > 0], expected[a > 0])


def test_acceptance_is_counted_for_each_move():
    run = metropolis.run(metropolis.Parabola(), MIXTURE, 0.9, 20_000)
    first, second = run.move_table
    assert first["proposed"] + second["proposed"] == 20_000
    assert stats.binomtest(first["proposed"], 20_000, 0.1).pvalue > ALPHA
    assert first["acceptance"] < second["acceptance"]
    assert 0 < run.acceptance < 1


# ---- other moves and states --------------------------------------------------------------------


def test_independent_proposals_with_their_density():
    move = metropolis.Independent(lambda rng: rng.normal(0, 2), stats.norm(0, 2).pdf)
    run = metropolis.run(lambda x: np.exp(-0.5 * x * x), move, 0.0, 40, chains=300)
    assert stats.kstest(run.states[:, -1], "norm").pvalue > ALPHA


def test_independent_proposals_vectorized():
    move = metropolis.Independent(lambda rng, n: rng.normal(0, 2, n), stats.norm(0, 2).pdf)
    run = metropolis.run(
        lambda x: np.exp(-0.5 * x * x), move, 0.0, 60, chains=5000, vectorized=True
    )
    assert stats.kstest(run.states[:, -1], "norm").pvalue > ALPHA


@pytest.mark.parametrize("shape", ["uniform", "normal"])
def test_several_dimensions(shape):
    f = metropolis.Normals([[0, 0, 0]], [1.0])
    start = np.random.default_rng(2).normal(size=(2000, 3))
    run = metropolis.run(f, metropolis.RandomWalk([1, 1.5, 2], shape), start, 5, chains=2000)
    assert run.states.shape == (2000, 5, 3)
    last = run.states[:, -1]
    assert stats.kstest(last.ravel(), "norm").pvalue > ALPHA
    assert stats.kstest((last**2).sum(axis=1), stats.chi2(3).cdf).pvalue > ALPHA
    assert (last != start).any(axis=1).mean() > 0.5


def test_vectorized_in_several_dimensions_is_the_same_run():
    def g(x):
        return np.exp(-0.5 * (x**2).sum(axis=-1))

    walk = metropolis.RandomWalk(1.0, "normal")
    one, all_at_once = (
        metropolis.run(g, walk, np.zeros(2), 50, chains=7, vectorized=v) for v in (False, True)
    )
    assert np.array_equal(one.samples, all_at_once.samples)


@pytest.mark.parametrize("expected_values", [False, True])
def test_built_in_python_and_vectorized_targets_give_the_same_run(expected_values):
    runs = [
        metropolis.run(
            target, MIXTURE, 0.9, 200, chains=20, vectorized=v, expected_values=expected_values
        )
        for target, v in ((metropolis.Parabola(), False), (f, False), (f_of_array, True))
    ]
    for run in runs[1:]:
        assert np.array_equal(run.samples, runs[0].samples)
        assert np.allclose(run.weights, runs[0].weights, rtol=0, atol=1e-12)


class Reshuffle(metropolis.Move):
    symmetric = True

    def propose(self, x, rng):
        return "".join(rng.permutation(list(x)))


def test_states_may_be_any_object():
    run = metropolis.run(lambda s: 3.0 if s[0] == "a" else 1.0, Reshuffle(), "abc", 20, chains=1000)
    first = sum(chain[-1][0] == "a" for chain in run.states)
    assert stats.binomtest(first, 1000, 0.6).pvalue > ALPHA
    assert isinstance(run.samples, list)
    one = metropolis.run(lambda s: 1.0, Reshuffle(), "abc", 5)
    assert len(one.samples) == 5
    assert one.mean(lambda s: s[0] == "b") <= 1


class OnlyLeft(Nearby):
    """Acts only where x < 1/2, and knows it."""

    def suitability(self, x):
        return float(x < 0.5)


def test_suitability_is_a_part_of_the_density():
    start = sample_parabola(4000, 5)
    moves = [(Anywhere(), 0.3), (OnlyLeft(), 0.7)]
    run = metropolis.run(f, moves, start, 5, chains=len(start))
    assert p_value(run.states[:, -1]) > ALPHA
    assert (run.move[:, 0][start > 0.5] == 0).all()


def test_where_no_move_suits_a_chain_stays():
    run = metropolis.run(f, OnlyLeft(), 0.9, 10)
    assert (run.samples == 0.9).all()
    assert (run.move == -1).all()
    assert run.acceptance == 0


def test_no_proposal_is_a_rejection():
    class Shy(Nearby):
        def propose(self, x, rng):
            return None

    assert (metropolis.run(f, Shy(), 0.9, 10, expected_values=True).samples == 0.9).all()


# ---- seeds, streams, pickles ---------------------------------------------------------------------


@pytest.mark.parametrize("moves", [MIXTURE, PYTHON_MIXTURE])
def test_the_seed_decides(moves):
    a, b, c = (metropolis.run(f, moves, 0.9, 100, seed=s).samples for s in (1, 1, 2))
    assert np.array_equal(a, b)
    assert not np.array_equal(a, c)


def test_a_chain_does_not_depend_on_its_neighbours():
    few, many = (metropolis.run(f, PYTHON_MIXTURE, 0.9, 100, chains=n).samples for n in (2, 5))
    assert np.array_equal(few, many[:2])
    assert not np.array_equal(many[0], many[1])


def test_python_moves_draw_numpy_distributions_from_the_chain():
    class Wide(metropolis.Move):
        def density(self, x, y):
            return 1.0  # so that all are accepted

        def propose(self, x, rng):
            assert isinstance(rng, np.random.Generator)
            return float(rng.normal()) if rng.integers(2) else float(rng.standard_t(3))

    values = metropolis.run(lambda x: 1.0, Wide(), 0.0, 5000).samples
    p = stats.kstest(values, lambda x: 0.5 * stats.norm.cdf(x) + 0.5 * stats.t.cdf(x, 3)).pvalue
    assert p > ALPHA


def test_moves_and_targets_have_reprs_and_can_be_pickled():
    for thing in (
        metropolis.RandomWalk(0.1),
        metropolis.AdaptiveWalk(0.1, decay=0.5),
        metropolis.Uniform(0, 2),
        metropolis.Discrete([0.5, 0.5]),
        metropolis.Parabola(),
        metropolis.Table([1, 2]),
        metropolis.Normals([0, 1], [1, 2]),
    ):
        if isinstance(thing, metropolis.Target):
            thing(0)
        assert repr(pickle.loads(pickle.dumps(thing))) == repr(thing)


# ---- quadrature by Metropolis, and starts --------------------------------------------------------


def g(x):
    return np.abs(x - 0.5)


@pytest.mark.parametrize("chains", [None, 16])
def test_the_product_is_integrated_and_its_error_is_honest(chains):
    estimates = [
        metropolis.run(
            metropolis.Parabola(), MIXTURE, 0.9, 4000, chains=chains, expected_values=True, seed=s
        ).estimate(g, integral=1 / 12)
        for s in range(100)
    ]
    values = np.array([e.estimate for e in estimates])
    assert stats.ttest_1samp(values, 1 / 32).pvalue > ALPHA
    spread = np.sum((values - 1 / 32) ** 2) / np.mean([e.standard_error**2 for e in estimates])
    low, high = stats.chi2.ppf([ALPHA / 2, 1 - ALPHA / 2], 100)
    assert low < spread < high


@pytest.mark.parametrize("steps", [0.3, 3, 30])
@pytest.mark.parametrize("own", [False, True])
def test_tours_need_no_start(steps, own):
    """Their samples know nothing of the target, and their density is not uniform."""
    made = metropolis.tours(
        f_of_array if own else metropolis.Parabola(),
        MIXTURE,
        lambda rng, n: rng.random(n) ** 2,
        lambda x: 0.5 / np.sqrt(x),
        20_000,
        steps=steps,
        seed=3,
    )
    assert 0.7 * steps < len(made.states) / made.samples < 1.4 * steps
    for function, integral in ((None, 1 / 12), (g, 1 / 32), (lambda x: x, 1 / 24)):
        found = made.estimate(function)
        z = (found.estimate - integral) / found.standard_error
        assert 2 * stats.norm.sf(abs(z)) > ALPHA
        assert found.standard_error < 0.05 * integral


def test_tours_that_die_as_if_their_samples_were_uniform_are_wrong():
    made = metropolis.tours(
        metropolis.Parabola(),
        MIXTURE,
        lambda rng, n: rng.random(n) ** 2,
        lambda x: np.ones(len(x)),
        20_000,
        steps=1,
        seed=3,
    )
    found = made.estimate(lambda x: x)
    assert abs(found.estimate - 1 / 24) > 10 * found.standard_error


def bootstrap(candidates, chains, seed):
    return metropolis.bootstrap(
        f_of_array,
        lambda rng, n: rng.random(n),
        lambda x: np.ones(len(x)),
        candidates,
        chains,
        seed=seed,
    )


def short_runs(x0_of):
    """b times the mean of g over 4 chains of 5 steps, many times."""
    estimates = []
    for seed in range(1500):
        start = bootstrap(16, 4, seed)
        x0 = x0_of(start)
        run = metropolis.run(metropolis.Parabola(), MIXTURE, x0, 5, chains=4, seed=seed)
        estimates.append(start.b * run.mean(g))
    return stats.ttest_1samp(estimates, 1 / 32).pvalue


def test_there_is_no_start_up_bias_from_a_bootstrap():
    assert short_runs(lambda start: start) > ALPHA


def test_there_is_start_up_bias_without():
    assert short_runs(lambda start: 0.6) < ALPHA


def test_the_bootstrap_estimates_b():
    start = bootstrap(100_000, 8, 1)
    assert abs(start.b - 1 / 12) < 4 * start.b_error
    run = metropolis.run(metropolis.Parabola(), MIXTURE, start, 10)
    assert run.samples.shape == (8, 10)
    assert run.b == start.b


def test_an_image_is_sampled_in_proportion_to_its_pixels():
    pixels = np.array([[1.0, 2, 0], [4, 1, 8]])
    f = metropolis.Image(pixels)
    moves = [(metropolis.Uniform((0, 0), (3, 2)), 0.5), (metropolis.RandomWalk(1.5), 0.5)]
    run = metropolis.run(f, moves, (0.5, 0.5), 200, chains=4000)
    column, row = run.states[:, -1].astype(int).T
    counts = np.zeros_like(pixels)
    np.add.at(counts, (row, column), 1)
    assert counts[0, 2] == 0
    shown = pixels > 0
    assert stats.chisquare(counts[shown], pixels[shown] / 16 * 4000).pvalue > ALPHA


# ---- adaptation --------------------------------------------------------------------------------

NARROW_AND_BROAD = metropolis.Normals([0, 0], [0.03, 1], [0.5, 0.5])


TRUE_SHARE = 0.5 * np.ptp(stats.norm.cdf([-3, 3])) + 0.5 * np.ptp(stats.norm.cdf([-0.09, 0.09]))


def share_of_the_peak(move):
    """Of chains that start from the target, after 5000 steps to learn in."""
    rng = np.random.default_rng(1)
    x0 = rng.normal(0, rng.choice([0.03, 1], 64))
    run = metropolis.run(NARROW_AND_BROAD, move, x0, 25_000, chains=64)
    return run, (np.abs(run.states[:, 5000:]) < 0.09).mean(axis=1)


def test_diminishing_adaptation_reaches_its_goal_and_keeps_the_target():
    run, shares = share_of_the_peak(metropolis.AdaptiveWalk(30.0, "normal", goal=0.3))
    late = run.acceptance_probability[:, 5000:].mean(axis=1)
    assert abs(late.mean() - 0.3) < 0.01
    assert stats.ttest_1samp(shares, TRUE_SHARE).pvalue > ALPHA
    assert np.abs(np.diff(np.log(run.sizes[:, -100:]))).max() < 0.01


def test_adaptation_that_never_stops_loses_the_target():
    _, shares = share_of_the_peak(metropolis.AdaptiveWalk(1.0, "normal", rate=0.3, decay=0))
    assert stats.ttest_1samp(shares, TRUE_SHARE).pvalue < ALPHA
    assert abs(shares.mean() - TRUE_SHARE) > 0.03


class Learner(metropolis.Move):
    symmetric = True

    def __init__(self):
        self.size, self.count = 1.0, 0

    def propose(self, x, rng):
        return x + self.size * rng.normal()

    def adapt(self, acceptance):
        self.count += 1
        self.size *= np.exp((acceptance - 0.44) / self.count)


def test_a_python_move_learns_in_a_copy_of_each_chain():
    move = Learner()
    run = metropolis.run(metropolis.Normals([0], [1]), move, 0.0, 300, chains=3)
    assert move.count == 0
    assert len(set(run.sizes[:, -1])) == 3


# ---- audit -------------------------------------------------------------------------------------


class Scaling(metropolis.Move):
    """Wrong: it says that it is symmetric, but its steps are as wide as x."""

    symmetric = True

    def propose(self, x, rng):
        return x * (1 + 0.1 * rng.normal(size=np.shape(x) or None))

    def __repr__(self):
        return "Scaling()"


def on_a_sphere(x, rng):
    y = x + 0.5 * rng.normal(size=3)
    return y / np.linalg.norm(y)


def one_further(k, rng):
    return (k + 1) % 7


def turn(s, rng):
    return s[1:] + s[:1]


def swap(s, rng):
    i = rng.integers(3)
    return s[:i] + s[i + 1] + s[i] + s[i + 2 :]


def change_one(x, rng):
    y = x.copy()
    y[rng.integers(len(y))] += 0.3 * rng.normal()
    return y


def change_to_scale(x, rng):
    y = x.copy()
    y[2] *= np.exp(0.3 * rng.normal())
    return y


# A target, a start and a move that is symmetric or not.
ALIKE = [
    (lambda x: float(0 < x < 1), 0.5, lambda x, rng: x + 0.1 * rng.normal()),
    (lambda x: 1 + x, 0.3, lambda x, rng: (x + 0.2 * rng.normal()) % 1),
    (lambda x: np.exp(-x) if x >= 0 else 0, 1.0, lambda x, rng: abs(x + rng.normal())),
    (lambda x: 1 + x[0], np.array([1.0, 0, 0]), on_a_sphere),
    (lambda x: np.exp(-x @ x), np.ones(3), change_one),
    (lambda k: 1 + k, 0, lambda k, rng: (k + rng.choice([-1, 1])) % 7),
    (lambda s: 1.0 + (s[0] == "a"), "abcd", swap),
]
UNLIKE = [
    (lambda x: float(0 < x < 1), 0.5, Scaling().propose),
    (lambda x: np.exp(-x @ x), np.ones(3), change_to_scale),
    (lambda k: 1 + k, 0, one_further),
    (lambda s: 1.0 + (s[0] == "a"), "abcd", turn),
]


@pytest.mark.parametrize(("target", "x0", "propose"), ALIKE)
def test_a_symmetric_move_is_not_accused(target, x0, propose):
    move = metropolis.Symmetric(propose)
    for seed in range(5):
        metropolis.run(target, move, x0, 5000, seed=seed)  # would warn
    audit = metropolis.audit(target, move, x0, 5000)
    assert audit.verdict == ("inconclusive" if propose is on_a_sphere else "nothing found")
    assert audit.reason.endswith("after correction)") or not audit


@pytest.mark.parametrize(("target", "x0", "propose"), UNLIKE)
def test_a_move_that_only_says_that_it_is_symmetric_is_found(target, x0, propose):
    move = metropolis.Symmetric(propose)
    with pytest.warns(UserWarning, match=r"Symmetric\(.*claims that q\(x -> y\) = q\(y -> x\)"):
        metropolis.run(target, move, x0, 20_000)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        audit = metropolis.audit(target, move, x0)  # which says so by itself
    assert audit.verdict == "wrong"
    assert "goes one way" in audit.summary()
    assert audit.tests[0].p < 1e-6


def test_the_warning_names_the_move_also_in_lockstep():
    moves = [(Scaling(), 0.5), (metropolis.RandomWalk(0.1), 0.5)]
    with pytest.warns(UserWarning, match=r"^Scaling\(\) claims .* Give it density"):
        metropolis.run(f_of_array, moves, np.full(50, 0.9), 400, chains=50, vectorized=True)


@pytest.mark.parametrize("vectorized", [False, True])
def test_an_audit_of_moves_asks_for_their_density(vectorized):
    target = f_of_array if vectorized else f
    x0 = 0.9
    right = metropolis.audit(target, Downhill(), x0, 20_000, vectorized=vectorized)
    assert right.verdict == "nothing found", right
    assert "a shift of x by more than 0.00" in right.summary()
    wrong = metropolis.audit(target, Downhill(broken=True), x0, 20_000, vectorized=vectorized)
    assert wrong.verdict == "wrong", wrong
    assert not wrong
    mixture = metropolis.audit(metropolis.Parabola(), MIXTURE, x0)
    assert mixture, mixture


# ---- ArviZ -------------------------------------------------------------------------------------


@pytest.mark.filterwarnings("ignore::FutureWarning")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_arviz_knows_a_good_run_from_a_stuck_one():
    arviz = pytest.importorskip("arviz", reason="ArviZ is not installed (pip install arviz)")
    x0 = [0.1, 0.2, 0.8, 0.9]
    good = metropolis.run(metropolis.Parabola(), MIXTURE, x0, 5000, chains=4).to_arviz()
    stuck = metropolis.run(
        metropolis.Parabola(), metropolis.RandomWalk(0.02), x0, 5000, chains=4
    ).to_arviz("y")
    assert good.posterior["x"].shape == (4, 5000)
    assert float(arviz.rhat(good)["x"]) < 1.05
    assert float(arviz.rhat(stuck)["y"]) > 1.5
    assert 10 < float(arviz.ess(good)["x"]) < 20_000


def test_autocorrelation_of_a_known_process():
    rng = np.random.default_rng(1)
    noise, x = rng.normal(size=(8, 20_000)), np.zeros((8, 20_000))
    for i in range(1, 20_000):
        x[:, i] = 0.8 * x[:, i - 1] + noise[:, i]
    assert np.allclose(metropolis.autocorrelation(x, 10), 0.8 ** np.arange(11), atol=0.02)


# ---- speed -------------------------------------------------------------------------------------


def cpu_seconds(*arguments):
    start = time.process_time()
    metropolis.run(*arguments, 0.9, 1_000_000)
    return time.process_time() - start


def test_a_million_steps_are_quick():
    assert cpu_seconds(metropolis.Parabola(), MIXTURE) < 1
    assert cpu_seconds(f, PYTHON_MIXTURE) < 10


# ---- mistakes ----------------------------------------------------------------------------------


class Liar(Nearby):
    symmetric = False

    def density(self, x, y):
        return 0.0


class Lost(Nearby):
    def propose(self, x, rng):
        return "nowhere"


class Mute(metropolis.Move):
    pass


WALK = metropolis.RandomWalk(0.1)


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        ((lambda x: -1.0, WALK, 0.5, 10), {}, "target is -1 at x = 0.5"),
        ((lambda x: float("nan"), WALK, 0.5, 10), {}, "target is nan at x = 0.5"),
        ((lambda x: float("inf"), WALK, 0.5, 10), {}, "target is inf at x = 0.5"),
        ((f, WALK, 2.0, 10), {}, "target is 0 at the start x = 2"),
        ((lambda x: x, WALK, 0.01, 1000), {}, "target is -.* at x = -"),
        ((lambda x: None, WALK, 0.5, 10), {}, "must be a number, but is None"),
        (
            (f_of_array, WALK, [0.2, 7], 10),
            {"chains": 2, "vectorized": True},
            "0 at the start x = 7",
        ),
        ((lambda x: 1.0, WALK, 0.5, 10), {"vectorized": True}, "array of 1 numbers"),
        ((f, WALK, float("nan"), 10), {}, "x0 must be finite"),
        ((f, WALK, "a", 10), {}, "moves numbers, but x0 is a str"),
        ((f, WALK, np.zeros((2, 2, 2)), 10), {}, "x0 has the shape"),
        ((f, WALK, 0.9, 0), {}, "n must be a positive number of steps"),
        ((f, WALK, 0.9, 10), {"chains": 0}, "chains must be a positive number"),
        ((f, WALK, 0.9, 10), {"seed": -1}, "seed must be an integer"),
        ((3.0, WALK, 0.9, 10), {}, "target must be a function"),
        ((f, [], 0.9, 10), {}, "moves is empty"),
        ((f, f, 0.9, 10), {}, "is not a move"),
        ((f, [(WALK, -1.0)], 0.9, 10), {}, "must not be negative"),
        ((f, [(WALK, 0)], 0.9, 10), {}, "weights of all moves are 0"),
        ((f, metropolis.RandomWalk(-1), 0.9, 10), {}, "size must be positive"),
        ((f, metropolis.RandomWalk([1, 1]), 0.9, 10), {}, "does not fit a state of 1"),
        ((f, metropolis.RandomWalk(1, "gaussian"), 0.9, 10), {}, "'uniform' or 'normal'"),
        ((f, metropolis.Uniform(1, 0), 0.9, 10), {}, "low must be below high"),
        ((f, metropolis.Discrete([0.5, 0.6]), 0, 10), {}, "row 0 of T sums to 1.1"),
        ((f, metropolis.Discrete([[1, 0]]), 0, 10), {}, "square matrix"),
        ((f, metropolis.Discrete([0.5, 0.5]), 0.25, 10), {}, "x0 must be an integer"),
        ((lambda x: 1.0, metropolis.Discrete([0.5, 0.5]), 5, 10), {}, "has no row in T"),
        ((f, metropolis.AdaptiveWalk(1, goal=2), 0.9, 10), {}, "goal must be between"),
        ((metropolis.Table([1, -2]), WALK, 0, 10), {}, "finite and not negative"),
        ((metropolis.Image(np.ones((2, 2))), WALK, 0.5, 10), {}, "needs states of 2 numbers"),
        ((f, Liar(), 0.9, 10), {}, "its density q.* is 0"),
        ((f, Lost(), 0.9, 10), {}, "proposed 'nowhere'.* must be a number"),
        ((f_of_array, [OnlyLeft()], 0.9, 10), {"vectorized": True}, "suitability or adapt"),
    ],
)
def test_mistakes_are_named(arguments, options, message):
    with pytest.raises(mlt.UsageError, match=message):
        metropolis.run(*arguments, **options)


def test_a_move_without_methods_says_what_it_needs():
    with pytest.raises(NotImplementedError, match="Mute needs a method"):
        metropolis.run(f, Mute(), 0.9, 10)


def test_an_error_in_a_function_comes_through():
    with pytest.raises(ZeroDivisionError):
        metropolis.run(lambda x: 1 / 0, WALK, 0.9, 10)


def test_a_bootstrap_that_finds_nothing_says_so():
    with pytest.raises(mlt.UsageError, match="0 at all of 10 candidates"):
        metropolis.bootstrap(
            lambda x: 0 * x, lambda rng, n: rng.random(n), lambda x: np.ones(len(x)), 10
        )


# ---- other spaces ------------------------------------------------------------------------------


def test_a_target_may_bring_chains_of_its_own():
    class Space:
        def metropolis_chains(self, moves, x0, chains, seed):
            self.asked = moves, x0, chains, seed
            return self, "object"

        def advance(self, steps, expected_values):
            flat = np.zeros((1, steps))
            return {
                "states": [list(range(steps))],
                "samples": None,
                "weights": None,
                "acceptance": flat,
                "accepted": flat.astype(bool),
                "moves": flat.astype(int),
                "sizes": np.full((1, steps), np.nan),
            }

    space, move = Space(), Nearby()
    run = metropolis.run(space, [(move, 2)], None, 3, seed=4)
    assert space.asked == ([(move, 2.0)], None, None, 4)
    assert run.samples == [0, 1, 2]
    assert run.mean(lambda x: x) == 1
