// The brightness by which the pilot weighs noise: smooth, and blind to single samples.
#include "rendering/typical_brightness.h"

#include <gtest/gtest.h>

namespace mlt {
namespace {

constexpr int cells = 8;

/// One sample in each cell.
template <class Brightness>
TypicalBrightness brightness_of(Brightness&& brightness) {
  TypicalBrightness typical(Raster{{16 * cells, 16 * cells}, {0, 0}, {16 * cells, 16 * cells}});
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) typical.add({16 * x + 8, 16 * y + 8}, brightness(x, y));
  return typical;
}

TEST(TypicalBrightness, IsEvenDespiteOneRareSample) {
  TypicalBrightness typical = brightness_of([](int, int) { return 1; });
  typical.add({70, 40}, 1000);
  typical.finish();
  for (const Vec2 at : {Vec2(8, 120), Vec2(70, 40), Vec2(56, 40)}) EXPECT_EQ(typical(at), 1);
}

TEST(TypicalBrightness, IsRelativeToTheMean) {
  TypicalBrightness typical = brightness_of([](int, int y) { return y < 4 ? 30 : 10; });
  typical.finish();
  EXPECT_DOUBLE_EQ(typical({64, 8}), 1.5);
  EXPECT_DOUBLE_EQ(typical({64, 120}), 0.5);
}

TEST(TypicalBrightness, IsNeverZero) {
  TypicalBrightness typical = brightness_of([](int, int y) { return y < 4 ? 1 : 0; });
  typical.finish();
  EXPECT_EQ(typical({64, 120}), 0.05);
}

TEST(TypicalBrightness, IsOneWithoutLight) {
  TypicalBrightness typical = brightness_of([](int, int) { return 0; });
  typical.finish();
  EXPECT_EQ(typical({64, 120}), 1);
}

}  // namespace
}  // namespace mlt
