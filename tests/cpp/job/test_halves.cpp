#include "job/halves.h"

#include "job/given_rendering.h"

#include <gtest/gtest.h>

namespace mlt {
namespace {

GroupImage group(float value, double weight) {
  Image image(2, 1, 3);
  std::fill(image.data.begin(), image.data.end(), value);
  return {std::move(image), weight};
}

void expect_all(const Image& image, float value) {
  ASSERT_EQ(image.data.size(), 6u);
  for (const float one : image.data) EXPECT_NEAR(one, value, 1e-6 * std::abs(value));
}

TEST(Halves, AreWeightedMeansOfGroupsThatTheyDoNotShare) {
  const Given rendering({group(1, 1), group(4, 2), group(10, 3), group(20, 1)}, {});
  const std::optional<Halves> found = halves(rendering);
  ASSERT_TRUE(found);
  expect_all(found->first.image, 3);
  expect_all(found->second.image, 12.5);
}

TEST(Halves, OverlookGroupsWithoutSamples) {
  const Given rendering({group(1, 1), group(9, 0), group(3, 1), group(4, 1), group(6, 1)}, {});
  const std::optional<Halves> found = halves(rendering);
  ASSERT_TRUE(found);
  expect_all(found->first.image, 2);
  expect_all(found->second.image, 5);
}

TEST(Halves, LeaveOutOfTheRobustImageWhatOneGroupAloneHasFound) {
  const std::vector<GroupImage> groups(16, group(2, 1));
  std::vector<GroupImage> with_spark = groups;
  with_spark[1] = group(100, 1);
  const std::optional<Halves> found = halves(Given(with_spark, {}));
  ASSERT_TRUE(found);
  expect_all(found->first.image, 114.f / 8);
  expect_all(found->first.robust, 2);
  expect_all(found->second.image, 2);
  expect_all(found->second.robust, 2);
}

TEST(Halves, HaveTheHalvesOfTheParts) {
  const Given part({group(1, 1), group(1, 1), group(2, 1), group(2, 1)}, {});
  const std::optional<Halves> found =
      halves(Given({group(10, 5), group(10, 1), group(20, 1), group(20, 9)}, {&part}));
  ASSERT_TRUE(found);
  expect_all(found->first.image, 11);
  expect_all(found->second.image, 22);
}

TEST(Halves, AreUnknownWithFewerThanFourGroups) {
  const std::vector<GroupImage> four(4, group(1, 1)), three(3, group(1, 1));
  const Given few(three, {});
  EXPECT_FALSE(halves(few));
  EXPECT_FALSE(halves(Given(four, {&few})));
}

}  // namespace
}  // namespace mlt
