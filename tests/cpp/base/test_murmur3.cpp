// Hashes of whole blocks, and of tails of each length, that several implementations have as tests.
#include <gtest/gtest.h>

#include "base/murmur3.h"

namespace mlt {
namespace {

TEST(Murmur3, HashesBlocksAndTails) {
  EXPECT_EQ(murmur3(""), 0u);
  EXPECT_EQ(murmur3("\x21"), 0x72661cf4u);
  EXPECT_EQ(murmur3("\x21\x43"), 0xa0f7b07au);
  EXPECT_EQ(murmur3("\x21\x43\x65"), 0x7e4a8634u);
  EXPECT_EQ(murmur3("\x21\x43\x65\x87"), 0xf55b516bu);
  EXPECT_EQ(murmur3("\xff\xff\xff\xff"), 0x76293b50u);
}

}  // namespace
}  // namespace mlt
