// Chains and independent samples see the same T / P of a path, so that their weights sum to one.
#include "integrator/family_taker.h"
#include "integrator/family_weights.h"
#include "integrator/traced_source.h"
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

/// With a map that tells regions apart.
PathTarget target_of(const TestScene& made) {
  PathTarget target(made.scene, {8});
  TargetMap map = blank_image(made.scene->camera().raster());
  map.add({3, 4}, 1);
  map.finish();
  target.set_map(map);
  return target;
}

double median(std::vector<double>& values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

class TargetOverDensity : public testing::TestWithParam<std::string> {};

TEST_P(TargetOverDensity, IsTheSameForSamplesAndChains) {
  const TestScene made = make_mutation_scene(GetParam());
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

TEST_P(TargetOverDensity, IsTheSameForSamplesOfPathTracingAndChains) {
  const TestScene made = make_mutation_scene(GetParam());
  PathTarget target = target_of(made);
  target.set_techniques(SampleTechniques::path_tracing);
  const Scene& scene = *made.scene;
  TracedSource source(target);
  PathState x;
  std::vector<double> errors;
  int roulette = 0;
  RayCounts rays;
  for (uint64_t i = 0; i < 20000; ++i) {
    Rng rng(1, Purpose::test, i);
    RandomSampler sampler(rng);
    const Vec2 raster = scene.camera().raster().sample(sampler.next2());
    Rng again = rng;
    const std::vector<FoundLight>& found = source.sample(raster, sampler);
    RandomSampler same(again);
    const auto [lens, ray] = leave_lens(scene.camera(), raster, same);
    std::vector<FoundPath> paths;
    trace_path(scene, target.rules(), ray, same, rays,
               PathRecorder(scene, raster, lens.at, ray.time, paths));
    ASSERT_EQ(found.size(), paths.size());
    for (size_t k = 0; k < found.size(); ++k) {
      x.path = paths[k].path;
      target.evaluate(x);
      if (!(x.target > 0)) continue;  // as above
      errors.push_back(std::abs(found[k].target_over_density / target.over_density(x) - 1));
      roulette += x.edges() > 6;
    }
  }
  if (errors.empty()) GTEST_SKIP() << "path tracing finds no light here";
  EXPECT_LT(median(errors), 1e-6);
  if (GetParam() == "cornell") {
    EXPECT_GT(roulette, 0);
  }
}

template <class MakeTaker>
std::unique_ptr<SampledRendering> shown_by(const ScenePtr& scene, MakeTaker&& make_taker) {
  auto rendering = std::make_unique<SampledRendering>(scene, 3, SampledSettings{true}, make_taker);
  const std::atomic<bool> cancelled{false};
  rendering->prepare(1, cancelled);
  for (uint64_t unit = 0; unit < rendering->plan().unit_count(4); ++unit) rendering->run_unit(unit);
  return rendering;
}

TEST(TracedTaker, ShowsWhatItsSourceFindsWithTheWeightsOfSamples) {
  const TestScene made = make_mutation_scene("cornell");
  const PathTarget target = target_of(made);
  struct Traced : MetropolisAlgorithm {
    explicit Traced(const PathTarget& t) : target(t) {}
    const Scene& scene() const override { return target.scene(); }
    std::unique_ptr<Source> source() const override {
      return std::make_unique<TracedSource>(target);
    }
    std::unique_ptr<RenderChain> start(const ChainId&, Rng, Rng) const override { return nullptr; }
    std::unique_ptr<RenderChain> blank(const ChainId&) const override { return nullptr; }
    std::vector<MutationStats> rows() const override { return {}; }
    const PathTarget& target;
  };
  const Traced algorithm(target);
  const FamilyWeights weights(0.3);
  const auto one_by_one = shown_by(
      made.scene, [&](const Scene&) { return std::make_unique<FamilyTaker>(algorithm, weights); });
  const auto side_by_side = shown_by(
      made.scene, [&](const Scene&) { return std::make_unique<TracedTaker>(target, weights); });
  const double brightness = one_by_one->mean_brightness().mean;
  EXPECT_GT(one_by_one->mean_of_chains().mean, 0.1 * brightness);
  EXPECT_LT(one_by_one->mean_of_chains().mean, 0.9 * brightness);
  const Image a = one_by_one->image(), b = side_by_side->image();
  double difference = 0, sum = 0;
  for (size_t i = 0; i < a.data.size(); ++i) {
    difference += std::abs(b.data[i] - a.data[i]);
    sum += a.data[i];
  }
  EXPECT_LT(difference, 0.01 * sum);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TargetOverDensity, testing::ValuesIn(mutation_scene_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace mlt::test
