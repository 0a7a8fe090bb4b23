// The variance of means of stratified samples, as pairs of groups tell it.
#include "job/blocks_of_sequence.h"

#include "path/samplers.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mlt {
namespace {

constexpr int width = 64, pixels = width * width, groups = 16, samples = 8, tile = 16;

/// What each group finds in each pixel.
using Found = std::vector<std::vector<float>>;
const Found nothing(groups, std::vector<float>(pixels));

/// The squared radius of a quarter of a disc that is what there is to see in the pixel.
double radius2(int p) { return 0.2 + 0.8 * p / pixels; }

/// The groups share a sequence or do not.
Found found(bool share) {
  Found found = nothing;
  for (int p = 0; p < pixels; ++p)
    for (int g = 0; g < groups; ++g) {
      double sum = 0;
      for (int i = 0; i < samples; ++i) {
        PixelSampler sampler(share ? p : p * groups + g, share ? g * samples + i : i);
        const Vec2 u = sampler.next2();
        sum += sqr(u.x) + sqr(u.y) < radius2(p);
      }
      found[g][p] = static_cast<float>(sum / samples);
    }
  return found;
}

std::vector<float> remaining(const Found& found, int count = groups) {
  BlocksOfSequence sequence;
  for (int g = 0; g < count; ++g) sequence.add(found[g], 1);
  return sequence.remaining({width, width}, tile);
}
size_t tile_of(int pixel) { return pixel / width / tile * (width / tile) + pixel % width / tile; }

TEST(BlocksOfSequence, TellTheVarianceOfTheirMean) {
  const Found shared = found(true);
  const std::vector<float> left = remaining(shared);
  Spread spread;
  for (int g = 0; g < groups; ++g) spread.add(shared[g], 1);
  double true_variance = 0, of_groups = 0, claimed = 0;
  for (int p = 0; p < pixels; ++p) {
    true_variance += sqr(spread.mean()[p] - pi / 4 * radius2(p));
    of_groups += spread.variance(p);
    claimed += left[tile_of(p)] * spread.variance(p);
  }
  EXPECT_GT(of_groups, 2 * true_variance);
  EXPECT_GT(std::sqrt(claimed / true_variance), 0.8);
  EXPECT_LT(std::sqrt(claimed / true_variance), 1.25);
}

TEST(BlocksOfSequence, KeepTheVarianceOfIndependentGroups) {
  for (const float one : remaining(found(false))) EXPECT_NEAR(one, 1, 0.2);
}

/// Light of one sample in each pixel.
TEST(BlocksOfSequence, KeepTheVarianceOfLightThatOneSampleHasFound) {
  Found sparks = nothing;
  for (int p = 0; p < pixels; ++p) sparks[p % groups][p] = 1;
  for (const float one : remaining(sparks)) EXPECT_NEAR(one, 1, 1e-5);
}

/// Pairs are equal in a few pixels of one tile.
TEST(BlocksOfSequence, KeepTheVarianceThatFewPixelsTell) {
  Found few = nothing;
  for (int g = 0; g < groups; ++g)
    for (int p = 0; p < 7; ++p) few[g][p] = g % 2;
  for (const float one : remaining(few)) EXPECT_EQ(one, 1);
}

TEST(BlocksOfSequence, LeaveOutAGroupWithoutAnother) {
  const Found shared = found(true);
  EXPECT_EQ(remaining(shared, 9), remaining(shared, 8));
}

}  // namespace
}  // namespace mlt
