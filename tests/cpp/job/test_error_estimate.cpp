#include "job/error_estimate.h"

#include "job/given_rendering.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mlt {
namespace {

constexpr int width = 12, height = 10;  // Blocks of 8 x 8, 4 x 8, 8 x 2 and 4 x 2 pixels.

Image plain(float left, float right) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = x < 8 ? left : right;
  return image;
}

/// Three groups that see 1, 2 and 3 on the left and 4 on the right: sqrt(1 / 3) is the standard
/// error of 2.
const std::vector<Image> groups = {plain(1, 4), plain(2, 4), plain(3, 4)};

TEST(ErrorEstimate, IsTheStandardErrorOfTheMeanOfTheGroups) {
  const ErrorEstimate estimate = estimate_error(Given(groups, {}));
  EXPECT_EQ(estimate.groups, 3);
  ASSERT_EQ(estimate.block_count(), 4);
  for (const Image& error : {estimate.pixels, estimate.blocks}) {
    EXPECT_NEAR(error.at(0, 0, 1), std::sqrt(1. / 3), 1e-6);
    EXPECT_EQ(error.at(error.width - 1, error.height - 1, 1), 0);
  }
  EXPECT_NEAR(estimate.blocks.at(0, 1, 2), std::sqrt(1. / 3), 1e-6);
}

TEST(ErrorEstimate, HasWhatAllGroupsHaveInCommon) {
  const ErrorEstimate estimate = estimate_error(Given(groups, plain(0.5f, 0.25f)));
  for (const Image& error : {estimate.pixels, estimate.blocks}) {
    EXPECT_NEAR(error.at(0, 0, 0), std::sqrt(1. / 3 + 0.25), 1e-6);
    EXPECT_NEAR(error.at(error.width - 1, error.height - 1, 0), 0.25, 1e-6);
  }
}

/// The groups have the variance 5/12 of the mean, pairs that follow each other 1/4.
TEST(ErrorEstimate, CountsTheStratificationOfASharedSequence) {
  const std::vector<Image> pairs = {plain(1, 1), plain(3, 3), plain(2, 2), plain(4, 4)};
  const double independent = std::sqrt(5. / 12), pair = 0.25 / (5. / 12);
  EXPECT_NEAR(estimate_error(Given(pairs, {})).pixels.at(0, 0, 1), independent, 1e-6);
  const ErrorEstimate shared = estimate_error(Given(pairs, {}, true));
  for (const Image& error : {shared.pixels, shared.blocks})
    EXPECT_NEAR(error.at(0, 0, 1), independent * pair, 1e-6);
}

/// The mean of s^2 / (L^2 + 0.01 M^2), where M = 8/3.
TEST(ErrorEstimate, IsRelativeToTheBrightness) {
  const ErrorEstimate estimate = estimate_error(Given(groups, {}));
  const double left = 1. / 3 / (4 + 0.01 * 64 / 9);
  EXPECT_NEAR(estimate.relative.value, std::sqrt(2. / 3 * left), 1e-6);
  EXPECT_NEAR(estimate.relative.carrying, 8 * height, 1e-3);
}

/// What all groups have found twice as bright changes on the left by 1, 2 and 3.
const std::vector<Image> brighter = {plain(2, 8), plain(4, 8), plain(6, 8)};

/// s^2 = 1/3 where L = 4; M = 16/3.
RelativeError change(const Rendering& before, const Rendering& after) {
  return error_of_change({&before}, {&after});
}

TEST(ErrorOfChange, IsThatOfTheDifferencesOfTheGroups) {
  const RelativeError error = change(Given(groups, {}), Given(brighter, {}));
  EXPECT_NEAR(error.value, std::sqrt(2. / 3 * 1. / 3 / (16 + 0.01 * 256 / 9)), 1e-6);
  EXPECT_NEAR(error.carrying, 8 * height, 1e-3);
}

TEST(ErrorOfChange, VanishesWhereAllGroupsChangeAlike) {
  const std::vector<Image> shifted = {plain(2, 1), plain(3, 1), plain(4, 1)};
  EXPECT_EQ(change(Given(groups, {}), Given(shifted, {})).value, 0);
}

TEST(ErrorOfChange, HasWhatTheGroupsOfEachHaveInCommon) {
  const std::vector<Image> same(3, plain(2, 2));
  const RelativeError error =
      change(Given(same, plain(0.3f, 0.3f)), Given(same, plain(0.4f, 0.4f)));
  EXPECT_NEAR(error.value, std::sqrt((0.09 + 0.16) / (4 + 0.04)), 1e-6);
}

TEST(ErrorOfChange, IsThatOfThePartsToo) {
  const Given before(groups, {}), after(brighter, {});
  const std::vector<GroupImage> same(3, {plain(2, 2), 1});
  const RelativeError error = change(Given(same, {&before}), Given(same, {&after}));
  EXPECT_NEAR(error.value, std::sqrt(2. / 3 * 1. / 3 / (36 + 0.01 * 484 / 9)), 1e-6);
}

TEST(ErrorOfChange, KnowsNothingOfGroupsThatOneOfBothLacks) {
  const std::vector<GroupImage> one = {{plain(2, 2), 1}, {}};
  const Given less(one, std::vector<const Rendering*>{});
  EXPECT_TRUE(std::isnan(change(less, Given(groups, {})).value));
  EXPECT_TRUE(std::isnan(change(Given(groups, {}), less).value));
}

}  // namespace
}  // namespace mlt
