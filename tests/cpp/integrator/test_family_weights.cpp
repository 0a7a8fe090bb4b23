// Chains and independent samples see the same T / P of a path, so that their weights sum to one.
#include "integrator/family_weights.h"
#include "mutation/mutation_scenes.h"
#include "mutation/path_seeds.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mlt::test {
namespace {

TEST(FamilyWeights, SumToOne) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double even : {0.0, 1e-3, 1.0, 1e5})
    for (const double q : {1e-8, 0.3, 7.0, 1e12, infinity}) {
      const FamilyWeights weights(even);
      EXPECT_NEAR(weights.of_sample(q) + weights.of_chain(q), 1, 1e-14) << even << " " << q;
    }
}

class TargetOverDensity : public testing::TestWithParam<std::string> {};

TEST_P(TargetOverDensity, IsTheSameForSamplesAndChains) {
  const TestScene made = make_mutation_scene(GetParam());
  PathTarget target(made.scene, {8});
  TargetMap map = blank_image(made.scene->camera().raster());
  map.add({3, 4}, 1);
  map.finish();
  target.set_map(map);
  PathSeeds seeds(target);
  PathState x;
  std::vector<double> errors;
  int roulette = 0;
  Rng rng(1, Purpose::test, 0);
  for (int i = 0; i < 4000; ++i)
    seeds.draw(RandomSampler(rng), [&](const Connection& c, double weight) {
      seeds.assemble(c, x);
      if (!(x.target > 0)) return;  // rounding: a path through an edge of the image, say
      const double q = weight / c.weight * c.own_share;
      errors.push_back(std::abs(q / target_over_density(x) - 1));
      roulette += x.edges() > 6;
    });
  ASSERT_GT(errors.size(), 1000u);
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  // The directions between points that were rounded are not quite those that were sampled, which
  // nearly specular BSDFs magnify.
  EXPECT_LT(errors[errors.size() / 2], 1e-6);
  if (GetParam() == "cornell") {
    EXPECT_GT(roulette, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, TargetOverDensity, testing::ValuesIn(mutation_scene_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace mlt::test
