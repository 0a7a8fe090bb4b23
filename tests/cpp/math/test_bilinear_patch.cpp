#include "math/bilinear_patch.h"

#include "harness/chi_square.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

const BilinearPatch<double> patches[] = {{1, 1, 1, 1}, {0, 3, 1, 2}, {0, 0, 0, 5}, {1, 0, 0, 0}};

Vec2 uniform2(Rng& rng) {
  const double x = rng.next();
  return {x, rng.next()};
}

TEST(BilinearPatch, SamplesFollowItsDensity) {
  for (const BilinearPatch<double>& patch : patches) {
    const ChiSquareResult r = chi_square_rect(
        [&](Rng& rng) -> std::optional<Vec2> { return patch.sample(uniform2(rng)); },
        [&](const Vec2& p) { return patch.density(p); }, {0, 0}, {1, 1}, 200000, 5);
    EXPECT_GT(r.p_value, 1e-3) << r;
    EXPECT_NEAR(r.integral, 1, 1e-9) << r;
  }
}

TEST(BilinearPatch, IsAsDenseAsItsValues) {
  const BilinearPatch<double> patch{1, 2, 3, 6};  // 3 in the mean
  EXPECT_DOUBLE_EQ(patch.density({0, 0}), 1. / 3);
  EXPECT_DOUBLE_EQ(patch.density({1, 0}), 2. / 3);
  EXPECT_DOUBLE_EQ(patch.density({0, 1}), 1);
  EXPECT_DOUBLE_EQ(patch.density({1, 1}), 2);
  EXPECT_DOUBLE_EQ(patch.density({0.5, 0.5}), 1);
}

TEST(BilinearPatch, StaysInTheSquare) {
  for (const BilinearPatch<double>& patch : patches)
    for (const Vec2 u : {Vec2(0, 0), Vec2(0, 0.5), Vec2(0.5, 0), Vec2(1 - 0x1p-53, 1 - 0x1p-53)}) {
      const Vec2 p = patch.sample(u);
      EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) << p.x << " " << p.y;
    }
}

TEST(BilinearPatch, Inverts) {
  Rng rng(1, Purpose::test, 0);
  for (const BilinearPatch<double>& patch : patches)
    for (int i = 0; i < 10000; ++i) {
      const Vec2 u = uniform2(rng), v = patch.invert(patch.sample(u));
      ASSERT_NEAR(v.x, u.x, 1e-9);
      ASSERT_NEAR(v.y, u.y, 1e-9);
    }
}

}  // namespace
}  // namespace mlt::test
