// The coarse image that the second stage of the target comes from.
#include "mutation/target_map.h"

#include <gtest/gtest.h>

namespace mlt {
namespace {

/// 8 x 8 cells of brightness 1.
TargetMap even_map() {
  TargetMap map({{128, 128}, {0, 0}, {128, 128}}, 16);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) map.add({16 * x + 8, 16 * y + 8}, 1);
  return map;
}

TEST(TargetMap, IsEvenForAnEvenImageDespiteOneRareSample) {
  TargetMap map = even_map();
  map.add({70, 40}, 1000);
  map.finish();
  for (const double factor : map.factors()) EXPECT_EQ(factor, 1);
}

TEST(TargetMap, AvoidsWhatIsBright) {
  TargetMap map = even_map();
  for (int x = 0; x < 128; x += 16) map.add({x, 40}, 9);
  map.finish();
  EXPECT_LT(map({64, 40}), 0.5 * map({64, 100}));
}

}  // namespace
}  // namespace mlt
