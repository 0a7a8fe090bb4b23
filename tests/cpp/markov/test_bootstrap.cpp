// Seeds of chains, resampled in proportion to weights.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "markov/bootstrap.h"
#include "markov/lecture_examples.h"

namespace mlt {
namespace {

using namespace test;

constexpr double alpha = 1e-5;

const std::vector<double> weights{0.3, 0, 2.5, 1, 0.001, 0, 4, 0.7};
const double total = std::accumulate(weights.begin(), weights.end(), 0.0);

std::vector<double> counts_of(const std::vector<uint32_t>& seeds, size_t candidates) {
  std::vector<double> counts(candidates);
  for (const uint32_t s : seeds) counts.at(s) += 1;
  return counts;
}

TEST(Resample, ChoosesInProportionToWeight) {
  for (const uint32_t chains : {1, 3, 16, 100}) {
    std::vector<Moments> counts(weights.size());
    for (uint64_t stream = 0; stream < 50'000; ++stream) {
      Rng rng(31, Purpose::resample, stream);
      const std::vector<double> c = counts_of(resample(weights, chains, rng).seeds, weights.size());
      for (size_t i = 0; i < c.size(); ++i) counts[i].add(c[i]);
    }
    std::vector<double> expected, wrong;
    for (const double w : weights) {
      expected.push_back(chains * w / total);
      wrong.push_back(chains * std::sqrt(w) / total);
    }
    EXPECT_GT(smallest_p_value(counts, expected), alpha) << chains;
    EXPECT_LT(smallest_p_value(counts, wrong), alpha) << chains;  // the test can fail
  }
}

TEST(Resample, IsSystematic) {
  // Each candidate is chosen as often as expected, rounded down or up.
  for (uint64_t stream = 0; stream < 1000; ++stream) {
    Rng rng(32, Purpose::resample, stream);
    const std::vector<double> counts = counts_of(resample(weights, 100, rng).seeds, weights.size());
    for (size_t i = 0; i < counts.size(); ++i)
      EXPECT_LT(std::abs(counts[i] - 100 * weights[i] / total), 1 + 1e-9);
  }
}

TEST(Resample, TiesNoChainToACandidate) {
  // Each single chain's seed is distributed as the weights are.
  constexpr uint32_t chains = 8;
  constexpr int streams = 50'000;
  std::vector<std::vector<double>> counts(chains, std::vector<double>(weights.size()));
  for (uint64_t stream = 0; stream < streams; ++stream) {
    Rng rng(33, Purpose::resample, stream);
    const Bootstrap bootstrap = resample(weights, chains, rng);
    for (uint32_t c = 0; c < chains; ++c) counts[c][bootstrap.seeds[c]] += 1;
  }
  std::vector<double> expected, p;
  for (const double w : weights) expected.push_back(streams * w / total);
  for (const auto& c : counts) p.push_back(chi_square_counts(c, expected).p_value);
  for (const double adjusted : holm_adjusted(p)) EXPECT_GT(adjusted, alpha);
}

TEST(Resample, KnowsTheMeanAndItsStandardError) {
  Rng rng(34, Purpose::resample, 0);
  const Bootstrap bootstrap = resample(weights, 5, rng);
  const Moments m = moments(weights);
  EXPECT_NEAR(bootstrap.b, m.mean(), 1e-14);
  EXPECT_NEAR(bootstrap.b_error, std::sqrt(m.variance_of_mean()), 1e-14);
}

TEST(Resample, TheStandardErrorIsTheSpreadOfTheMean) {
  Moments excess;
  for (uint64_t stream = 0; stream < 20'000; ++stream) {
    Rng rng(35, Purpose::resample, stream);
    std::vector<double> drawn;
    for (int i = 0; i < 20; ++i) drawn.push_back(Parabola::f(rng.next()));
    const Bootstrap bootstrap = resample(drawn, 1, rng);
    const double error = bootstrap.b - Parabola::integral;
    excess.add(error * error - bootstrap.b_error * bootstrap.b_error);
  }
  EXPECT_GT(one_sample_t_test(excess).p_value, alpha);
}

TEST(Resample, NeverChoosesWeightZero) {
  for (uint64_t stream = 0; stream < 10'000; ++stream) {
    Rng rng(36, Purpose::resample, stream);
    for (const uint32_t seed : resample({0, 0, 1e-9, 0, 1, 0, 0}, 7, rng).seeds)
      EXPECT_TRUE(seed == 2 || seed == 4) << seed;
  }
}

TEST(Resample, WithoutAnyWeightHasNoSeeds) {
  Rng rng(37, Purpose::resample, 0);
  for (const std::vector<double>& none : {std::vector<double>{}, {0}, {0, 0, 0}}) {
    const Bootstrap bootstrap = resample(none, 10, rng);
    EXPECT_TRUE(bootstrap.seeds.empty());
    EXPECT_EQ(bootstrap.b, 0);
    EXPECT_EQ(bootstrap.b_error, 0);
  }
}

TEST(Resample, OfOneCandidateStartsAllChainsThere) {
  Rng rng(38, Purpose::resample, 0);
  const Bootstrap bootstrap = resample({2.5}, 10, rng);
  EXPECT_EQ(bootstrap.seeds, std::vector<uint32_t>(10, 0));
  EXPECT_EQ(bootstrap.b, 2.5);
  EXPECT_EQ(bootstrap.b_error, 0);
}

TEST(Resample, OfOnlyOneWithWeightStartsAllChainsThere) {
  Rng rng(39, Purpose::resample, 0);
  const Bootstrap bootstrap = resample({0, 0, 3, 0}, 10, rng);
  EXPECT_EQ(bootstrap.seeds, std::vector<uint32_t>(10, 2));
  EXPECT_EQ(bootstrap.b, 0.75);
}

TEST(Resample, GivesAllSeedsInSpiteOfRounding) {
  for (uint64_t stream = 0; stream < 200; ++stream) {
    Rng rng(40, Purpose::resample, stream);
    std::vector<double> many(1000);
    for (double& w : many) w = std::pow(10, 12 * rng.next() - 6);
    many.back() = 0;
    const Bootstrap bootstrap = resample(many, 997, rng);
    ASSERT_EQ(bootstrap.seeds.size(), 997u);
    for (const uint32_t seed : bootstrap.seeds) ASSERT_LT(seed, 999u);
  }
}

TEST(Resample, EqualWeightsHaveNoError) {
  Rng rng(41, Purpose::resample, 0);
  const Bootstrap bootstrap = resample(std::vector<double>(1000, 0.1), 10, rng);
  EXPECT_NEAR(bootstrap.b, 0.1, 1e-13);
  EXPECT_NEAR(bootstrap.b_error, 0, 1e-9);
}

TEST(Resample, DependsOnTheStreamAlone) {
  Rng a(42, Purpose::resample, 0), same(42, Purpose::resample, 0), other(42, Purpose::resample, 1);
  const Bootstrap first = resample(weights, 100, a);
  EXPECT_EQ(resample(weights, 100, same).seeds, first.seeds);
  EXPECT_NE(resample(weights, 100, other).seeds, first.seeds);
}

}  // namespace
}  // namespace mlt
