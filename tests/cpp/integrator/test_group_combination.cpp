// How groups of chains and samples add up: the expectation is right although the starts of a group
// and its b come from the same bootstrap, and the spread of the groups is the error.
#include "harness/statistics.h"
#include "integrator/group_combination.h"

#include "base/rng.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

/// A toy render with the same dependence: T takes the values 1 and 9 on two halves of the unit
/// interval; the image is the integral of T over the second half, 4.5. A group's chains stand still
/// where they have started, which is the largest start-up bias that there can be.
struct Toy {
  static double target(double u) { return u < 0.5 ? 1 : 9; }

  Toy(uint64_t seed, int groups, int candidates, int samples) {
    Rng rng(seed, Purpose::test, 0);
    for (int g = 0; g < groups; ++g) {
      GroupProgress group;
      double sum = 0, bright = 0;
      for (int i = 0; i < candidates; ++i) {
        const double weight = target(rng.next());
        group.bootstrap.add(weight, weight, weight);
        sum += weight;
        if (weight > 1) bright += weight;
      }
      for (int i = 0; i < samples; ++i) {
        const double weight = target(rng.next());
        group.samples.add(weight, weight, weight);
      }
      group.steps = 100;
      group.brightness = 100;
      progress.push_back(group);
      recorded.push_back(100 * bright / sum);  // of RGB / T in the second half
    }
  }
  double image(const GroupScales& scales) const {
    double sum = 0;
    for (size_t g = 0; g < recorded.size(); ++g) sum += scales.chains[g] * recorded[g];
    return sum;
  }

  std::vector<GroupProgress> progress;
  std::vector<double> recorded;
};

Moments images(int candidates, int samples) {
  Moments moments;
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    const Toy toy(seed, 8, candidates, samples);
    moments.add(toy.image(GroupCombination(toy.progress).mean()));
  }
  return moments;
}

TEST(GroupCombination, HasNoStartUpBias) {
  for (const int samples : {0, 5, 200}) {
    const Moments found = images(5, samples);
    EXPECT_NEAR(found.mean(), 4.5, 4 * std::sqrt(found.variance_of_mean())) << samples;
    EXPECT_LT(std::sqrt(found.variance_of_mean()), 0.02);
  }
}

TEST(GroupCombination, WithoutSamplesIsTheMeanOfEachGroupTimesItsB) {
  const Toy toy(3, 8, 5, 0);
  double mean = 0;
  for (size_t g = 0; g < 8; ++g)
    mean += toy.progress[g].bootstrap.target.mean() * toy.recorded[g] / 100 / 8;
  EXPECT_NEAR(toy.image(GroupCombination(toy.progress).mean()), mean, 1e-12);
}

TEST(GroupCombination, IsTheMeanOfItsGroups) {
  const Toy toy(4, 8, 5, 20);
  const GroupCombination groups(toy.progress);
  double mean = 0;
  for (int g = 0; g < 8; ++g) mean += toy.image(groups.group(g)) / 8;
  EXPECT_NEAR(mean, toy.image(groups.mean()), 1e-12);
}

TEST(GroupCombination, TellsItsErrorByTheSpreadOfItsGroups) {
  Moments images, variances;
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    const Toy toy(seed, 16, 50, 100);
    const GroupCombination groups(toy.progress);
    Moments spread;
    for (int g = 0; g < 16; ++g) spread.add(toy.image(groups.group(g)));
    images.add(toy.image(groups.mean()));
    variances.add(spread.variance_of_mean());
  }
  EXPECT_NEAR(variances.mean() / images.variance(), 1, 0.1);
}

TEST(WeightClasses, TellHowManyCarryHalf) {
  WeightClasses classes;
  EXPECT_EQ(classes.carrying_half(), 0u);
  for (int i = 0; i < 1000; ++i) classes.add(1);
  EXPECT_NEAR(classes.carrying_half(), 500, 1);
  for (int i = 0; i < 20; ++i) classes.add(100);  // 2000 of 3000
  EXPECT_NEAR(classes.carrying_half(), 15, 1);
}

}  // namespace
}  // namespace mlt::test
