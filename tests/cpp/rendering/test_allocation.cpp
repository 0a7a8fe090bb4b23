// How the time is divided: by the least J, where the noise of samples is known, and alike for all
// seeds.
#include "base/parallel.h"
#include "integrator/tours/mlt_algorithm.h"
#include "mutation/mutation_testing.h"
#include "rendering/coarse_image.h"
#include "scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mlt::test {
namespace {

/// Each sample finds light of brightness 1, and with this probability other light. Half of them see
/// a lamp.
struct Light {
  double probability, brightness, lamp = 0;
};

constexpr uint64_t rays_of_sample = 9;
constexpr double cost_of_sample = 10, cost_of_mutation = 4;

class KnownSource : public MetropolisAlgorithm::Source {
 public:
  explicit KnownSource(const Light& light) : light_(light) {}
  const std::vector<FoundLight>& sample(const Vec2& raster, PixelSampler& sampler) override {
    found_.clear();
    add(raster, 1);
    if (sampler.next() < light_.probability) add(raster, light_.brightness);
    if (sampler.next() < 0.5) found_.push_back({{raster, Color(light_.lamp), true}});
    rays_.intersect += rays_of_sample;
    return found_;
  }
  const std::vector<FoundLight>& sample(const Vec2&, RandomSampler&) override { return found_; }
  const RayCounts& rays() const override { return rays_; }

 private:
  void add(const Vec2& raster, double brightness) {
    FoundLight light{{raster, Color(brightness), true}};
    light.weight = light.target_over_density = brightness;
    found_.push_back(light);
  }
  Light light_;
  std::vector<FoundLight> found_;
  RayCounts rays_;
};

/// Chains whose target is all light.
class KnownAlgorithm : public MetropolisAlgorithm {
 public:
  KnownAlgorithm(ScenePtr scene, const Light& light) : scene_(std::move(scene)), light_(light) {}
  std::unique_ptr<Source> source() const override { return std::make_unique<KnownSource>(light_); }
  std::unique_ptr<SampleTaker> sample_taker(const ClampingWeights&) const override {
    return nullptr;
  }
  const Scene& scene() const override { return *scene_; }
  std::unique_ptr<RenderChain> blank(const ChainId&, const Allocation&) const override {
    return nullptr;
  }
  std::vector<MutationStats> rows() const override { return {}; }

 private:
  ScenePtr scene_;
  Light light_;
};

struct Division {
  double j, share;
};
Division known_division(const Light& light, double c) {
  const auto [p, v, lamp] = light;
  const double b = 1 + p * v, variance = p * (1 - p) * std::pow(std::min(v, c), 2),
               e = p * std::max(0.0, v - c) + std::max(0.0, 1 - c),
               work = 3 * b / c * cost_of_mutation;
  return {(variance + c * e) * (cost_of_sample + work), cost_of_sample / (cost_of_sample + work)};
}

class AllocationOf : public testing::TestWithParam<Light> {};

TEST_P(AllocationOf, HasTheLeastVarianceInATime) {
  const Light& light = GetParam();
  KnownAlgorithm algorithm(make_scene("cornell").scene, light);
  const Raster& raster = algorithm.scene().camera().raster();
  CoarseImage coarse = coarse_image(algorithm, raster, 1, 20000, 1, never_cancelled);
  EXPECT_NEAR(coarse.b, 1 + light.probability * light.brightness, 0.2 * coarse.b);
  CoarseImage even(raster);
  even.map.finish();
  even.b = coarse.b;
  const Allocation found = allocate(algorithm, even, {1, 1, 20000, {}, {}}, never_cancelled);
  double least = std::numeric_limits<double>::infinity();
  for (double c = 1. / 64; c < 1 << 14; c *= 1.02) {
    const auto [j, share] = known_division(light, c);
    if (0.05 <= share && share <= 0.95) least = std::min(least, j);
  }
  const auto [j, share] = known_division(light, found.weights.threshold());
  EXPECT_LT(j, 1.15 * least) << found.weights.threshold();
  EXPECT_NEAR(found.share, share, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Lights, AllocationOf,
                         testing::Values(Light{0.1, 10}, Light{0.01, 100}, Light{0.003, 1000}),
                         [](const auto& info) {
                           return std::to_string(static_cast<int>(info.param.brightness));
                         });

/// Lamps are left to samples whatever the division is.
TEST(Allocation, DoesNotDependOnLampsThatAreSeen) {
  const auto share = [](const Light& light) {
    KnownAlgorithm algorithm(make_scene("cornell").scene, light);
    const CoarseImage coarse =
        coarse_image(algorithm, algorithm.scene().camera().raster(), 1, 20000, 1, never_cancelled);
    return allocate(algorithm, coarse, {1, 1, 20000, {}, {}}, never_cancelled).share;
  };
  EXPECT_EQ(share({0.01, 100, 1e4}), share({0.01, 100}));
}

/// All parts of a pilot draw something, so that it need not be thrown away.
TEST(Allocation, IsFoundByFewSamplesIfItIsLate) {
  KnownAlgorithm algorithm(make_scene("cornell").scene, {0.1, 10});
  const std::atomic<bool> late{true};
  const CoarseImage coarse =
      coarse_image(algorithm, algorithm.scene().camera().raster(), 1, 20000, 1, late);
  EXPECT_EQ(coarse.drawn, 128);
  const Allocation found = allocate(algorithm, coarse, {1, 1, 20000, {}, {}}, late);
  EXPECT_GT(found.share, 0.05);
  EXPECT_LT(found.share, 0.95);
}

Allocation allocation_of(const std::string& scene, uint64_t seed) {
  MltSettings settings;
  settings.rules.max_depth = 8;
  settings.mixture = {{"lens", 1}};
  const auto algorithm = mlt_algorithm(make_scene(scene).scene, settings);
  algorithm->learn(std::numeric_limits<double>::infinity());
  const CoarseImage coarse = coarse_image(*algorithm, algorithm->scene().camera().raster(), seed,
                                          16000, 1, never_cancelled);
  algorithm->prepare(coarse, seed, 1, never_cancelled);
  return allocate(*algorithm, coarse, {seed, 1, 8000, {}, SampleTechniques::path_tracing},
                  never_cancelled);
}

/// Scenes in which tours have much to do: elsewhere J is flat.
class AllocationsIn : public testing::TestWithParam<std::string> {};

TEST_P(AllocationsIn, AreAlikeForAllSeeds) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int seed = 0; seed < 16; ++seed) {
    const Allocation one = allocation_of(GetParam(), seed);
    least = std::min(least, one.weights.threshold() / one.brightness);
    most = std::max(most, one.weights.threshold() / one.brightness);
    // A step is at most as bright as the brightest sample, and there are not more starts than four.
    EXPECT_LE(one.kappa0, 4 * one.weights.threshold() / 3);
  }
  EXPECT_LE(most, 4 * least);
}

INSTANTIATE_TEST_SUITE_P(Scenes, AllocationsIn,
                         testing::Values("glass_torus", "mirrors", "near_specular", "point_caustic",
                                         "moving_lamp", "window_caustic"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace mlt::test
