// The step of multiplexed Metropolis light transport leaves its target unchanged; a technique makes
// the same path from the same numbers, whether it is alone or one of all.
#include "primary/multiplexed_step.h"

#include <gtest/gtest.h>

#include "harness/chi_square.h"
#include "markov/lecture_examples.h"
#include "primary/invert_path.h"
#include "scenes.h"

namespace mlt {
namespace {

using namespace test;

constexpr double alpha = 1e-5;

PathRules rules_of(int max_depth, int rr_depth = PathRules::no_roulette) {
  PathRules rules;
  rules.max_depth = max_depth;
  rules.rr_depth = rr_depth;
  return rules;
}
MultiplexedPaths paths_of(const Scene& scene, int max_depth) {
  return {&scene, {scene, {rules_of(max_depth)}}, {}};
}

// ---- the numbers of one technique

class TechniqueNumbersOn : public testing::TestWithParam<std::string> {};

TEST_P(TechniqueNumbersOn, MakeThePathThatItHasFoundAmongAll) {
  const ScenePtr scene = make_scene(GetParam()).scene;
  const bool one_sky = scene->infinite_emitters().size() < 2;
  MultiplexedPaths alone = paths_of(*scene, 5);
  int found = 0;
  for (const int rr_depth : {PathRules::no_roulette, 2}) {
    const PathRules rules = rules_of(5, rr_depth);
    BidirectionalSampler all(*scene, {rules});
    for (int i = 0; i < 200; ++i) {
      Rng rng(61, Purpose::test, i);
      PrimarySamples drawn;
      PrimarySampler sampler(nullptr, drawn, {}, rng);
      RayCounts rays;
      all.sample(scene->camera().raster().sample(sampler.next2()), sampler, rays);
      all.connect_all(rays, [&](const Connection& c) {
        if (c.s == 0 && !one_sky) return;  // One of them is chosen by a further number.
        MultiplexedState state;
        state.technique = {c.s, c.t};
        alone.make_from(numbers_of(state.technique, drawn), state, rng);
        ++found;
        EXPECT_EQ(state.raster.x, c.raster.x) << c.s << ", " << c.t;
        EXPECT_EQ(state.raster.y, c.raster.y) << c.s << ", " << c.t;
        if (rr_depth != PathRules::no_roulette) return;  // f / p has another p.
        EXPECT_NEAR(state.target / target_luminance(c.contribution * c.weight), 1, 1e-12);
        EXPECT_NEAR(state.target_over_density / (target_luminance(c.contribution) * c.own_share), 1,
                    1e-12);
      });
    }
  }
  EXPECT_GT(found, 300);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TechniqueNumbersOn,
                         testing::Values("cornell", "caustic", "mixed_lights", "thin_lens_sky",
                                         "light_in_glass"));

// ---- the numbers of another technique

class InvertPathOn : public testing::TestWithParam<std::string> {};

/// Every technique that can make a path makes it again from the numbers that inversion gives.
TEST_P(InvertPathOn, GivesNumbersOfEveryTechniqueThatCanMakeThePath) {
  const ScenePtr scene = make_scene(GetParam()).scene;
  MultiplexedPaths alone = paths_of(*scene, 5);
  BidirectionalSampler all(*scene, {rules_of(5)});
  int found = 0, lost = 0, changed = 0;
  for (int i = 0; i < 150; ++i) {
    Rng rng(64, Purpose::test, i);
    RandomSampler sampler(rng);
    RayCounts rays;
    all.sample(scene->camera().raster().sample(sampler.next2()), sampler, rays);
    all.connect_all(rays, [&](const Connection& c) {
      Path path;
      all.assemble(c, path);
      PathTerms terms;
      compute_terms(*scene, path, {}, terms);
      const double expected = target_luminance(c.contribution) * c.own_share;
      for (int s = 0; s <= c.s + c.t; ++s) {
        if (!(mis_weight(terms, s, Heuristic::power) > 1e-12)) continue;
        MultiplexedState state;
        state.technique = {s, c.s + c.t - s};
        ++found;
        changed += s != c.s;
        PrimarySamples inverted;
        if (!invert_path(*scene, path, state.technique, rng, inverted)) {
          ++lost;
          continue;
        }
        alone.make_from(inverted, state, rng);
        const bool same = std::abs(state.target_over_density / expected - 1) < 0.01 &&
                          glm::length(state.raster - c.raster) < 0.05;
        lost += !same;
      }
    });
  }
  EXPECT_GT(found, 200);
  EXPECT_GT(changed, 50);
  // Grazing directions and silhouettes, where rounding decides whether vertices see each other.
  EXPECT_LE(lost, 0.005 * found);
}

INSTANTIATE_TEST_SUITE_P(Scenes, InvertPathOn,
                         testing::Values("cornell", "caustic", "mixed_lights", "thin_lens_sky",
                                         "light_in_glass", "sky_map", "sun", "point", "spot",
                                         "projector", "sphere_light", "smooth_normals", "materials",
                                         "more_materials", "bent_normals", "instances",
                                         "orthographic", "spherical", "fisheye", "daylight",
                                         "windows", "null_surface", "fog", "smoke_box", "smoke",
                                         "fire"));

// ---- the choice of a technique

TEST(TechniqueChoice, HasTheProbabilitiesThatItTells) {
  PathRules unbounded = rules_of(-1);
  unbounded.hide_emitters = true;
  for (const PathRules& rules : {rules_of(4), unbounded, rules_of(std::numeric_limits<int>::max())})
    for (const bool learned : {false, true}) {
      TechniqueChoice choice(rules);
      if (learned) choice.learn({{}, {0, 0, 0}, {0, 3, 1, 0}, {0, 0, 0, 0, 0}, {1, 0, 0, 0, 0, 1}});
      constexpr int n = 100'000, longest = 12;
      std::vector<double> observed(longest * longest), expected(longest * longest);
      Rng rng(62, Purpose::test, learned);
      for (int i = 0; i < n; ++i) {
        const double u = rng.next();
        const Technique drawn = choice.sample_technique(choice.sample_length(u), rng.next());
        ASSERT_TRUE(rules.wants(drawn.edges()) || drawn.edges() > 4);
        ASSERT_LT(drawn.edges(), 1000);
        if (drawn.edges() < longest - 2) observed[drawn.edges() * longest + drawn.s] += 1;
      }
      double sum = 0;
      for (int k = 1; k < longest - 2; ++k)
        for (int s = 0; s <= k + 1; ++s) {
          const double p = choice.pdf_length(k) * choice.pdf_technique({s, k + 1 - s});
          expected[k * longest + s] = n * p;
          sum += p;
        }
      observed[0] = n - std::accumulate(observed.begin(), observed.end(), 0.0);
      expected[0] = n * (1 - sum);
      if (expected[0] < 1e-6) observed[0] = expected[0] = 0;
      EXPECT_GT(chi_square_counts(observed, expected).p_value, alpha);
    }
}

// ---- one step

std::vector<double> observe(const MultiplexedState& x, const Raster& raster) {
  const Vec2 u = raster.invert(x.raster);
  const auto [s, t] = x.technique;
  return {u.x,
          u.y,
          u.x < 0.3 ? 1. : 0.,
          std::log(x.target),
          s == 0 ? 1. : 0.,
          s == 1 ? 1. : 0.,
          t == 1 ? 1. : 0.,
          static_cast<double>(s),
          static_cast<double>(x.technique.edges()),
          x.technique.edges() == 2 ? 1. : 0.,
          x.target_over_density / (1 + x.target_over_density)};
}

constexpr double rounding = 1e-4;  ///< Of a path that is kept, made again from inverted numbers.

/// What a step has done to the mean of a function. Where the path is kept little changes, and a
/// t-test needs many changes: many small ones one way may wait for a few large ones the other way.
struct Changes {
  Moments changes;
  double size = 0, size_squared = 0, largest = 0;

  void add(double change) {
    changes.add(change);
    size += std::abs(change);
    size_squared += sqr(change);
    largest = std::max(largest, std::abs(change));
  }
  bool enough() const {
    constexpr double least_effective_changes = 100;
    return sqr(size) > least_effective_changes * size_squared &&
           size > least_effective_changes * largest;
  }
};

/// E[w c (g(y) - g(x))] = 0 for one step x -> y, for all g, if it is reversible: c, the same for
/// both directions, keeps few states with great weights w from outweighing all others. `spoil` may
/// change the quotients.
template <class Spoil>
double invariance_p_value(const std::string& name, double large, double technique,
                          TechniqueChange change, int steps, Spoil spoil, bool delayed = false) {
  const ScenePtr scene = make_scene(name).scene;
  TechniqueChoice choice(rules_of(4));
  choice.learn({{}, {1, 0, 0}, {1, 3, 1, 0}, {1, 2, 2, 1, 0}, {1, 2, 2, 2, 1, 0}});
  MultiplexedPaths paths = paths_of(*scene, 4);
  struct Kernel {
    MultiplexedStep step;
    Spoil spoil;
    Transition propose(const MultiplexedState& x, std::array<MultiplexedState, 2>& y, size_t stage,
                       Rng& rng) {
      const Transition t = step.propose(x, y, stage, rng);
      return stage == 0 && MultiplexedStep::generated(y[0]) ? spoil(t, x, y[0]) : t;
    }
  } kernel{{{large, technique, change, delayed}, paths, choice}, spoil};
  const auto weight_of = [&](const MultiplexedState& x) {
    return x.target / (choice.pdf_length(x.technique.edges()) * choice.pdf_technique(x.technique));
  };
  constexpr double great_weight = 10;
  std::vector<Changes> differences;
  int accepted = 0;
  Rng rng(63, Purpose::test, 0);
  for (int i = 0; i < 300'000; ++i) {
    MultiplexedState x;
    const double u = rng.next();
    x.technique = choice.sample_technique(choice.sample_length(u), rng.next());
    paths(nullptr, x, rng);
    if (!(x.target > 0)) continue;
    const double weight = weight_of(x);
    std::array<MultiplexedState, 2> y;
    const std::vector<double> before = observe(x, scene->camera().raster());
    for (int k = 0; k < steps; ++k)
      accepted += metropolis_step(x, y, kernel, rng, forget).accepted >= 0;
    const std::vector<double> after = observe(x, scene->camera().raster());
    const double damped = weight * std::min(1.0, great_weight / std::max(weight, weight_of(x)));
    differences.resize(before.size());
    for (size_t k = 0; k < before.size(); ++k) {
      const double difference = after[k] - before[k];
      differences[k].add(std::abs(difference) < rounding ? 0 : damped * difference);
    }
  }
  EXPECT_GT(accepted, 1000);
  std::vector<Moments> tested;
  for (const Changes& difference : differences)
    if (change == TechniqueChange::keeps_numbers || difference.enough())
      tested.push_back(difference.changes);
  if (tested.empty()) return 1;
  return smallest_p_value(tested, std::vector<double>(tested.size(), 0.0));
}

constexpr auto right = [](const Transition& t, auto&, auto&) { return t; };

TEST(MultiplexedStep, LeavesItsTargetUnchanged) {
  for (const char* scene : {"cornell", "mixed_lights", "thin_lens_sky"})
    for (const auto& [large, technique] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {0.3, 0.3}})
      EXPECT_GT(
          invariance_p_value(scene, large, technique, TechniqueChange::keeps_numbers, 1, right),
          alpha)
          << scene << ", " << large << ", " << technique;
}

/// Numbers of a technique wait for its next turn, and then make paths again.
TEST(MultiplexedStep, LeavesItsTargetUnchangedOverSeveralSteps) {
  for (const char* scene : {"cornell", "mixed_lights", "thin_lens_sky"})
    EXPECT_GT(invariance_p_value(scene, 0.1, 0.5, TechniqueChange::keeps_numbers, 6, right), alpha)
        << scene;
}

TEST(MultiplexedStep, LeavesItsTargetUnchangedWithDelayedRejection) {
  for (const char* scene : {"cornell", "mixed_lights"})
    EXPECT_GT(invariance_p_value(scene, 0.8, 0.1, TechniqueChange::keeps_numbers, 1, right, true),
              alpha)
        << scene;
}

TEST(MultiplexedStep, LeavesItsTargetUnchangedWhereItKeepsThePath) {
  for (const char* scene : {"cornell", "mixed_lights", "thin_lens_sky", "materials"})
    for (const auto& [technique, steps] : {std::pair{1.0, 1}, {0.5, 3}})
      EXPECT_GT(invariance_p_value(scene, 0, technique, TechniqueChange::keeps_path, steps, right),
                alpha)
          << scene << ", " << technique;
}

TEST(MultiplexedStep, ThatKeepsThePathButAsksWhetherToIsFound) {
  // As if the technique had been drawn from equal ones and not by its weight.
  const auto wrong = [](const Transition& t, const MultiplexedState& x, const MultiplexedState& y) {
    return Transition{t.forward * x.target, t.backward * y.target};
  };
  EXPECT_LT(invariance_p_value("cornell", 0, 1, TechniqueChange::keeps_path, 1, wrong), alpha);
}

TEST(MultiplexedStep, ThatForgetsHowOftenTechniquesAreChosenIsFound) {
  const auto forgets = [](const Transition&, const MultiplexedState& x, const MultiplexedState& y) {
    return Transition{1 / y.target, 1 / x.target};
  };
  for (const auto& [large, technique] : {std::pair{1.0, 0.0}, {0.0, 1.0}})
    EXPECT_LT(
        invariance_p_value("cornell", large, technique, TechniqueChange::keeps_numbers, 1, forgets),
        alpha);
}

}  // namespace
}  // namespace mlt
