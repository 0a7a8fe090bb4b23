// Chains and independent samples see the same T / P of a path, so that their weights sum to one.
#include "harness/statistics.h"
#include "integrator/path_samples.h"
#include "markov/clamping_weights.h"
#include "mutation/path_seeds.h"
#include "rendering/beside_chains.h"
#include "scenes.h"
#include "wave/bidirectional_wave.h"
#include "wave/path_sample_wave.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mlt::test {
namespace {

TEST(ClampingWeights, SumToOne) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double even : {0.0, 1e-3, 1.0, 1e5})
    for (const double q : {1e-8, 0.3, 7.0, 1e12, infinity}) {
      const ClampingWeights weights(even);
      EXPECT_NEAR(weights.of_sample(q) + weights.of_chain(q), 1, 1e-14) << even << " " << q;
    }
}

/// Clamped samples are no brighter than c, and what is cut off is T' = max(0, T - c P).
TEST(ClampingWeights, ClampSamples) {
  const ClampingWeights weights(2);
  for (const double tau : {0.5, 2.0, 3.0, 1e9}) {
    EXPECT_NEAR(tau * weights.of_sample(tau), std::min(tau, 2.0), 1e-6 * tau);
    EXPECT_NEAR(tau * weights.of_chain(tau), std::max(0.0, tau - 2), 1e-6 * tau);
  }
}

TEST(ClampingWeights, AreNumbersWhereThereIsNoTarget) {
  for (const double even : {0.0, 1.0}) EXPECT_EQ(ClampingWeights(even).of_chain(0), 0);
}

/// With a map that tells regions apart, and lights that are seen from light that is scattered.
PathTarget target_of(const TestScene& made) {
  PathRules rules{8};
  rules.through_boundaries = true;
  PathTarget target(made.scene, rules);
  TargetMap map = blank_image(made.scene->camera().raster());
  map.add({3, 4}, 1);
  map.add({6, 2}, 2, 1);
  map.finish();
  target.set_map(map);
  return target;
}

void leave_certain_light(PathTarget& target) {
  const std::atomic<bool> cancelled{false};
  target.leave_to_samples({target.scene(), target.rules(), 4000, 1, 1, cancelled});
}

double median(std::vector<double>& values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

class TargetOverDensity : public testing::TestWithParam<std::string> {};

TEST_P(TargetOverDensity, IsTheSameForSamplesAndChains) {
  const TestScene made = make_scene(GetParam());
  const PathTarget target = target_of(made);
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
      errors.push_back(std::abs(q / target.over_density(x) - 1));
      roulette += x.edges() > 6;
    });
  ASSERT_GT(errors.size(), 1000u);
  // The directions between points that were rounded are not quite those that were sampled, which
  // nearly specular BSDFs magnify.
  EXPECT_LT(median(errors), 1e-6);
  if (GetParam() == "cornell") {
    EXPECT_GT(roulette, 0);
  }
}

/// Records the certainty of each path, too.
struct CertaintyRecorder : PathRecorder {
  CertaintyRecorder(const PathRecorder& paths, std::vector<double>& found)
      : PathRecorder(paths), certainties(&found) {}
  double find(const CameraWalk&, const Color& radiance, double certainty) {
    if (target_luminance(radiance) > 0) certainties->push_back(certainty);
    return 1;
  }
  std::vector<double>* certainties;
};

TEST_P(TargetOverDensity, IsTheSameForSamplesOfPathTracingAndChains) {
  const TestScene made = make_scene(GetParam());
  PathTarget target = target_of(made);
  target.set_techniques(SampleTechniques::path_tracing);
  const Scene& scene = *made.scene;
  const auto source = path_samples(target);
  PathState x;
  std::vector<double> errors, certainties;
  int roulette = 0, wrong = 0;
  RayCounts rays;
  for (uint64_t i = 0; i < 20000; ++i) {
    Rng rng(1, Purpose::test, i);
    RandomSampler sampler(rng);
    const Vec2 raster = scene.camera().raster().sample(sampler.next2());
    Rng again = rng;
    const std::vector<FoundLight>& found = source->sample(raster, sampler);
    RandomSampler same(again);
    const auto [lens, ray] = camera_ray(scene.camera(), raster, same);
    std::vector<FoundPath> paths;
    certainties.clear();
    CameraWalk walk(ray);
    walk.certainty = 1;
    trace_path(scene, target.rules(), walk, same, rays,
               CertaintyRecorder({raster, lens.at, ray.time, paths}, certainties));
    ASSERT_EQ(found.size(), paths.size());
    ASSERT_EQ(found.size(), certainties.size());
    for (size_t k = 0; k < found.size(); ++k) {
      x.path = paths[k].path;
      target.evaluate(x);
      if (!(x.target > 0)) continue;  // as above
      errors.push_back(std::abs(found[k].target_over_density / target.over_density(x) - 1));
      wrong += !(std::abs(certainty(x.terms) - certainties[k]) <= 1e-3 * certainties[k]);
      roulette += x.edges() > 6;
    }
  }
  if (errors.empty()) GTEST_SKIP() << "path tracing finds no light here";
  const auto differs = [](double error) { return !(error < 0.01); };
  EXPECT_LE(std::count_if(errors.begin(), errors.end(), differs), errors.size() / 500);
  EXPECT_LT(median(errors), 1e-6);
  EXPECT_LE(wrong, errors.size() / 1000);
  if (GetParam() == "cornell") {
    EXPECT_GT(roulette, 0);
  }
}

/// Samples of either kind and chains agree on which paths are left to the samples.
TEST_P(TargetOverDensity, IsZeroForTheSameCertainPaths) {
  const TestScene made = make_scene(GetParam());
  PathTarget target = target_of(made);
  leave_certain_light(target);
  PathSeeds seeds(target);
  PathState x;
  int all = 0, wrong = 0;
  std::vector<double> errors;
  Moments left, left_by_tracing;
  for (uint64_t i = 0; i < 4000; ++i) {
    Rng rng(2, Purpose::test, i);
    double sum = 0;
    seeds.draw(RandomSampler(rng), [&](const Connection& c, double weight) {
      seeds.assemble(c, x);
      errors.push_back(std::abs(c.certainty - certainty(x.terms)));
      ++all;
      wrong += (weight == 0) != (certainty(x.terms) > target.most_certain(c.raster));
      if (weight == 0) sum += target_luminance(c.contribution) * c.weight;
    });
    left.add(sum);
  }
  EXPECT_LT(median(errors), 1e-6);
  EXPECT_LE(wrong, all / 1000) << "of " << all;

  target.set_techniques(SampleTechniques::path_tracing);
  const auto source = path_samples(target);
  for (uint64_t i = 4000; i < 8000; ++i) {
    Rng rng(2, Purpose::test, i);
    RandomSampler sampler(rng);
    const Vec2 raster = made.scene->camera().raster().sample(sampler.next2());
    double sum = 0;
    for (const FoundLight& found : source->sample(raster, sampler))
      if (found.weight == 0) sum += target_luminance(found.rgb);
    left_by_tracing.add(sum);
  }
  if (GetParam() == "cornell") {
    EXPECT_GT(left.mean(), 0);
  }
  EXPECT_GT(welch_t_test(left, left_by_tracing).p_value, 1e-4)
      << left.mean() << " " << left_by_tracing.mean();
}

template <class MakeTaker>
std::unique_ptr<SampledRendering> shown_by(const ScenePtr& scene, MakeTaker&& make_taker) {
  auto rendering = std::make_unique<SampledRendering>(scene, 3, SampledSettings{true}, make_taker);
  const std::atomic<bool> cancelled{false};
  rendering->prepare(1, cancelled);
  for (uint64_t unit = 0; unit < rendering->plan().unit_count(4); ++unit) rendering->run_unit(unit);
  return rendering;
}

/// Samples that are taken one by one and side by side show the same, about half of the light.
template <class OneByOne, class SideBySide>
void expect_the_same(const ScenePtr& scene, OneByOne&& one_by_one, SideBySide&& side_by_side) {
  const auto expected = shown_by(scene, one_by_one);
  const double brightness = expected->mean_brightness().mean;
  EXPECT_GT(expected->mean_of_chains().mean, 0.1 * brightness);
  EXPECT_LT(expected->mean_of_chains().mean, 0.9 * brightness);
  const Image a = expected->image(), b = shown_by(scene, side_by_side)->image();
  double difference = 0, sum = 0;
  for (size_t i = 0; i < a.data.size(); ++i) {
    difference += std::abs(b.data[i] - a.data[i]);
    sum += a.data[i];
  }
  EXPECT_LT(difference, 0.01 * sum);
}

/// Whether certain light is left to the samples.
class PathSampleTaker : public testing::TestWithParam<bool> {
 protected:
  template <class Estimator>
  void compare(PathTarget& target, const Estimator& estimator, const ClampingWeights& weights) {
    if (GetParam()) leave_certain_light(target);
    expect_the_same(
        target.scene_ptr(),
        [&](const Scene& scene) {
          return take_beside_chains(scene, estimator, PathTargeting(target, estimator.own_scale()),
                                    weights);
        },
        [&](const Scene&) { return path_sample_taker(target, weights); });
  }
};

TEST_P(PathSampleTaker, WeightsPathTracingSideBySideAsOneByOne) {
  const TestScene made = make_scene("cornell");
  PathTarget target = target_of(made);
  target.set_techniques(SampleTechniques::path_tracing);
  compare(target, PathEstimator(*made.scene, target.rules(), Heuristic::balance),
          ClampingWeights(0.04));
}

/// With roulette from the first vertex on.
TEST_P(PathSampleTaker, WeightsBidirectionalPathTracingSideBySideAsOneByOne) {
  const TestScene made = make_scene("cornell");
  PathRules rules{8};
  rules.rr_depth = 1;
  PathTarget target(made.scene, rules);
  const BidirectionalSettings settings = PathSeeds::settings(target);
  ASSERT_TRUE(BidirectionalWave::supports(*made.scene, settings));
  compare(target, BidirectionalEstimator(*made.scene, settings), ClampingWeights(0.02));
}

INSTANTIATE_TEST_SUITE_P(CertainPaths, PathSampleTaker, testing::Bool(), [](const auto& info) {
  return info.param ? "LeftToTheSamples" : "LikeOthers";
});

TEST(SamplesOfPssmlt, AreWeightedSideBySideAsOneByOne) {
  const TestScene made = make_scene("cornell");
  const PathRules rules{8};
  const auto taker = [&](const Scene& scene, const ClampingWeights& weights, bool side_by_side) {
    const PathEstimator estimator(scene, rules);
    return take_beside_chains(
        scene, estimator, SampleTargeting(scene, estimator.own_scale(), LargeStepWeights{0.1}),
        weights,
        side_by_side ? std::make_unique<PathSampleWave>(scene, rules, Heuristic::power) : nullptr);
  };
  const ClampingWeights weights(0.3);
  expect_the_same(
      made.scene, [&](const Scene& scene) { return taker(scene, weights, false); },
      [&](const Scene& scene) { return taker(scene, weights, true); });
  // With all the light, it tells the brightness.
  const ClampingWeights all(std::numeric_limits<double>::max());
  const auto shown =
      shown_by(made.scene, [&](const Scene& scene) { return taker(scene, all, true); });
  EXPECT_GT(shown->mean_brightness().mean, 0);
  EXPECT_LT(shown->mean_of_chains().mean, 1e-100);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TargetOverDensity, testing::ValuesIn(mutation_scene_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace mlt::test
