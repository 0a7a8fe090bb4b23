// The terms of paths that each technique makes on each test scene: contributions, densities and
// weights as the walks cache them, as PathTerms computes them, and as a second implementation does.
#include <gtest/gtest.h>

#include <set>

#include "path_testing.h"

namespace mlt {
namespace {

using namespace test;

constexpr int max_depth = 7, samples = 800;

struct Variant {
  std::string name;
  bool light_image = true, sample_direct = true;
  Heuristic heuristic = Heuristic::power;
  bool strict_normals = false;
};

std::vector<Variant> variants() {
  return {{"all", true, true, Heuristic::power},
          {"no_light_image", false, true, Heuristic::balance},
          {"no_sample_direct", true, false, Heuristic::maximum},
          {"only_walks", false, false, Heuristic::power, true}};
}

BidirectionalSettings settings_of(const Variant& variant) {
  BidirectionalSettings settings = without_roulette(max_depth);
  settings.light_image = variant.light_image;
  settings.sample_direct = variant.sample_direct;
  settings.heuristic = variant.heuristic;
  settings.rules.strict_normals = variant.strict_normals;
  return settings;
}

class PathsOf : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { scene_ = make_scene(GetParam()).scene; }

  /// Calls found(connection, path, terms, settings) for paths of all variants. Rays that graze an
  /// edge may disagree with what the vertices alone see, since they start elsewhere: such paths are
  /// left out.
  template <class Found>
  void for_all(uint64_t seed, Found&& found) {
    for (const Variant& variant : variants()) {
      const BidirectionalSettings settings = settings_of(variant);
      PathTerms terms;
      int paths = 0, hidden = 0;
      for_each_path(*scene_, settings, seed, samples,
                    [&](const Connection& connection, const Path& path) {
                      ++paths;
                      hidden += !is_free(path);
                      if (!is_free(path)) return;
                      compute_terms(*scene_, path,
                                    {settings.sample_direct, settings.rules.strict_normals}, terms);
                      found(connection, path, terms, settings);
                    });
      EXPECT_GT(paths, samples) << variant.name;
      EXPECT_LE(hidden, 1 + paths / (scene_->has_passages() ? 200 : 2000)) << variant.name;
    }
  }

  bool is_free(const Path& path) const {
    for (int i = 0; i < path.edges(); ++i) {
      const double p = scene_->passage(path[i].at, path[i + 1].at, path.time).probability;
      if (p == 0 || relative_difference(p, naive_passage(*scene_, path, i).probability) > 1e-3)
        return false;
    }
    return true;
  }

  ScenePtr scene_;
};

void expect_same_densities(const PathTerms& a, const PathTerms& b) {
  ASSERT_EQ(a.at.size(), b.at.size());
  for (size_t i = 0; i < a.at.size(); ++i) {
    ASSERT_EQ(a[i].from_light, b[i].from_light);
    ASSERT_EQ(a[i].from_camera, b[i].from_camera);
  }
}

TEST_P(PathsOf, AreAssembledAsTheyWereFound) {
  for_all(1, [&](const Connection& c, const Path& path, const PathTerms&,
                 const BidirectionalSettings& settings) {
    const std::string name = technique_name(*scene_, c, path);
    const int k = path.edges();
    ASSERT_EQ(k, c.s + c.t - 1) << name;
    ASSERT_LE(k, settings.rules.max_depth) << name;
    ASSERT_EQ(path[0].kind, VertexKind::light) << name;
    ASSERT_EQ(path[k].kind, VertexKind::camera) << name;
    for (int i = 1; i < k; ++i) ASSERT_EQ(path[i].kind, VertexKind::inner) << name;
    ASSERT_TRUE(is_finite(c.contribution) && min_component(c.contribution) >= 0) << name;
    ASSERT_FALSE(is_black(c.contribution)) << name;
    ASSERT_TRUE(c.weight > 0 && c.weight <= 1) << name << " has weight " << c.weight;

    const auto raster = raster_position(*scene_, path);
    ASSERT_TRUE(raster) << name;
    ASSERT_LT(glm::length(*raster - c.raster), 1e-3) << name;
  });
}

TEST_P(PathsOf, CarryTheContributionOverTheDensityOfTheirTechnique) {
  Worst worst;
  std::vector<double> all;
  for_all(2, [&](const Connection& c, const Path& path, const PathTerms& terms,
                 const BidirectionalSettings& settings) {
    const auto carried = [&](const Path& x) {
      PathTerms of_x;
      compute_terms(*scene_, x, {settings.sample_direct, settings.rules.strict_normals}, of_x);
      const Color carries = contribution(of_x) / technique_density(of_x, c.s);
      return std::vector<double>{carries.x, carries.y, carries.z};
    };
    const Color expected = contribution(terms) / technique_density(terms, c.s),
                found = c.contribution;
    all.push_back(relative_difference(found, expected));
    worst.add(excess(*scene_, path, carried, {found.x, found.y, found.z}),
              technique_name(*scene_, c, path));
  });
  EXPECT_LT(worst.value, 1) << worst.where;
  std::sort(all.begin(), all.end());
  EXPECT_LT(all[all.size() / 2], 1e-9) << "in half of the paths";
}

TEST_P(PathsOf, HaveTheDensitiesOfThePlugIns) {
  Worst worst, at_deltas;
  // Directions at a delta vertex match each other up to the offset of rays.
  const auto excess_of = [&](const Path& path, const PathTerms& terms, Mirrors mirrors) {
    const auto both = [](const std::vector<double>& a, const std::vector<double>& b) {
      std::vector<double> all = a;
      all.insert(all.end(), b.begin(), b.end());
      return all;
    };
    const auto densities = [&](const Path& x) {
      const NaiveDensities p = naive_densities(*scene_, x, Flaw::none, mirrors);
      return both(p.from_light, p.from_camera);
    };
    std::vector<double> own;
    for (const TermsAt& at : terms.at) own.push_back(at.from_light);
    for (const TermsAt& at : terms.at) own.push_back(at.from_camera);
    return excess(*scene_, path, densities, own);
  };
  for_all(3, [&](const Connection& c, const Path& path, const PathTerms& terms,
                 const BidirectionalSettings& settings) {
    const NaiveDensities naive = naive_densities(*scene_, path);
    bool delta = false;
    for (const Vertex& x : path.vertices) delta = delta || x.delta();
    if (delta) {
      if (!settings.rules.strict_normals)
        at_deltas.add(std::min(excess_of(path, terms, Mirrors::ask_twice),
                               excess_of(path, terms, Mirrors::ask_once)),
                      technique_name(*scene_, c, path));
      return;
    }
    for (int i = 0; i <= path.edges(); ++i) {
      const std::string name = technique_name(*scene_, c, path) + ", vertex " + std::to_string(i);
      // With strict normals a direction may be refused that the BSDF would sample.
      const bool refused_l = settings.rules.strict_normals && terms[i].from_light == 0;
      const bool refused_c = settings.rules.strict_normals && terms[i].from_camera == 0;
      if (!refused_l)
        worst.add(relative_difference(terms[i].from_light, naive.from_light[i]),
                  name + " from the light");
      if (!refused_c)
        worst.add(relative_difference(terms[i].from_camera, naive.from_camera[i]),
                  name + " from the camera");
    }
    const double direct = settings.sample_direct ? naive.direct : naive.from_light[0];
    worst.add(relative_difference(terms.direct, direct),
              technique_name(*scene_, c, path) + ", direct");
  });
  // The reflectance of a pane that is passed depends on the direction of the ray.
  EXPECT_LT(worst.value, scene_->has_passages() ? 1e-4 : 1e-9) << worst.where;
  EXPECT_LT(at_deltas.value, 1) << at_deltas.where;
}

TEST_P(PathsOf, HaveNoDensityForTechniquesThatCannotMakeThem) {
  std::set<std::string> impossible;
  for_all(4, [&](const Connection& c, const Path& path, const PathTerms& terms,
                 const BidirectionalSettings& settings) {
    const int k = path.edges();
    EXPECT_GT(technique_density(terms, c.s), 0) << technique_name(*scene_, c, path);
    BidirectionalSettings all = settings;
    all.light_image = true;  // the terms do not know which techniques an integrator uses
    for (int s = 0; s <= k + 1; ++s) {
      const bool can = naive_can_sample(*scene_, path, s, all);
      ASSERT_EQ(can_sample(terms, s), can) << technique_name(*scene_, c, path) << ", as s = " << s;
      if (can) continue;
      ASSERT_EQ(technique_density(terms, s), 0)
          << technique_name(*scene_, c, path) << ", as s = " << s;
      ASSERT_EQ(mis_weight(terms, s, Heuristic::power), 0);
      impossible.insert(s == 0 ? "light" : s == k + 1 ? "lens" : "delta");
    }
  });
  EXPECT_EQ(impossible.count("lens") > 0, scene_->camera().delta_position());
}

TEST_P(PathsOf, HaveTheWeightsOfPlainProducts) {
  Worst walk, terms_weight, sum_weight;
  for_all(5, [&](const Connection& c, const Path& path, const PathTerms& terms,
                 const BidirectionalSettings& settings) {
    const std::string name = technique_name(*scene_, c, path);
    const int k = path.edges();
    // Against plug-ins that were asked afresh.
    const auto naive = [&](const Path& x) {
      const auto densities = naive_technique_densities(*scene_, x, settings);
      return std::vector<double>{naive_weights(densities, settings.heuristic)[c.s]};
    };
    walk.add(excess(*scene_, path, naive, {c.weight}), name);
    // Products of the densities that the terms hold.
    std::vector<double> from_terms;
    for (int s = 0; s <= k + 1; ++s) from_terms.push_back(technique_density(terms, s));
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power, Heuristic::maximum}) {
      const auto expected = naive_weights(from_terms, heuristic);
      double sum = 0;
      for (int s = 0; s <= k + 1; ++s) {
        const double weight = mis_weight(terms, s, heuristic);
        sum += weight;
        terms_weight.add(std::abs(weight - expected[s]), name + ", as s = " + std::to_string(s));
      }
      sum_weight.add(std::abs(sum - 1), name);
    }
  });
  EXPECT_LT(walk.value, 1) << walk.where;
  EXPECT_LT(terms_weight.value, 1e-9) << terms_weight.where;
  EXPECT_LT(sum_weight.value, 1e-9) << sum_weight.where;
}

TEST_P(PathsOf, AreUpdatedBitForBit) {
  for_all(6, [&](const Connection&, const Path& path, const PathTerms& terms,
                 const BidirectionalSettings& settings) {
    const TermSettings term_settings{settings.sample_direct, settings.rules.strict_normals};
    for (int i = 1; i < path.edges(); ++i) {
      // The vertex moves along its surface, and comes back.
      Path moved = path;
      moved[i].at.p += 0.01 * moved[i].at.shading.s;
      PathTerms updated = terms, afresh;
      update_terms(*scene_, moved, term_settings, i, i, updated);
      compute_terms(*scene_, moved, term_settings, afresh);
      // What a dark path would pass is not found out.
      if (!scene_->has_passages() || !is_black(contribution(afresh)))
        expect_same_densities(updated, afresh);
      for (int j = 0; j < path.edges(); ++j) ASSERT_EQ(updated[j].G, afresh[j].G);
      ASSERT_EQ(updated.direct, afresh.direct);
      ASSERT_EQ(contribution(updated), contribution(afresh));
      update_terms(*scene_, path, term_settings, i, i, updated);
      expect_same_densities(updated, terms);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Scenes, PathsOf, testing::ValuesIn(scene_names()),
                         [](const auto& info) { return info.param; });

// ---- broken twins: what the tests above would find

/// The largest excess of the difference between a weight and that of a naive implementation with a
/// flaw.
double worst_weight(const std::string& scene_name, Flaw flaw) {
  const ScenePtr scene = make_scene(scene_name).scene;
  const BidirectionalSettings settings = without_roulette(max_depth);
  Worst worst;
  for_each_path(*scene, settings, 7, samples, [&](const Connection& c, const Path& path) {
    const auto naive = [&](const Path& x) {
      const auto densities = naive_technique_densities(*scene, x, settings, flaw);
      return std::vector<double>{naive_weights(densities, settings.heuristic)[c.s]};
    };
    worst.add(excess(*scene, path, naive, {c.weight}), technique_name(*scene, c, path));
  });
  return worst.value;
}

TEST(BrokenTwin, ForgetsThatTechniqueOneChoosesTheLight) {
  EXPECT_LT(worst_weight("sphere_light", Flaw::none), 1);
  EXPECT_GT(worst_weight("sphere_light", Flaw::no_direct), 100);
}

TEST(BrokenTwin, ForgetsTheSquareOfTheRefractiveIndex) {
  for (const std::string scene : {"light_under_water", "camera_under_water"}) {
    EXPECT_LT(worst_weight(scene, Flaw::none), 1) << scene;
    EXPECT_GT(worst_weight(scene, Flaw::no_eta), 100) << scene;
  }
}

// ---- what the scenes cover

TEST(TestScenes, TogetherHaveEveryKindOfTechniqueAndVertex) {
  std::set<std::string> seen;
  for (const std::string& name : scene_names()) {
    const ScenePtr scene = make_scene(name).scene;
    for_each_path(*scene, without_roulette(max_depth), 8, 300,
                  [&](const Connection& c, const Path& path) {
                    seen.insert(c.s == 0 ? "s = 0" : c.s == 1 ? "s = 1" : "s > 1");
                    seen.insert(c.t == 0 ? "t = 0" : c.t == 1 ? "t = 1" : "t > 1");
                    if (path[0].at.infinite()) seen.insert("light at infinity");
                    for (int i = 0; i < path.edges(); ++i)
                      if (!scene->visible(path[i].at, path[i + 1].at, path.time))
                        seen.insert("passage");
                    if (path[0].at.infinite() && c.t == 0)
                      seen.insert("light at infinity that reaches the lens");
                    for (const Vertex& x : path.vertices) {
                      if (x.at.in_medium()) seen.insert("medium");
                      if (x.lobe == Lobe::reflection) seen.insert("reflection");
                      if (x.lobe == Lobe::transmission) seen.insert("transmission");
                      if (x.kind == VertexKind::inner && dot(x.at.ng, x.at.shading.n) < 0.99)
                        seen.insert("shading normal");
                    }
                  });
  }
  EXPECT_EQ(seen, (std::set<std::string>{
                      "s = 0", "s = 1", "s > 1", "t = 0", "t = 1", "t > 1", "light at infinity",
                      "light at infinity that reaches the lens", "medium", "passage", "reflection",
                      "transmission", "shading normal"}));
}

}  // namespace
}  // namespace mlt
