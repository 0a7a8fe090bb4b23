#include "math/exponential.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mlt {
namespace {

TEST(Exponential, IsThatOfTheLibraryToTwoUnits) {
  for (double x = -707.9; x < 709; x += 0.0937)
    EXPECT_NEAR(exponential(x) / std::exp(x), 1, 0x1p-51) << x;
  for (const double x : {0.0, -1e-300, 1e-17, -1e-9, 0.34657359027997264, -0.34657359027997264})
    EXPECT_NEAR(exponential(x), std::exp(x), 0x1p-52) << x;
}

TEST(Exponential, IsExactAt0AndEndsAt0) {
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-0.0), 1);
  EXPECT_EQ(exponential(-1e300), 0);
  EXPECT_EQ(exponential(-std::numeric_limits<double>::infinity()), 0);
}

}  // namespace
}  // namespace mlt
