// Ids of names, and the ranks of ids in a pixel.
#include "base/murmur3.h"
#include "rendering/cryptomatte.h"
#include "rendering/ranked_coverage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mlt::test {
namespace {

TEST(CryptomatteId, IsTheHashWhereThatIsANormalFloat) {
  EXPECT_EQ(as_pixel(cryptomatte_id("hello")), 6.0705627102400005616e-17f);
  EXPECT_EQ(cryptomatte_id("hello"), murmur3("hello"));
}

/// Names whose hashes have the least and the largest exponent: a denormal float, and no number.
TEST(CryptomatteId, IsANormalFloatElsewhereToo) {
  EXPECT_EQ(murmur3("card 87"), 0x807ca522u);
  EXPECT_EQ(cryptomatte_id("card 87"), 0x80fca522u);
  EXPECT_EQ(murmur3("card 451"), 0xff82a91du);
  EXPECT_EQ(cryptomatte_id("card 451"), 0xff02a91du);
  for (const char* name : {"card 87", "card 451", ""})
    EXPECT_TRUE(std::isnormal(as_pixel(cryptomatte_id(name)))) << name;
}

void expect_ranks(const RankedCoverage& seen, double weight,
                  const std::vector<IdCoverage>& expected) {
  const std::vector<IdCoverage> ranks = seen.ranked(weight);
  ASSERT_EQ(ranks.size(), expected.size());
  for (size_t i = 0; i < ranks.size(); ++i) {
    EXPECT_EQ(ranks[i].id, expected[i].id) << i;
    EXPECT_NEAR(ranks[i].coverage, expected[i].coverage, 1e-15) << i;
  }
}

TEST(RankedCoverage, AddsUpEqualIdsAndPutsTheLargestFirst) {
  RankedCoverage seen;
  for (const auto& [id, weight] : {std::pair(1.f, 1.0), {2.f, 3.0}, {1.f, 1.0}, {3.f, 2.0}})
    seen.add(id, weight);
  expect_ranks(seen, 10, {{2, 0.3}, {1, 0.2}, {3, 0.2}});
}

TEST(RankedCoverage, HasNothingBelowZeroAndTheSameSum) {
  RankedCoverage seen;
  seen.add(1, 6);
  seen.add(2, 3);
  seen.add(3, -1);
  expect_ranks(seen, 10, {{1, 0.8 * 6 / 9}, {2, 0.8 * 3 / 9}});
  expect_ranks(seen, 5, {{1, 6.0 / 9}, {2, 3.0 / 9}});
  seen.add(3, -9);
  expect_ranks(seen, 10, {});
  expect_ranks(RankedCoverage(), 0, {});
}

}  // namespace
}  // namespace mlt::test
