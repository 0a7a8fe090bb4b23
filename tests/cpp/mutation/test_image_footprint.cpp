// A move of the caustic perturbation that is to be so many pixels long is so long on the image.
#include "harness/statistics.h"
#include "mutation/chain_perturbation.h"
#include "mutation/image_footprint.h"
#include "mutation/mutation_testing.h"

namespace mlt::test {
namespace {

struct Lengths {
  int all = 0, as_wanted = 0;
};

/// How many of the moves through `wanted` that are to be 1e-4 to 2e-4 pixels long are so.
Lengths moves(const std::string& name, bool anisotropic, const std::string& wanted,
              int samples = 3000) {
  const ScenePtr scene = make_scene(name).scene;
  const PathTarget target = path_target(scene);
  const double shortest = 1e-4, longest = 2 * shortest;
  const auto caustic = make_mutation(
      "caustic", target,
      {{"smallest_pixels", shortest}, {"largest_share", 1e-6}, {"anisotropic", anisotropic}});
  Lengths lengths;
  for_each_proposal(target, {caustic}, 11, samples,
                    [&](size_t, const PathState& x, const PathState& y, const Edit&) {
                      if (signature(x.terms) != wanted) return;
                      const double pixels = glm::length(y.raster - x.raster);
                      ++lengths.all;
                      lengths.as_wanted += pixels > 0.95 * shortest && pixels < 1.05 * longest;
                    });
  return lengths;
}

TEST(ImageFootprint, SaysHowFarTheImageOfAChainsEndMoves) {
  for (const auto& [scene, wanted] : {std::pair{"cornell", "LDE"}, {"mirrors", "LSDE"}}) {
    const Lengths lengths = moves(scene, true, wanted);
    EXPECT_GT(lengths.all, 200) << scene;
    EXPECT_GT(lengths.as_wanted, 0.95 * lengths.all) << scene;
  }
}

/// Moments of directions, by samples of the footprint and by samples of a wide cone with weights.
TEST(ImageFootprint, HasDirectionsOfItsDensity) {
  const ScenePtr scene = make_scene("cornell").scene;
  const PathState x = find_path(path_target(scene), "LDE");
  const ChainPerturbation chain(*scene, StepSizes());
  const auto footprint = ImageFootprint::of(*scene, x, 0, chain.pixel_angle(x));
  ASSERT_TRUE(footprint);
  const ExponentialRadius pixels(0.5, 2);
  const double pixel = chain.angle(x, 0, 1, 1).smallest / StepSizes().smallest_pixels;
  const ExponentialRadius cone(pixel / 100, std::min(pixel * 100, 1.5));
  const Vec3 axis = x.terms[0].w;
  const Frame frame = Frame::around(axis);
  const auto functions = [&](const Vec3& w) {
    const Vec3 local = frame.to_local(w);
    return std::array{1.0, sqr(local.x) / (sqr(local.x) + sqr(local.y)),
                      angle_between(w, axis) / pixel};
  };
  std::array<Moments, 3> own, weighted;
  Rng rng(7, Purpose::test, 0);
  for (int i = 0; i < 200'000; ++i) {
    const auto f = functions(footprint->perturb(pixels, rng));
    const Vec3 w = ChainPerturbation::perturb(axis, cone, rng);
    const double p = footprint->pdf(w, pixels) / cone.angular_pdf(angle_between(w, axis));
    const auto g = functions(w);
    for (int k = 0; k < 3; ++k) {
      own[k].add(f[k]);
      weighted[k].add(p * g[k]);
    }
  }
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(own[k].mean(), weighted[k].mean(),
                5 * std::sqrt(own[k].variance_of_mean() + weighted[k].variance_of_mean()))
        << k;
}

/// Behind a glass ball; not near its focus, where moves are as without.
TEST(ImageFootprint, KnowsHowLightIsFocused) {
  const Lengths known = moves("point_caustic", true, "LSSDE", 30000);
  const Lengths round = moves("point_caustic", false, "LSSDE", 30000);
  EXPECT_GT(known.all, 200);
  EXPECT_GT(round.all, 200);
  EXPECT_GT(known.as_wanted, 0.6 * known.all);
  EXPECT_LT(round.as_wanted, 0.3 * round.all);
}

}  // namespace
}  // namespace mlt::test
