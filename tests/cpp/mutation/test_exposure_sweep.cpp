// Paths that are recorded in all exposures stand for the paths of each.
#include "mutation/exposure_sweep.h"

#include "harness/statistics.h"
#include "mutation/mutation_testing.h"
#include "path/measure.h"

namespace mlt::test {
namespace {

constexpr int exposures = 4;

/// A ball rises between a lamp and the floor, so that each exposure has another brightness.
ScenePtr rising(const std::string& bsdf) {
  const std::string shutter =
      "<float name='shutter_open' value='0'/><float name='shutter_close' value='1'/>"
      "<integer name='exposures' value='4'/><float name='exposure_share' value='0.5'/>";
  const std::string ball =
      "<shape type='sphere'><float name='radius' value='0.35'/><animation name='to_world'>"
      "<transform time='0'><translate y='-0.6'/></transform>"
      "<transform time='1'><translate x='0.1' y='0.5'/></transform></animation>";
  return load_scene(
      camera("0, 0, 3.4", "0, 0, 0", 42, film(8, 6), "perspective", shutter) + room() + ball +
      bsdf + "</shape>" +
      rectangle(rotate("x", 90) + scale(0.3) + translate(0, 0.95, 0), white + area_light("9 8 6")));
}

struct Sums {
  double of[exposures] = {};
};

/// For each exposure the difference of what a sample records by sweeps and by itself.
std::vector<Moments> differences(const PathTarget& target, int samples) {
  const Shutter& shutter = target.scene().camera().shutter();
  ExposureSweep sweep(target, Rng(3, Purpose::test, 0));
  EXPECT_TRUE(sweep.wanted());
  MutationScratch scratch;
  PathSeeds seeds(target);
  PathState x;
  std::vector<Moments> found(exposures);
  for (int i = 0; i < samples; ++i) {
    Sums sums;
    Rng rng(1, Purpose::test, static_cast<uint64_t>(i));
    seeds.draw(RandomSampler(rng), [&](const Connection& c, double weight) {
      seeds.assemble(c, x);
      if (!(x.target > 0)) return;
      sums.of[shutter.exposure(x.path.time)] -= weight;
      sweep(x, weight, scratch, [&](const PathState& y, double share) {
        sums.of[shutter.exposure(y.path.time)] += share;
      });
    });
    for (int e = 0; e < exposures; ++e) found[e].add(sums.of[e]);
  }
  return found;
}

void expect_same_sums(const std::string& bsdf) {
  const PathTarget target = path_target(rising(bsdf), 5);
  for (const Moments& difference : differences(target, 150000))
    EXPECT_GT(one_sample_t_test(difference).p_value, 1e-3)
        << difference.mean() << " +- " << std::sqrt(difference.variance_of_mean());
}

TEST(ExposureSweep, RecordsTheLightOfEachExposureOfDiffuseThings) { expect_same_sums(white); }
TEST(ExposureSweep, RecordsTheLightOfEachExposureBehindGlass) { expect_same_sums(glass); }

TEST(ExposureSweep, SharesArePartsOfTheWeightByTargetOverDensity) {
  const PathTarget target = path_target(rising(glass), 5);
  const auto over_density = [](const PathState& y) {
    return y.target / total_density(ContributionMeasure{y.terms});
  };
  ExposureSweep sweep(target, Rng(3, Purpose::test, 0));
  MutationScratch scratch;
  int several = 0;
  for_each_light_path(target, 1, 300, [&](const PathState& x) {
    if (!(x.target > 0)) return;
    double sum = 0, first = 0;
    sweep(x, 4, scratch, [&](const PathState& y, double share) {
      if (sum == 0)
        first = share / over_density(x);
      else
        ++several;
      EXPECT_NEAR(share, first * over_density(y), 1e-9 * share);
      sum += share;
    });
    EXPECT_NEAR(sum, 4, 1e-12);
  });
  EXPECT_GT(several, 100);
}

}  // namespace
}  // namespace mlt::test
