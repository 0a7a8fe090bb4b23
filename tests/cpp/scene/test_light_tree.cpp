// The tree of lights is a distribution, and chooses the light that matters.
#include "base/error.h"
#include "base/rng.h"
#include "scene/light/light_tree.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

Vec3 draw(Rng& rng) { return {rng.next(), rng.next(), rng.next()}; }

/// Small lights of all kinds in a hall; every eighth has no power.
std::vector<LightBounds> hall(int count, Rng& rng) {
  std::vector<LightBounds> lights;
  for (int i = 0; i < count; ++i) {
    LightBounds light;
    light.low = draw(rng) * Vec3(10, 10, 2);
    light.high = light.low + (i % 3 == 0 ? Vec3(0) : 0.1 * draw(rng));
    light.axis = normalize(draw(rng) - Vec3(0.5));
    light.cos_normals = i % 4 == 0 ? -1 : 1 - 0.2 * rng.next();
    light.cos_emission = i % 5 == 0 ? -1 : 0;
    light.power = i % 8 == 7 ? 0 : rng.next();
    lights.push_back(light);
  }
  return lights;
}

class LightTreeOf : public testing::TestWithParam<int> {};

TEST_P(LightTreeOf, HasTheProbabilitiesOfItsSamplesAndTheirInverse) {
  Rng rng(1, Purpose::test, GetParam());
  const std::vector<LightBounds> lights = hall(GetParam(), rng);
  const LightTree tree(lights);
  for (int k = 0; k < 20; ++k) {
    const Vec3 p = draw(rng) * Vec3(14, 14, 6) - Vec3(2);
    double sum = 0, found = 0;
    for (uint32_t i = 0; i < lights.size(); ++i) sum += tree.probability(i, p);
    EXPECT_LE(sum, 1 + 1e-12);
    constexpr int n = 1000;
    for (int i = 0; i < n; ++i) {
      const double u = (i + rng.next()) / n;
      const LightTree::Choice choice = tree.sample(p, u);
      found += choice.probability > 0;
      if (!(choice.probability > 0)) continue;
      EXPECT_GT(lights[choice.light].power, 0);
      EXPECT_NEAR(tree.probability(choice.light, p) / choice.probability, 1, 1e-12);
      EXPECT_NEAR(tree.invert(choice.light, p, choice.remainder), u, 1e-9);
    }
    EXPECT_NEAR(found / n, sum, 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, LightTreeOf, testing::Values(1, 2, 3, 30, 1000));

/// A light is chosen wherever it may shine, also by nodes that bound it together with others.
TEST_P(LightTreeOf, ReachesEachLightFromWhereItShines) {
  Rng rng(2, Purpose::test, GetParam());
  const std::vector<LightBounds> lights = hall(GetParam(), rng);
  const LightTree tree(lights);
  int lit = 0;
  for (int k = 0; k < 2000; ++k) {
    const auto i = static_cast<uint32_t>(rng.next() * GetParam());
    const LightBounds& light = lights[i];
    const Vec3 x = light.low + draw(rng) * (light.high - light.low);
    const Vec3 p = draw(rng) * Vec3(14, 14, 6) - Vec3(2);
    if (!(light.power > 0) || !(dot(p - x, light.axis) > 0)) continue;
    EXPECT_GT(tree.probability(i, p), 0);
    ++lit;
  }
  EXPECT_GT(lit, 100);
}

TEST(LightTree, PrefersWhatIsNear) {
  LightBounds near, far;
  near.low = near.high = {0, 0, 1};
  far.low = far.high = {10, 0, 0};
  near.power = far.power = 1;
  const LightTree tree({far, near});
  EXPECT_NEAR(tree.probability(1, {0, 0, 0}), 100. / 101, 1e-9);
  EXPECT_NEAR(tree.probability(1, {20, 0, 0}), 100. / (100 + 401), 1e-3);
}

TEST(LightTree, ChoosesNothingBehindAllLights) {
  LightBounds light;
  light.low = light.high = {0, 0, 0};
  light.cos_normals = 1;
  light.cos_emission = 0;
  light.power = 1;
  const LightTree tree({light, light, light});
  EXPECT_EQ(tree.sample({0.1, 0, -1}, 0.5).probability, 0);
  EXPECT_GT(tree.sample({0.1, 0, 1}, 0.5).probability, 0);
}

TEST(LightTree, NeedsALight) { EXPECT_THROW(LightTree({LightBounds()}), UsageError); }

}  // namespace
}  // namespace mlt::test
