// The order of the units of a render of samples and chains.
#include "rendering/interleaving.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

TEST(Interleaving, BeginsWithAPassAndGoesOnInRounds) {
  const Interleaving order(3, 5);
  uint64_t sampled = 0, chains = 0;
  for (uint64_t unit = 0; unit < 100; ++unit) {
    EXPECT_EQ(order.sampled_before(unit), sampled) << unit;
    const Interleaving::Place place = order.place_of(unit);
    EXPECT_EQ(place.sampled, unit < 3 || (unit - 3) % 8 < 3) << unit;
    EXPECT_EQ(place.number, place.sampled ? sampled : chains) << unit;
    ++(place.sampled ? sampled : chains);
  }
}

TEST(Interleaving, MayHaveOneKindAlone) {
  for (uint64_t unit = 0; unit < 20; ++unit) {
    EXPECT_TRUE(Interleaving(3, 0).place_of(unit).sampled);
    EXPECT_EQ(Interleaving(3, 0).place_of(unit).number, unit);
    EXPECT_FALSE(Interleaving(0, 5).place_of(unit).sampled);
    EXPECT_EQ(Interleaving(0, 5).place_of(unit).number, unit);
    EXPECT_EQ(Interleaving(0, 5).sampled_before(unit), 0u);
  }
}

}  // namespace
}  // namespace mlt::test
