// How many groups are left out of a pixel.
#include <gtest/gtest.h>

#include "job/fireflies.h"

namespace mlt {
namespace {

TEST(LeftOut, IsNoneWhereAllGroupsAgree) {
  EXPECT_EQ(left_out(std::vector<float>(16, 2.f)), 0);
  EXPECT_EQ(left_out(std::vector<float>(16, 0.f)), 0);
  EXPECT_EQ(left_out({1.f}), 0);
  EXPECT_EQ(left_out({0.f, 1.f}), 0);
}

TEST(LeftOut, IsAllButTheMedianWhereOneHasFoundAll) {
  std::vector<float> sixteen(16, 0.f);
  sixteen.back() = 5;
  EXPECT_EQ(left_out(sixteen), 7);  // G = 15 / 16
  EXPECT_EQ(left_out({0.f, 0.f, 5.f}), 1);
}

TEST(LeftOut, FollowsTheGiniCoefficient) {
  // G = 2 (1 + 4 + 9 + 16 + 25 + 36 + 49 + 64) / (8 * 36) - 9 / 8 = 7 / 24: 1.17 on each side.
  EXPECT_EQ(left_out({1, 2, 3, 4, 5, 6, 7, 8}), 1);
  // All by 8 more: G = 7 / 24 * 36 / 100 = 0.105, so that nothing is left out.
  EXPECT_EQ(left_out({9, 10, 11, 12, 13, 14, 15, 16}), 0);
}

TEST(LeftOut, IsNotMoreThanThereAreWithNegativeLobes) { EXPECT_EQ(left_out({-3, -1, 0, 5}), 1); }

}  // namespace
}  // namespace mlt
