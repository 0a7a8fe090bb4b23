// The Metropolis step on the lecture's examples, where the answer is known: two states with the
// stationary distribution 0.9 / 0.1, and f(x) = (x - 1/2)^2.
//
// Histograms are made of the last states of independent chains, so that the chi-square test applies
// as it stands.
#include <gtest/gtest.h>

#include "markov/bootstrap.h"
#include "markov/lecture_examples.h"

namespace mlt {
namespace {

using namespace test;

constexpr double alpha = 1e-5;

// ---- two states

double accepted_between(TwoStates kernel, int from, int to) {
  Rng rng(1, Purpose::test, 0);
  std::array<int, 1> y{};
  while (true) {
    const Transition t = kernel.propose(from, y, 0, rng);
    if (y[0] == to) return acceptance(t);
  }
}

TEST(TwoStateChain, AcceptsOneNinthWithAFairCoin) {
  EXPECT_DOUBLE_EQ(accepted_between(fair_coin(), 0, 1), 1. / 9);
  EXPECT_EQ(accepted_between(fair_coin(), 1, 0), 1);
  EXPECT_EQ(accepted_between(fair_coin(), 0, 0), 1);
  EXPECT_EQ(accepted_between(fair_coin(), 1, 1), 1);
}

TEST(TwoStateChain, AcceptsAllFromTheTargetItself) {
  for (const int from : {0, 1})
    for (const int to : {0, 1}) EXPECT_DOUBLE_EQ(accepted_between(better_coin(), from, to), 1);
}

double two_state_p_value(const TwoStates& kernel, int start) {
  // The second eigenvalue is 4/9 or less: 60 steps leave less than 1e-20 of the start.
  constexpr int chains = 50'000;
  std::vector<double> counts(2);
  for (const int x : end_states<int>(kernel, [&](Rng&) { return start; }, chains, 60, 11))
    counts[x] += 1;
  return chi_square_counts(counts, {0.9 * chains, 0.1 * chains}).p_value;
}

TEST(TwoStateChain, HasItsStationaryDistribution) {
  for (const int start : {0, 1}) {
    EXPECT_GT(two_state_p_value(fair_coin(), start), alpha);
    EXPECT_GT(two_state_p_value(better_coin(), start), alpha);
  }
}

TEST(TwoStateChain, HasAnotherOneWhenTheProposalIsForgotten) {
  TwoStates broken = better_coin();
  broken.forgets_proposal = true;
  EXPECT_LT(two_state_p_value(broken, 0), alpha);
}

/// The share of state b that one chain of `steps` steps records, with expected weights and with the
/// chosen state alone.
std::pair<double, double> recorded_share(TwoStates kernel, int steps, uint64_t stream) {
  Rng rng(12, Purpose::test, stream);
  int x = rng.next() < 0.9 ? 0 : 1;
  std::array<int, 1> y{};
  double expected = 0, chosen = 0;
  for (int i = 0; i < steps; ++i) {
    metropolis_step(x, y, kernel, rng,
                    [&](int state, double weight) { expected += state * weight; });
    chosen += x;
  }
  return {expected / steps, chosen / steps};
}

TEST(TwoStateChain, RecordsTheSameMeanWithAndWithoutExpectedValues) {
  for (const TwoStates& kernel : {fair_coin(), better_coin()}) {
    Moments expected, chosen;
    for (uint64_t i = 0; i < 20'000; ++i) {
      const auto [e, c] = recorded_share(kernel, 20, i);
      expected.add(e);
      chosen.add(c);
    }
    EXPECT_GT(smallest_p_value({expected, chosen}, {0.1, 0.1}), alpha);
  }
}

TEST(TwoStateChain, ExpectedValuesHaveLessNoise) {
  Moments excess;  // of the squared error without expected values
  for (uint64_t i = 0; i < 20'000; ++i) {
    const auto [e, c] = recorded_share(fair_coin(), 20, i);
    excess.add((c - 0.1) * (c - 0.1) - (e - 0.1) * (e - 0.1));
  }
  EXPECT_GT(excess.mean(), 0);
  EXPECT_LT(one_sample_t_test(excess).p_value, alpha);
}

// ---- the parabola

TEST(ParabolaChain, HasItsStationaryDistribution) {
  // From anywhere, a step goes to the target itself with probability 1/30 at least (0.1 of uniform
  // proposals, accepted with f(y) / max f or more): 600 steps leave less than 2e-9 of the start.
  EXPECT_GT(parabola_p_value(end_states<double>(
                Parabola{}, [](Rng&) { return 0.9; }, 20'000, 600, 13)),
            alpha);
}

TEST(ParabolaChain, HasAnotherOneWhenTheProposalsDrift) {
  const Parabola broken{0.1};
  EXPECT_LT(parabola_p_value(end_states<double>(
                broken, [](Rng&) { return 0.9; }, 20'000, 600, 13)),
            alpha);
}

double sample_target(Rng& rng) { return Parabola::sample(rng.next()); }

TEST(ParabolaChain, StaysInItsDistributionForOneStep) {
  EXPECT_GT(parabola_p_value(end_states<double>(Parabola{}, sample_target, 1'000'000, 1, 14)),
            alpha);
}

TEST(ParabolaChain, LeavesItInOneStepWhenTheProposalsDrift) {
  EXPECT_LT(parabola_p_value(end_states<double>(Parabola{0.1}, sample_target, 1'000'000, 1, 14)),
            alpha);
}

TEST(ParabolaChain, LeavesItWhenTheQuotientIsWrong) {
  struct Broken : Parabola {
    Transition propose(const double& x, std::array<double, 1>& y, size_t stage, Rng& rng) {
      const Transition t = Parabola::propose(x, y, stage, rng);
      return {std::sqrt(t.forward), std::sqrt(t.backward)};
    }
  };
  EXPECT_LT(parabola_p_value(end_states<double>(Broken{}, sample_target, 1'000'000, 1, 14)), alpha);
}

TEST(ParabolaChain, RecordsTheSameMeanWithAndWithoutExpectedValues) {
  std::vector<Moments> expected(bins), chosen(bins);
  std::vector<double> shares = bin_integrals();
  for (double& s : shares) s /= Parabola::integral;
  constexpr int steps = 50;
  Parabola kernel;
  for (uint64_t chain = 0; chain < 20'000; ++chain) {
    Rng rng(15, Purpose::test, chain);
    double x = sample_target(rng);
    std::array<double, 1> y{};
    std::array<double, bins> e{}, c{};
    for (int i = 0; i < steps; ++i) {
      metropolis_step(x, y, kernel, rng,
                      [&](double s, double weight) { e[bin_of(s)] += weight / steps; });
      c[bin_of(x)] += 1. / steps;
    }
    for (int i = 0; i < bins; ++i) {
      expected[i].add(e[i]);
      chosen[i].add(c[i]);
    }
  }
  EXPECT_GT(smallest_p_value(expected, shares), alpha);
  EXPECT_GT(smallest_p_value(chosen, shares), alpha);
}

// ---- start-up bias

enum class Start { resampled, unweighted, fixed };

/// Many runs, each of four chains of three steps: is b times what they record the integral of f
/// over each bin, in the mean?
double start_up_p_value(Start start) {
  constexpr int candidates = 16, chains = 4, steps = 3;
  std::vector<Moments> estimates(bins);
  Parabola kernel;
  for (uint64_t run = 0; run < 20'000; ++run) {
    Rng rng(16, Purpose::test, run);
    std::vector<double> states, weights;
    for (int i = 0; i < candidates; ++i) {
      states.push_back(rng.next());
      weights.push_back(Parabola::f(states.back()));
    }
    const Bootstrap bootstrap = resample(weights, chains, rng);
    std::array<double, bins> estimate{};
    for (int c = 0; c < chains; ++c) {
      double x = start == Start::resampled ? states[bootstrap.seeds[c]] : states[c];
      if (start == Start::fixed) x = 0.9;
      std::array<double, 1> y{};
      for (int i = 0; i < steps; ++i)
        metropolis_step(x, y, kernel, rng, [&](double state, double weight) {
          estimate[bin_of(state)] += bootstrap.b * weight / (chains * steps);
        });
    }
    for (int i = 0; i < bins; ++i) estimates[i].add(estimate[i]);
  }
  return smallest_p_value(estimates, bin_integrals());
}

TEST(StartUpBias, IsGoneInTheMeanWhenStartsAreResampled) {
  EXPECT_GT(start_up_p_value(Start::resampled), alpha);
}

TEST(StartUpBias, IsThereFromAFixedStart) { EXPECT_LT(start_up_p_value(Start::fixed), alpha); }

TEST(StartUpBias, IsThereFromCandidatesWithoutTheirWeights) {
  EXPECT_LT(start_up_p_value(Start::unweighted), alpha);
}

TEST(StartUpBias, BEstimatesTheIntegral) {
  Rng rng(17, Purpose::test, 0);
  std::vector<double> weights;
  for (int i = 0; i < 100'000; ++i) weights.push_back(Parabola::f(rng.next()));
  EXPECT_GT(one_sample_t_test(moments(weights), Parabola::integral).p_value, alpha);
  EXPECT_NEAR(resample(weights, 1, rng).b, moments(weights).mean(), 1e-12);
}

}  // namespace
}  // namespace mlt
