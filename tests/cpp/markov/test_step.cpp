// One Metropolis-Hastings step, part by part: acceptance, weights, choice, and quotients that make
// no sense.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "harness/chi_square.h"
#include "markov/step.h"

namespace mlt {
namespace {

const double infinite = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

TEST(Acceptance, IsTheQuotientOrOne) {
  EXPECT_EQ(acceptance({4, 1}), 0.25);
  EXPECT_EQ(acceptance({1, 1}), 1);
  EXPECT_EQ(acceptance({1, 4}), 1);
  EXPECT_EQ(acceptance({1, 0}), 0);
}

TEST(Acceptance, OfNoProposalIsZero) {
  EXPECT_EQ(acceptance(impossible), 0);
  EXPECT_EQ(acceptance({infinite, 1}), 0);         // L*(y) = 0
  EXPECT_EQ(acceptance({infinite, infinite}), 0);  // also from where L* is 0
}

TEST(Acceptance, IsOneFromWhereTheTargetIsZero) { EXPECT_EQ(acceptance({1, infinite}), 1); }

TEST(Acceptance, SurvivesQuotientsThatOverflow) {
  EXPECT_EQ(acceptance({1e-300, 1e300}), 1);
  EXPECT_EQ(acceptance({1e300, 1e-300}), 0);
}

TEST(Acceptance, OfNonsenseIsNoNumber) {
  EXPECT_TRUE(std::isnan(acceptance({0, 0})));
  EXPECT_TRUE(std::isnan(acceptance({not_a_number, 1})));
  EXPECT_TRUE(std::isnan(acceptance({1, not_a_number})));
}

/// Proposes state stage + 1 with given quotients; the current state is 0.
template <size_t stages>
struct Scripted {
  std::array<Transition, stages> transitions;
  std::vector<size_t> asked = {};

  Transition propose(const int& x, std::array<int, stages>& y, size_t stage, Rng&) {
    EXPECT_EQ(x, 0);
    for (size_t i = 0; i < stage; ++i)
      EXPECT_EQ(y[i], static_cast<int>(i) + 1) << "stages see earlier ones";
    asked.push_back(stage);
    y[stage] = static_cast<int>(stage) + 1;
    return transitions[stage];
  }
};

struct Outcome {
  StepResult result;
  int state;
  std::map<int, double> weights;
  std::vector<size_t> asked;
};

template <size_t stages>
Outcome step(const std::array<Transition, stages>& transitions, uint64_t stream = 0) {
  Scripted<stages> kernel{transitions};
  Rng rng(5, Purpose::test, stream);
  Outcome outcome;
  int x = 0;
  std::array<int, stages> y{};
  outcome.result = metropolis_step(x, y, kernel, rng, [&](const int& state, double weight) {
    EXPECT_EQ(outcome.weights.count(state), 0u) << "recorded twice";
    EXPECT_GT(weight, 0);
    outcome.weights[state] = weight;
  });
  outcome.state = x;
  outcome.asked = kernel.asked;
  if (outcome.result.accepted >= 0) {
    EXPECT_EQ(x, outcome.result.accepted + 1);
    EXPECT_EQ(y[outcome.result.accepted], 0) << "the old state becomes scratch";
  }
  return outcome;
}

using Weights = std::map<int, double>;

TEST(Step, RecordsBothStatesWithTheirExpectedWeights) {
  EXPECT_EQ(step<1>({Transition{4, 1}}).weights, (Weights{{0, 0.75}, {1, 0.25}}));
  EXPECT_EQ(step<1>({Transition{1, 1}}).weights, (Weights{{1, 1.0}}));
  EXPECT_EQ(step<1>({impossible}).weights, (Weights{{0, 1.0}}));
}

TEST(Step, RecordsEveryStage) {
  const Outcome two = step<2>({Transition{4, 1}, Transition{2, 1}});
  EXPECT_EQ(two.weights, (Weights{{1, 0.25}, {2, 0.75 * 0.5}, {0, 0.75 * 0.5}}));
  EXPECT_EQ(two.result.acceptance, 0.25);
  const Outcome three = step<3>({Transition{4, 1}, impossible, Transition{2, 1}});
  EXPECT_EQ(three.weights, (Weights{{1, 0.25}, {3, 0.375}, {0, 0.375}}));
}

TEST(Step, EndsWithAStageThatIsCertain) {
  const Outcome outcome = step<3>({Transition{4, 1}, Transition{1, 1}, Transition{2, 1}});
  EXPECT_EQ(outcome.asked, (std::vector<size_t>{0, 1}));
  EXPECT_EQ(outcome.weights, (Weights{{1, 0.25}, {2, 0.75}}));
  EXPECT_GE(outcome.result.accepted, 0);
}

TEST(Step, WeightsSumToOne) {
  Rng rng(6, Purpose::test, 0);
  for (uint64_t i = 0; i < 10'000; ++i) {
    std::array<Transition, 4> transitions;
    for (Transition& t : transitions) t = {rng.next(), rng.next() * std::pow(10, -10 * rng.next())};
    double sum = 0;
    for (const auto& [state, weight] : step(transitions, i).weights) sum += weight;
    ASSERT_NEAR(sum, 1, 8 * std::numeric_limits<double>::epsilon());
  }
}

TEST(Step, ChoosesAsOftenAsItRecords) {
  const std::array<Transition, 2> transitions{Transition{4, 1}, Transition{3, 1}};
  const Weights weights = step(transitions).weights;
  std::vector<double> observed(3), expected;
  constexpr int n = 100'000;
  for (const auto& [state, weight] : weights) expected.push_back(n * weight);
  for (uint64_t i = 0; i < n; ++i) observed[step(transitions, i).state] += 1;
  EXPECT_GT(test::chi_square_counts(observed, expected).p_value, 1e-5);
}

TEST(Step, RejectsNonsenseAndSaysSo) {
  for (const Transition& nonsense :
       {Transition{0, 0}, Transition{not_a_number, 1}, Transition{1, not_a_number},
        Transition{1, -1}, Transition{-1, 1}})
    for (uint64_t i = 0; i < 100; ++i) {
      const Outcome outcome = step<1>({nonsense}, i);
      EXPECT_TRUE(outcome.result.invalid);
      EXPECT_EQ(outcome.result.accepted, -1);
      EXPECT_EQ(outcome.result.acceptance, 0);
      EXPECT_EQ(outcome.state, 0);
      EXPECT_EQ(outcome.weights, (Weights{{0, 1.0}}));
    }
}

TEST(Step, NonsenseInOneStageLeavesTheOthers) {
  const Outcome outcome = step<2>({Transition{0, 0}, Transition{2, 1}});
  EXPECT_TRUE(outcome.result.invalid);
  EXPECT_EQ(outcome.weights, (Weights{{2, 0.5}, {0, 0.5}}));
}

TEST(Step, AnImpossibleProposalIsNoNonsense) {
  for (uint64_t i = 0; i < 100; ++i) {
    const Outcome outcome = step<1>({impossible}, i);
    EXPECT_FALSE(outcome.result.invalid);
    EXPECT_EQ(outcome.state, 0);
  }
}

TEST(Step, UsesOneNumberForEachStageWhateverHappens) {
  for (const Transition& t : {Transition{4, 1}, Transition{1, 1}, impossible, Transition{0, 0}}) {
    Scripted<1> kernel{{t}};
    Rng rng(7, Purpose::test, 0), plain = rng;
    int x = 0;
    std::array<int, 1> y{};
    metropolis_step(x, y, kernel, rng, [](int, double) {});
    plain.next();
    EXPECT_EQ(rng.state(), plain.state());
  }
}

}  // namespace
}  // namespace mlt
