// Tours on twelve states: the states from which they step, and those to which, have a density in
// proportion to the target, whatever their starts and however long they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "markov/chain.h"
#include "markov/tour.h"
#include "math/distribution.h"

namespace mlt {
namespace {

constexpr int states = 12;
constexpr double forever = std::numeric_limits<double>::infinity();
using Values = std::array<double, states>;

/// Two peaks, with hardly anything between them.
constexpr Values target = {1, 90, 7, 0.2, 0.1, 3, 0.1, 0.4, 2, 40, 5, 1};
/// Starts that know nothing of it, and never begin in the higher peak.
constexpr Values start = {0.1, 0, 0.02, 0.2, 0.1, 0.08, 0.02, 0.2, 0.1, 0.01, 0.07, 0.1};

double sum(const Values& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

/// To a neighbour on the ring.
struct Walk {
  Transition propose(const int& x, std::array<int, 1>& y, size_t, Rng& rng) {
    y[0] = (x + (rng.next() < 0.5 ? 1 : states - 1)) % states;
    return {1 / target[y[0]], 1 / target[x]};
  }
};

/// The greatest deviation of the visits per sample from what they should be, in standard errors: of
/// states from which there is a step, and of those after it.
double deviation(double kappa0, const std::function<double(int)>& survival) {
  constexpr int samples = 40000;
  const Discrete starts({start.begin(), start.end()});
  Chain<int, Walk> chain(Walk(), Rng(3, Purpose::test, 1));
  Rng rng(3, Purpose::test, 2);
  std::array<Values, 2> sums{}, squares{};
  for (int i = 0; i < samples; ++i) {
    std::array<Values, 2> visits{};
    chain.restart(static_cast<int>(starts.sample(rng.next())));
    Tour tour{rng.next()};
    run_tour(
        tour, [] { return true; }, [&] { return survival(chain.state()); },
        [&] {
          ++visits[0][chain.state()];
          chain.step([](int, double) {});
          ++visits[1][chain.state()];
        });
    for (int k = 0; k < 2; ++k)
      for (int x = 0; x < states; ++x) {
        sums[k][x] += visits[k][x];
        squares[k][x] += visits[k][x] * visits[k][x];
      }
  }
  double greatest = 0;
  for (int k = 0; k < 2; ++k)
    for (int x = 0; x < states; ++x) {
      const double mean = sums[k][x] / samples,
                   error = std::sqrt((squares[k][x] / samples - mean * mean) / samples);
      greatest = std::max(greatest, std::abs(mean - target[x] / kappa0) / error);
    }
  return greatest;
}

double over_density(int x) { return target[x] / start[x] * sum(start); }

class Tours : public testing::TestWithParam<double> {};

/// 24 normal deviations are all below 4.2 with probability 0.999.
TEST_P(Tours, VisitStatesInProportionToTheTarget) {
  const double kappa0 = sum(target) / GetParam();
  const KillRate rate(kappa0);
  EXPECT_LT(deviation(kappa0, [&](int x) { return rate.survival(over_density(x)); }), 4.2);
}

TEST_P(Tours, DoNotIfTheyDieAtAnotherRate) {
  const double kappa0 = sum(target) / GetParam();
  const KillRate rate(kappa0);
  // As often everywhere, in the mean over the starts;
  EXPECT_GT(deviation(kappa0, [&](int) { return rate.survival(sum(target)); }), 10);
  // and by the target alone.
  EXPECT_GT(deviation(kappa0, [&](int x) { return rate.survival(states * target[x]); }), 10);
}

INSTANTIATE_TEST_SUITE_P(StepsPerSample, Tours, testing::Values(3.0, 30.0, 300.0),
                         testing::PrintToStringParamName());

/// A tour that waits now and then goes where it would have gone at once.
TEST_P(Tours, MayBeInterrupted) {
  const KillRate rate(sum(target) / GetParam());
  const auto visited_states = [&](double patience) {
    Chain<int, Walk> chain(Walk(), Rng(3, Purpose::test, 1), 4);
    const auto survival = [&] { return rate.survival(over_density(chain.state())); };
    std::vector<int> visited;
    const auto step = [&] {
      chain.step([](int, double) {});
      visited.push_back(chain.state());
    };
    Tour tour{1e-3};
    double most = patience;
    const auto goes_on = [&] { return static_cast<double>(tour.steps) < most; };
    for (; !run_tour(tour, goes_on, survival, step); most += patience)
      EXPECT_EQ(static_cast<double>(tour.steps), most);
    EXPECT_EQ(tour.steps, visited.size());
    return visited;
  };
  const auto whole = visited_states(forever);
  EXPECT_GT(whole.size(), 3);
  EXPECT_EQ(visited_states(1), whole);
  EXPECT_EQ(visited_states(3), whole);
}

TEST(KillRate, IsNoneWhereNoSampleStarts) {
  EXPECT_EQ(KillRate(2).survival(6), 0.75);
  EXPECT_EQ(KillRate(2).survival(0), 0);
  EXPECT_EQ(KillRate(2).survival(std::numeric_limits<double>::infinity()), 1);
}

}  // namespace
}  // namespace mlt
