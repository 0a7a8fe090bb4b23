// Chains of pssmlt over path tracing: their numbers, the walks that these make side by side, and
// the step of each chain. The invariance test is that of test_primary_step.cpp.
#include <gtest/gtest.h>

#include "harness/chi_square.h"
#include "markov/lecture_examples.h"
#include "scenes.h"
#include "wave/walk_step.h"

namespace mlt {
namespace {

using namespace test;

constexpr double alpha_of_walks = 1e-5;

// ---- numbers

TEST(SmallStep, IsAsLongAsItsExponentialSays) {
  const SmallStep step;
  for (double sample = 0; sample < 1; sample += 1. / 1024) {
    const double t = sample < 0.5 ? 2 * sample : 2 * sample - 1;
    const double move = step.size * std::pow(SmallStep::smallest_share, t);
    EXPECT_NEAR(std::abs(step.kelemen(0.5, sample) - 0.5), move, 1e-12 * move + 1e-16) << sample;
  }
}

TEST(NumberRows, AreTheSameInWhateverPlace) {
  for (const auto shape : {SmallStep::Shape::kelemen, SmallStep::Shape::gaussian}) {
    const SmallStep step{shape, 1. / 32};
    std::vector<double> x(12);
    for (const double u : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.75, 1 - 0x1p-53}) x.push_back(u);
    const std::vector<double> part(x.begin(), x.begin() + 15);
    NumberRows alone, together;
    const std::vector<double>* const sources[] = {nullptr, &part, &x};
    for (const std::vector<double>* from : sources) {
      alone.begin(12);
      const int a = alone.add(77, from);
      alone.draw(step);
      together.begin(12);
      for (int i = 0; i < 5; ++i) together.add(i, i % 2 ? &x : nullptr);
      const int b = together.add(77, from);
      while (together.size() < NumberRows::capacity) together.add(together.size(), &x);
      together.draw(step);
      for (size_t k = 0; from && k < from->size() - 12; ++k) {
        const double distance = std::abs(alone[a][k] - x[12 + k]);
        if (shape == SmallStep::Shape::kelemen)
          EXPECT_LE(std::min(distance, 1 - distance), step.size);
      }
      for (int k = 0; k < NumberRows::row; ++k) {
        EXPECT_EQ(alone[a][k], together[b][k]);
        EXPECT_GE(alone[a][k], 0);
        EXPECT_LT(alone[a][k], 1);
      }
    }
  }
}

TEST(NumberRows, AreUniformAndDifferForEachKeyAndPlace) {
  std::vector<double> cells(256), pairs(256);
  NumberRows rows;
  double before = 0;
  int count = 0;
  for (uint64_t key = 0; key < 4096; ++key) {
    rows.begin(5 + 7 * (key % 3));
    const int i = rows.add(mix_bits(key), nullptr);
    rows.draw({});
    for (int k = 0; k < NumberRows::row; ++k, ++count) {
      const double u = rows[i][k];
      cells[static_cast<size_t>(256 * u)] += 1;
      pairs[16 * static_cast<size_t>(16 * before) + static_cast<size_t>(16 * u)] += 1;
      before = u;
    }
  }
  const std::vector<double> expected(256, count / 256.);
  EXPECT_GT(chi_square_counts(cells, expected).p_value, alpha_of_walks);
  EXPECT_GT(chi_square_counts(pairs, expected).p_value, alpha_of_walks);
}

// ---- walks

const std::vector<double>& numbers_of(const PrimaryState& x) { return x.numbers[Stream::camera]; }

/// Reads the numbers of a walk.
struct WalkReader {
  const std::vector<double>& numbers;
  size_t used = 0;

  void begin(Stream) {}
  double next() {
    EXPECT_LT(used, numbers.size());
    return numbers[used++];
  }
  Vec2 next2() {
    const double x = next();
    return {x, next()};
  }
};

/// What a sampler's numbers show.
template <class Sampler>
PrimaryState walk_of(const Scene& scene, const PathRules& rules, Sampler&& sampler) {
  PrimaryState x;
  RayCounts rays;
  const Raster& image = scene.camera().raster();
  const Vec2 raster = image.sample(sampler.next2());
  const Ray ray = camera_ray(scene.camera(), raster, sampler).ray;
  const Color radiance = trace_path(scene, rules, ray, sampler, rays);
  if (!is_black(radiance))
    x.light.push_back({raster, radiance * (image.sampled_area() / image.pixels())});
  x.find_target();
  return x;
}

PrimaryState fresh_walk(const Scene& scene, const PathRules& rules, Rng& rng) {
  PrimarySamples numbers;
  PrimaryState x = walk_of(scene, rules, PrimarySampler(nullptr, numbers, {}, rng));
  x.numbers = numbers;
  return x;
}

bool same_up_to_rounding(const PrimaryState& a, const PrimaryState& b) {
  return std::abs(a.target - b.target) <= 1e-3 * (a.target + b.target);
}

class WalkWaveOf : public testing::TestWithParam<std::string> {};

/// A difference in rounding may send a walk past an edge, or end it, but that is rare.
TEST_P(WalkWaveOf, MakesWhatSingleWalksMake) {
  const ScenePtr scene = make_scene(GetParam()).scene;
  const PathRules rules;
  Rng rng(61, Purpose::test, 0);
  WalkWave together(*scene, rules, {}), alone(*scene, rules, {});
  int lit = 0, other_than_single = 0, other_than_alone = 0, all = 0;
  for (int wave = 0; wave < 30; ++wave) {
    std::vector<PrimaryState> x(70), y(70), z(70);  // more than a block
    std::vector<RayCounts> rays(70), rays_alone(70);
    for (size_t i = 0; i < x.size(); ++i) {
      x[i] = fresh_walk(*scene, rules, rng);
      together.add(x[i], i % 4 == 0, 1000 * wave + i, y[i], rays[i]);
    }
    together.trace();
    for (size_t i = 0; i < x.size(); ++i, ++all) {
      alone.add(x[i], i % 4 == 0, 1000 * wave + i, z[i], rays_alone[i]);
      alone.trace();
      const PrimaryState single = walk_of(*scene, rules, WalkReader{numbers_of(y[i])});
      lit += y[i].target > 0;
      other_than_single += !same_up_to_rounding(y[i], single);
      other_than_alone += !same_up_to_rounding(y[i], z[i]) ||
                          numbers_of(y[i]).size() != numbers_of(z[i]).size() ||
                          rays[i].intersect != rays_alone[i].intersect ||
                          rays[i].occluded != rays_alone[i].occluded;
      // A small step moves each number a little.
      for (size_t k = 0;
           i % 4 != 0 && k < std::min(numbers_of(x[i]).size(), numbers_of(y[i]).size()); ++k) {
        const double distance = std::abs(numbers_of(x[i])[k] - numbers_of(y[i])[k]);
        EXPECT_LE(std::min(distance, 1 - distance), 1. / 32 + 1e-15);
      }
    }
  }
  EXPECT_GT(lit, 0);
  EXPECT_LE(other_than_single, all / 200);
  EXPECT_LE(other_than_alone, all / 200);
}

INSTANTIATE_TEST_SUITE_P(Scenes, WalkWaveOf, testing::ValuesIn(scene_names()),
                         [](const auto& info) { return info.param; });

// ---- one step

/// What is observed of a state.
std::vector<double> observe(const PrimaryState& x, const Raster& image) {
  const Vec2 u = image.invert(x.light[0].raster);
  const double* last = numbers_of(x).data() + numbers_of(x).size();
  const double count = static_cast<double>(numbers_of(x).size());
  return {std::cos(2 * pi * u.x),
          std::sin(2 * pi * u.y),
          u.x + u.y < 0.8 ? 1. : 0.,
          count,
          count == 12 ? 1. : 0.,
          count == 19 ? 1. : 0.,
          std::cos(2 * pi * last[-4]),  // of the last direction
          std::sin(2 * pi * last[-5]),
          last[-5],
          numbers_of(x)[5],
          std::log(x.target),
          max_component(x.light[0].rgb) > 2 * x.light[0].rgb.x ? 1. : 0.};
}

struct WalkInvariance {
  double p_value = 0;
  int accepted = 0, longer_or_shorter = 0;
};

/// E[w g(y)] = E[w g(x)] for one step x -> y of each chain of a team, for all g. `Step` may be
/// spoilt.
template <class Step>
WalkInvariance invariance_of(const Step& step, const SmallStep& small_step, int teams = 1500) {
  const ScenePtr scene = make_scene("mixed_lights").scene;
  PathRules rules;
  rules.max_depth = 5;
  WalkWave wave(*scene, rules, small_step);
  WalkInvariance out;
  std::vector<Moments> differences;
  Rng rng(63, Purpose::test, 0);
  for (int team = 0; team < teams; ++team) {
    constexpr size_t size = 40;
    const std::vector<PrimaryState> from(size);
    std::vector<PrimaryState> x(size);
    std::vector<std::array<PrimaryState, 2>> y(size);
    std::vector<Step> steps(size, step);
    std::vector<RayCounts> rays(size);
    for (size_t i = 0; i < size; ++i) wave.add(from[i], true, rng.next_bits(), x[i], rays[i]);
    wave.trace();
    for (size_t stage = 0; stage < 2; ++stage) {
      for (size_t i = 0; i < size; ++i) steps[i].prepare(x[i], y[i], stage, rng, wave);
      wave.trace();
    }
    for (size_t i = 0; i < size; ++i) {
      const double weight = x[i].target;  // the numbers' density is 1
      if (!(weight > 0)) continue;
      const std::vector<double> g = observe(x[i], scene->camera().raster());
      const size_t before = numbers_of(x[i]).size();
      const StepResult result = metropolis_step(x[i], y[i], steps[i], rng, forget);
      EXPECT_FALSE(result.invalid);
      out.accepted += result.accepted >= 0;
      out.longer_or_shorter += numbers_of(x[i]).size() != before;
      const std::vector<double> h = observe(x[i], scene->camera().raster());
      differences.resize(g.size());
      for (size_t k = 0; k < g.size(); ++k) differences[k].add(weight * (h[k] - g[k]));
    }
  }
  out.p_value = smallest_p_value(differences, std::vector<double>(differences.size(), 0.0));
  return out;
}

TEST(WalkStep, LeavesItsTargetUnchanged) {
  for (const auto& small_step : {SmallStep(), SmallStep{SmallStep::Shape::gaussian, 0.02}})
    for (const double large : {1.0, 0.3, 0.0}) {
      const WalkInvariance result = invariance_of(WalkStep(large, false), small_step);
      EXPECT_GT(result.p_value, alpha_of_walks) << large;
      EXPECT_GT(result.accepted, 10'000) << large;
      EXPECT_GT(result.longer_or_shorter, 1000) << large;
    }
}

TEST(WalkStep, LeavesItsTargetUnchangedWithDelayedRejection) {
  for (const double large : {1.0, 0.4}) {
    const WalkInvariance one = invariance_of(WalkStep(large, false), {});
    const WalkInvariance two = invariance_of(WalkStep(large, true), {});
    EXPECT_GT(two.p_value, alpha_of_walks) << large;
    EXPECT_GT(two.accepted, one.accepted + 2000) << large;
  }
}

/// Numbers as if they were not of density 1.
struct CountsNumbers : WalkStep {
  using WalkStep::WalkStep;
  Transition propose(const PrimaryState& x, const Proposals& y, size_t stage, Rng& rng) const {
    const Transition t = WalkStep::propose(x, y, stage, rng);
    if (stage > 0 || t.backward == 0) return t;
    const auto spoil = [](const PrimaryState& z) { return std::pow(1.05, numbers_of(z).size()); };
    return {t.forward * spoil(y[0]), t.backward * spoil(x)};
  }
};

/// The second stage forgets that the first was rejected.
struct ForgetsRejection : WalkStep {
  using WalkStep::WalkStep;
  Transition propose(const PrimaryState& x, const Proposals& y, size_t stage, Rng& rng) const {
    const Transition t = WalkStep::propose(x, y, stage, rng);
    if (stage == 0 || t.backward == 0) return t;
    return {1 / y[1].target, 1 / x.target};
  }
};

TEST(WalkStep, WithAWrongQuotientIsFound) {
  EXPECT_LT(invariance_of(CountsNumbers(0.3, false), {}).p_value, alpha_of_walks);
  const SmallStep wide{SmallStep::Shape::gaussian, 0.2};
  EXPECT_LT(invariance_of(ForgetsRejection(1, true), wide, 6000).p_value, alpha_of_walks);
}

}  // namespace
}  // namespace mlt
