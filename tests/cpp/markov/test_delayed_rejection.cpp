// Two stages: after a rejected proposal comes a second one (Tierney & Mira 1999, "Some adaptive
// Monte Carlo methods for Bayesian inference", sec. 3). The target stays what it is, if the second
// stage's quotient knows that the first was rejected, from either side.
#include <gtest/gtest.h>

#include "markov/lecture_examples.h"

namespace mlt {
namespace {

using namespace test;

constexpr double alpha = 1e-5;

/// Over the parabola on the circle [0, 1): a bold first stage that is not symmetric, then a timid
/// one whose size depends on what was rejected.
struct TwoStages {
  bool forgets_rejection = false;

  static double wrap(double x) { return x - std::floor(x); }

  /// 1 + 0.9 cos(2 pi (y - x - 1/4)): prefers what lies a quarter ahead.
  static double bold_density(double x, double y) {
    return 1 + 0.9 * std::cos(2 * pi * (y - x - 0.25));
  }
  static double bold_sample(double x, Rng& rng) {
    while (true) {
      const double y = rng.next();
      if (rng.next() * 1.9 < bold_density(x, y)) return y;
    }
  }
  /// q1(x -> y) / f(y) and back.
  static Transition bold(double x, double y) {
    return {bold_density(x, y) / Parabola::f(y), bold_density(y, x) / Parabola::f(x)};
  }

  Transition propose(const double& x, std::array<double, 2>& y, size_t stage, Rng& rng) {
    if (stage == 0) {
      y[0] = bold_sample(x, rng);
      return bold(x, y[0]);
    }
    y[1] = wrap(x + (0.05 + 0.3 * y[0]) * (rng.next() - 0.5));  // symmetric, given y[0]
    const Transition own{bold_density(x, y[0]) / Parabola::f(y[1]),
                         bold_density(y[1], y[0]) / Parabola::f(x)};
    return forgets_rejection ? own : after_rejection(own, bold(x, y[0]), bold(y[1], y[0]));
  }
};

struct OneStep {
  std::vector<double> states;
  std::vector<Moments> recorded{bins};
  std::array<int, 3> accepted{};  // stage 1, stage 2, none
};

OneStep step_from_target(TwoStages kernel, int n) {
  OneStep out;
  Rng rng(21, Purpose::test, 0);
  for (int i = 0; i < n; ++i) {
    double x = Parabola::sample(rng.next());
    std::array<double, 2> y{};
    std::array<double, bins> recorded{};
    const StepResult result = metropolis_step(
        x, y, kernel, rng, [&](double state, double weight) { recorded[bin_of(state)] += weight; });
    EXPECT_FALSE(result.invalid);
    ++out.accepted[result.accepted < 0 ? 2 : result.accepted];
    out.states.push_back(x);
    for (int b = 0; b < bins; ++b) out.recorded[b].add(recorded[b]);
  }
  return out;
}

std::vector<double> shares() {
  std::vector<double> shares = bin_integrals();
  for (double& s : shares) s /= Parabola::integral;
  return shares;
}

constexpr int samples = 2'000'000;

TEST(DelayedRejection, LeavesTheTargetUnchanged) {
  const OneStep step = step_from_target({}, samples);
  EXPECT_GT(parabola_p_value(step.states), alpha);
  EXPECT_GT(smallest_p_value(step.recorded, shares()), alpha);
  for (const int count : step.accepted) EXPECT_GT(count, samples / 20);  // each way is taken
}

TEST(DelayedRejection, ThatForgetsTheRejectionIsFound) {
  const OneStep step = step_from_target({true}, samples);
  EXPECT_LT(parabola_p_value(step.states), alpha);
  EXPECT_LT(smallest_p_value(step.recorded, shares()), alpha);
}

TEST(DelayedRejection, ConvergesFromAnywhere) {
  std::vector<double> states;
  TwoStages kernel;
  for (uint64_t chain = 0; chain < 20'000; ++chain) {
    Rng rng(22, Purpose::test, chain);
    double x = 0.9;
    std::array<double, 2> y{};
    for (int i = 0; i < 300; ++i) metropolis_step(x, y, kernel, rng, forget);
    states.push_back(x);
  }
  EXPECT_GT(parabola_p_value(states), alpha);
}

TEST(DelayedRejection, RecordsOneAfterTheOther) {
  TwoStages kernel;
  Rng rng(23, Purpose::test, 0);
  for (int i = 0; i < 1000; ++i) {
    const double before = Parabola::sample(rng.next());
    double x = before;
    std::array<double, 2> y{};
    std::vector<std::pair<double, double>> recorded;
    Rng replay = rng;
    metropolis_step(x, y, kernel, rng,
                    [&](double state, double weight) { recorded.push_back({state, weight}); });

    std::array<double, 2> z{};
    const double a1 = acceptance(kernel.propose(before, z, 0, replay));
    replay.next();
    std::vector<std::pair<double, double>> expected{{z[0], a1}};
    if (a1 < 1) {
      const double a2 = acceptance(kernel.propose(before, z, 1, replay));
      if (a2 > 0) expected.push_back({z[1], (1 - a1) * a2});
      if (a2 < 1) expected.push_back({before, (1 - a1) * (1 - a2)});
    }
    ASSERT_EQ(recorded.size(), expected.size());
    for (size_t k = 0; k < recorded.size(); ++k) {
      EXPECT_EQ(recorded[k].first, expected[k].first);
      EXPECT_DOUBLE_EQ(recorded[k].second, expected[k].second);
    }
  }
}

}  // namespace
}  // namespace mlt
