// Tours of light paths: they show as much light as the samples from which they start, and their
// starts die as often as the same paths do on the way.
#include "harness/statistics.h"
#include "integrator/tours/path_tours.h"
#include "mutation/mutation_testing.h"
#include "mutation/path_mixture.h"

#include <map>

namespace mlt::test {
namespace {

/// Sums up L* of what is recorded, times w2.
struct Brightness : ChainRecorder {
  explicit Brightness(const ClampingWeights& w) : weights(w) {}
  void record(const Vec2&, const Color& rgb_per_target, double weight, double over,
              LayerMask) override {
    sum += weight * target_luminance(rgb_per_target) * weights.of_chain(over);
  }
  ClampingWeights weights;
  double sum = 0;
};

struct TourCase {
  std::string scene;
  int rr_depth;
  double steps_per_sample;
  double tour_length = 0;  ///< 0: they die in proportion to P / T.
  bool manifolds = false;  ///< Whether samples join lights across chains.
  bool traced = false;     ///< Whether the samples of the image are those of path tracing.
  uint64_t steps = 20000;  ///< In each group.
};

class PathToursOf : public testing::TestWithParam<TourCase> {};
class LongPathToursOf : public PathToursOf {};

/// The mean of w2 L* / p over independent samples.
double left_to_chains(const PathTarget& target, int group, uint64_t samples) {
  PathSeeds seeds(target);
  PathState x;
  double sum = 0;
  for (uint64_t i = 0; i < samples; ++i) {
    Rng rng(8, Purpose::test, (uint64_t(group) << 32) + i);
    seeds.draw(RandomSampler(rng), [&](const Connection& c, double) {
      seeds.assemble(c, x);
      if (!(x.target > 0)) return;
      sum += target_luminance(c.contribution) * c.weight *
             target.weights().of_chain(target.over_density(x));
    });
  }
  return sum / static_cast<double>(samples);
}

/// The means over groups of what tours have recorded times kappa0, and of w2 L* / p, differ by
/// chance alone, and by a few per cent of the brightness at the most.
void expect_brightness_of_samples(const TourCase& tour) {
  const auto& [name, rr_depth, steps_per_sample, tour_length, manifolds, traced, steps] = tour;
  PathRules rules;
  rules.max_depth = 8;
  rules.rr_depth = rr_depth;
  PathTarget target(make_scene(name).scene, rules);
  if (manifolds) target.set_manifolds(std::make_shared<ManifoldGuide>(target.scene()));
  const PathMixture mixture(all_mutations(target),
                            std::make_shared<MixtureWeights>(default_weights()));
  constexpr int groups = 16;
  constexpr double b = 0.3;  // Any number is right.
  const ClampingWeights weights(0.1);
  const double kappa0 = b / steps_per_sample;
  const KillRate rate =
      tour_length > 0 ? KillRate::constant(kappa0, tour_length) : KillRate(kappa0);
  // With a constant rate, tours show all light (erpt).
  if (!(tour_length > 0)) target.set_weights(weights);
  if (traced) target.set_techniques(SampleTechniques::path_tracing);
  Moments difference, samples;
  for (int g = 0; g < groups; ++g) {
    PathTours tours(target, mixture, {7, g, 0, 1, b}, {rate, steps_per_sample});
    Brightness recorder(target.weights());
    tours.advance(steps, recorder);
    const double mean = traced ? left_to_chains(target, g, tours.samples()->count())
                               : tours.samples()->of_chains.mean();
    const double starts = static_cast<double>(tours.samples()->count());
    difference.add(kappa0 * recorder.sum / starts - mean);
    samples.add(mean);
  }
  EXPECT_GT(one_sample_t_test(difference).p_value, 1e-3)
      << difference.mean() << " of " << samples.mean();
  EXPECT_LT(std::sqrt(difference.variance_of_mean()), 0.03 * samples.mean());
}

TEST_P(PathToursOf, HaveTheBrightnessOfTheirSamples) { expect_brightness_of_samples(GetParam()); }
TEST_P(LongPathToursOf, HaveTheBrightnessOfTheirSamples) {
  expect_brightness_of_samples(GetParam());
}

std::string name_of(const testing::TestParamInfo<TourCase>& info) {
  return info.param.scene + "_" + std::to_string(info.param.rr_depth) + "_" +
         std::to_string(static_cast<int>(info.param.steps_per_sample)) +
         (info.param.tour_length > 0 ? "_constant" : "") +
         (info.param.manifolds ? "_manifolds" : "") + (info.param.traced ? "_traced" : "");
}

INSTANTIATE_TEST_SUITE_P(Scenes, PathToursOf,
                         testing::Values(TourCase{"cornell", 100, 10}, TourCase{"cornell", 2, 10},
                                         TourCase{"cornell", 2, 100},
                                         TourCase{"glass_torus", 100, 10},
                                         TourCase{"caustic", 2, 30}, TourCase{"mirrors", 2, 30},
                                         TourCase{"cornell", 2, 10, 20},
                                         TourCase{"caustic", 2, 10, 50},
                                         TourCase{"sun_caustic", 2, 10, 50, true, false, 30'000},
                                         TourCase{"cornell", 2, 10, 0, false, true},
                                         TourCase{"caustic", 2, 10, 0, false, true}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Scenes, LongPathToursOf,
                         testing::Values(TourCase{"sun_caustic", 2, 2, 0, true, false, 120'000}),
                         name_of);

/// Tours of a million steps in the mean, if they were not interrupted.
class EndlessTours : public testing::Test {
 protected:
  static constexpr double b = 1e-5, steps_per_start = 10, steps_in_pixel = 2;

  PathTours tours() const {
    return {target,
            mixture,
            {7, 0, 0, 1, b},
            {KillRate(b / steps_per_start), steps_per_start, steps_in_pixel}};
  }
  static double brightness(PathTours& tours, uint64_t steps) {
    Brightness recorder{ClampingWeights()};
    tours.advance(steps, recorder);
    return recorder.sum;
  }

  const PathTarget target{make_scene("cornell").scene, PathRules{2}};
  const PathMixture mixture{all_mutations(target),
                            std::make_shared<MixtureWeights>(default_weights())};
};

/// Counts the weight that one tour leaves in each pixel.
struct Pixels : ChainRecorder {
  void record(const Vec2& raster, const Color&, double weight, double, LayerMask) override {
    pixels[{int(std::floor(raster.x)), int(std::floor(raster.y))}] += weight;
  }
  std::map<std::pair<int, int>, double> pixels;
};

/// Of one sample that sees light directly, so that a pixel has one tour or two. A step from a pixel
/// records at most one more in it, and steps from others may too.
TEST_F(EndlessTours, WaitBeforeTheyAreSparks) {
  PathTours one = tours();
  Pixels recorder;
  one.advance(static_cast<uint64_t>(steps_per_start), recorder);
  ASSERT_EQ(one.samples()->count(), 1);
  double most = 0, all = 0;
  for (const auto& [pixel, weight] : recorder.pixels) {
    most = std::max(most, weight);
    all += weight;
  }
  EXPECT_GT(all, 2);
  EXPECT_LT(most, 2 * most_steps_in_pixel(steps_in_pixel, 0));
  EXPECT_GT(one.light_due(), 0);
}

TEST_F(EndlessTours, GoOnAsThereAreMoreSamples) {
  PathTours some = tours();
  const double first = brightness(some, 200), longest = some.stats().longest_tour;
  const double second = brightness(some, 2000);
  EXPECT_GT(second, 2 * first);
  EXPECT_GT(some.stats().longest_tour, 2 * longest);
}

TEST_F(EndlessTours, GoOnAfterTheyWereSaved) {
  PathTours some = tours(), loaded = tours();
  brightness(some, 100);
  ByteWriter bytes;
  some.save(bytes);
  const std::string saved = bytes.take();
  ByteReader reader(saved);
  loaded.load(reader);
  EXPECT_EQ(loaded.light_due(), some.light_due());
  EXPECT_EQ(brightness(loaded, 100), brightness(some, 100));
  EXPECT_EQ(loaded.stats().longest_tour, some.stats().longest_tour);
}

TEST(StepsInPixels, HaveABound) {
  EXPECT_EQ(most_steps_in_pixel(3, 0), 6);
  EXPECT_EQ(most_steps_in_pixel(3, 10), 36);
  EXPECT_EQ(most_steps_in_pixel(0.001, 10), 1);
  StepsInPixels steps;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(steps.count({1.5, -0.5}, 3));
  EXPECT_FALSE(steps.count({1.9, -0.1}, 3));
  EXPECT_FALSE(steps.has_room({1.1, -0.9}, 3));
  EXPECT_TRUE(steps.has_room({1.1, 0.1}, 3));
  EXPECT_TRUE(steps.count({1.1, -0.9}, 4));
}

}  // namespace
}  // namespace mlt::test
