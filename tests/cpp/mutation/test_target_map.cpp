// The coarse image that the second stage of the target comes from.
#include "mutation/target_map.h"

#include <gtest/gtest.h>

namespace mlt {
namespace {

/// 8 x 8 cells with `samples` of brightness 1 in each of those that `is_bright` chooses.
template <class IsBright>
TargetMap map_of(int samples, IsBright&& is_bright) {
  TargetMap map({{128, 128}, {0, 0}, {128, 128}}, 16);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (int i = is_bright(x, y) ? samples : 0; i > 0; --i) map.add({16 * x + 8, 16 * y + 8}, 1);
  return map;
}
TargetMap even_map(int samples) {
  return map_of(samples, [](int, int) { return true; });
}

TEST(TargetMap, IsEvenForAnEvenImage) {
  TargetMap map = even_map(3);
  map.finish();
  for (const double factor : map.factors()) EXPECT_NEAR(factor, 1, 1e-12);
}

/// Of all that makes a cell bright one sample is hardly evidence, and thousands are.
TEST(TargetMap, BelievesOneRareSampleLessThanMany) {
  TargetMap one = even_map(100), many = even_map(100);
  one.add({70, 40}, 10000);
  for (int i = 0; i < 10000; ++i) many.add({70, 40}, 1);
  one.finish();
  many.finish();
  const auto relative = [](const TargetMap& map) { return map({70, 40}) / map({8, 120}); };
  EXPECT_GT(relative(one), 3 * relative(many));
  EXPECT_LT(relative(many), 0.1);
}

TEST(TargetMap, AvoidsWhatIsBright) {
  TargetMap map = even_map(1);
  for (int x = 0; x < 128; x += 16) map.add({x, 40}, 9);
  map.finish();
  EXPECT_LT(map({64, 40}), 0.5 * map({64, 100}));
}

/// A dark cell beside a bright one of the same block: no light was found there, often.
TEST(TargetMap, FollowsAnEdgeWhereThereAreManySamples) {
  TargetMap map = map_of(1000, [](int x, int) { return x % 2 == 0; });
  map.finish();
  EXPECT_NEAR(map({8, 8}), 0.5, 0.01);
  EXPECT_NEAR(map({24, 8}), 20, 1e-9);
}

TEST(TargetMap, IsSmoothWhereThereAreFewSamples) {
  TargetMap map = map_of(1, [](int x, int) { return x % 2 == 0; });
  map.finish();
  EXPECT_LT(map({24, 8}), 2 * map({8, 8}));
}

/// A lamp in a cell does not take the samples of what else is there.
TEST(TargetMap, DividesScatteredLightByItsOwnBrightness) {
  TargetMap map = even_map(100);
  for (int i = 0; i < 100; ++i) map.add({70, 40}, 1000, 0.9);
  map.finish();
  const double mean = (64 + 1000) / 64.0;
  EXPECT_NEAR(map({70, 40}), mean, 1e-9 * mean);
  EXPECT_NEAR(map({8, 120}), mean, 1e-9 * mean);
  EXPECT_LT(map({70, 40}, 0.9), 0.1);
}

TEST(TargetMap, IsThatOfAllLightWhereNoneIsScattered) {
  TargetMap map = even_map(0);
  for (int x = 0; x < 128; x += 16) map.add({x, 40}, 9, 1);
  map.finish();
  EXPECT_LT(map({64, 40}), 0.5 * map({64, 100}));
  EXPECT_EQ(map({64, 40}), map({64, 40}, 1));
}

TEST(TargetMap, IsEvenWithoutLight) {
  TargetMap map = even_map(0);
  map.finish();
  for (const double factor : map.factors()) EXPECT_EQ(factor, 1);
}

}  // namespace
}  // namespace mlt
