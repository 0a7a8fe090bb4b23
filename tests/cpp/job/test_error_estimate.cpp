#include "job/error_estimate.h"

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

/// A render whose groups are these, of equal weight.
class Given : public Rendering {
 public:
  Given(std::vector<Image> groups, Image common, bool share_sequence = false)
      : Rendering(nullptr, 1),
        groups_(std::move(groups)),
        common_(std::move(common)),
        share_sequence_(share_sequence) {}

  GroupImage group(int index, int) const override {
    if (index >= static_cast<int>(groups_.size())) return {};
    return {groups_[index], 1};
  }
  Image common_error(int) const override { return common_; }
  bool groups_share_sequence() const override { return share_sequence_; }

  Memory memory(double) const override { return {}; }
  void run_unit(uint64_t) override {}
  Image image(int) const override { return {}; }
  void add_stats(Stats&) const override {}
  std::string save(const Task&, Content) const override { return {}; }
  void load(const std::string&) override {}

 private:
  std::vector<Image> groups_;
  Image common_;
  bool share_sequence_;
};

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

}  // namespace
}  // namespace mlt
