// How groups of chains add up: the expectation is right although the starts of a group and its b
// come from the same bootstrap, and the spread of the groups is the error.
#include "base/rng.h"
#include "harness/statistics.h"
#include "rendering/group_estimator.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

/// A toy render with the same dependence: T takes the values 1 and 9 on two parts of the unit
/// interval, and the image is the integral of T over the second one: if they are halves, 4.5. A
/// group's chains stand still where they have started, which is the largest start-up bias that
/// there can be.
struct Toy {
  double target(double u) const { return u < dark ? 1 : 9; }

  Toy(uint64_t seed, int groups, int candidates, int samples, double dark = 0.5) : dark(dark) {
    Rng rng(seed, Purpose::test, 0);
    for (int g = 0; g < groups; ++g) {
      GroupProgress group;
      double sum = 0, bright = 0;
      for (int i = 0; i < candidates; ++i) {
        const double weight = target(rng.next());
        group.bootstrap.add(weight, weight);
        sum += weight;
        if (weight > 1) bright += weight;
      }
      group.b = sum / candidates;
      group.steps = 100;
      group.brightness = 100;
      progress.push_back(group);
      recorded.push_back(100 * bright / sum);  // of RGB / T in the second half
    }
    MeanSums sums;
    for (int i = 0; i < samples; ++i) sums.add(target(rng.next()));
    of_chains = estimate(sums);
  }
  GroupEstimator combination() const { return {progress, of_chains}; }
  double image(const GroupWeights& scales) const {
    double sum = 0;
    for (size_t g = 0; g < recorded.size(); ++g) sum += scales[g] * recorded[g];
    return sum;
  }

  double dark;  ///< The size of the first part.
  std::vector<GroupProgress> progress;
  std::vector<double> recorded;
  Estimate of_chains;
};

/// Tours that wait have yet to record a fifth of the light: where, is not known.
TEST(GroupEstimator, CountsWhatWaitsAsAnError) {
  std::vector<GroupProgress> groups(4);
  for (GroupProgress& group : groups) {
    group.b = 2;
    group.steps = 100;
    group.brightness = 40;
    group.due = 10;
  }
  const GroupEstimator estimator(groups, {}, false);
  EXPECT_NEAR(estimator.waiting(), 0.2, 1e-12);
  EXPECT_NEAR(estimator.missing(), 0.2, 1e-12);
  double error = 0;
  for (const double scale : estimator.common_error()) error += scale * 40;
  EXPECT_NEAR(error, 0.2, 1e-12);
}

/// Chains that are brighter than the samples: light is missing in the negative.
TEST(GroupEstimator, KnowsThatChainsAreTooBright) {
  std::vector<GroupProgress> groups(4);
  for (size_t g = 0; g < groups.size(); ++g) {
    groups[g].b = 2;
    groups[g].steps = 100;
    groups[g].brightness = 40 + 0.1 * g;
  }
  MeanSums samples;
  for (int i = 0; i < 1000; ++i) samples.add(0.5 + 0.01 * (i % 2));
  EXPECT_LT(GroupEstimator(groups, estimate(samples), false).missing(), -0.25);
}

TEST(GroupEstimator, HasNoStartUpBias) {
  for (const int samples : {0, 5, 200}) {
    Moments images;
    for (uint64_t seed = 0; seed < 4000; ++seed) {
      const Toy toy(seed, 8, 5, samples);
      images.add(toy.image(toy.combination().mean()));
    }
    EXPECT_NEAR(images.mean(), 4.5, 4 * std::sqrt(images.variance_of_mean())) << samples;
    EXPECT_LT(std::sqrt(images.variance_of_mean()), 0.02);
  }
}

TEST(GroupEstimator, WithoutSamplesIsTheMeanOfEachGroupTimesItsB) {
  const Toy toy(3, 8, 5, 0);
  double mean = 0;
  for (size_t g = 0; g < 8; ++g) mean += toy.progress[g].b * toy.recorded[g] / 100 / 8;
  EXPECT_NEAR(toy.image(toy.combination().mean()), mean, 1e-12);
}

TEST(GroupEstimator, LeavesOutGroupsThatHaveNotBegun) {
  Toy toy(3, 8, 5, 0);
  toy.progress[7].steps = 0;
  double mean = 0;
  for (size_t g = 0; g < 7; ++g) mean += toy.progress[g].b * toy.recorded[g] / 100 / 7;
  EXPECT_NEAR(toy.image(toy.combination().mean()), mean, 1e-12);
}

TEST(GroupEstimator, IsAsBrightAsTheSamplesSay) {
  Toy toy(4, 8, 50, 100000);
  for (GroupProgress& group : toy.progress) group.bootstrap = {};
  for (double& recorded : toy.recorded) recorded = 100;  // the whole image
  EXPECT_NEAR(toy.image(toy.combination().mean()), toy.of_chains.mean, 0.01);
}

TEST(GroupEstimator, TakesNoLightThatIsNotThere) {
  for (const double excess : {1.5, 3.0, 30.0, 1000.0}) {
    Toy toy(5, 16, 50, 100000);
    toy.progress[3].brightness *= excess;
    const GroupEstimator groups = toy.combination();
    for (const double scale : groups.mean()) EXPECT_GE(scale, 0) << excess;
    double brightness = 0;
    for (int g = 0; g < 16; ++g)
      for (int h = 0; h < 16; ++h)
        brightness += groups.group(g)[h] * toy.progress[h].brightness / 16;
    EXPECT_NEAR(brightness, toy.of_chains.mean, 0.02 * toy.of_chains.mean) << excess;
  }
}

TEST(GroupEstimator, PlacesNoMoreMissingLightThanTheChainsShow) {
  Toy toy(6, 16, 50, 1);
  for (GroupProgress& group : toy.progress) group.bootstrap = {};
  toy.of_chains = {50, 100, 1000};  // of which the chains show a tenth
  const GroupEstimator groups = toy.combination();
  const GroupWeights common = groups.common_error(), mean = groups.mean();
  double placed = 0, shown = 0;
  for (int g = 0; g < 16; ++g) {
    placed += common[g] * toy.progress[g].brightness;
    shown += mean[g] * toy.progress[g].brightness;
  }
  EXPECT_NEAR(shown, 5, 0.5);
  EXPECT_NEAR(placed, shown, 0.1 * shown);
  EXPECT_NEAR(placed * (1 + groups.excess()), 50 - shown, 1);
}

/// The variance that renders tell, over that of their images.
double told_over_true(int candidates, int samples, double dark) {
  Moments images, variances;
  for (uint64_t seed = 0; seed < 4000; ++seed) {
    const Toy toy(seed, 16, candidates, samples, dark);
    const GroupEstimator groups = toy.combination();
    Moments spread;
    for (int g = 0; g < 16; ++g) spread.add(toy.image(groups.group(g)));
    EXPECT_NEAR(spread.mean(), toy.image(groups.mean()), 1e-9);
    images.add(toy.image(groups.mean()));
    const double common = toy.image(groups.common_error());
    variances.add(spread.variance_of_mean() + common * common);
  }
  return variances.mean() / images.variance();
}

TEST(GroupEstimator, TellsItsError) { EXPECT_NEAR(told_over_true(50, 200, 0.5), 1, 0.1); }

/// The others are corrected by the image of the group that has found it.
TEST(GroupEstimator, TellsItsErrorWhereOneGroupFindsLight) {
  EXPECT_NEAR(told_over_true(3, 200, 0.98), 1, 0.1);
}

}  // namespace
}  // namespace mlt::test
