// Every mutation leaves L* unchanged, alone and in the mixture; that the images of mlt are right
// rests on this.
#include "mutation/mutation_testing.h"

namespace mlt::test {
namespace {

struct Case {
  std::string scene, mutation;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.mutation << " on " << c.scene; }
std::string name_of_case(const testing::TestParamInfo<Case>& info) {
  return info.param.scene + "_" + info.param.mutation;
}

/// Whether the mutation is for scenes such as this one.
bool is_for(const std::string& mutation, const std::string& scene) {
  if (mutation == "propagation") return media_scene_names().count(scene) > 0;
  if (mutation == "wavelength") return spectral_scene_names().count(scene) > 0;
  if (mutation == "translucent")
    return media_scene_names().count(scene) > 0 || scene == "rough_glass";
  return true;
}

std::vector<Case> cases(const std::vector<std::string>& scenes) {
  std::vector<Case> all;
  for (const std::string& scene : scenes) {
    for (const MutationPlugin& plugin : mutation_plugins())
      if (is_for(plugin.name(), scene)) all.push_back({scene, plugin.name()});
    all.push_back({scene, "mixture"});
  }
  return all;
}

AuditReport audit_case(const Case& c, uint64_t paths) {
  const ScenePtr scene = make_scene(c.scene).scene;
  const PathTarget target = path_target(scene);
  AuditSettings how;
  how.paths = paths;
  how.significance = 1e-5;  // of each of many cases
  if (c.mutation != "mixture")
    return audit(target, make_large_mutation(mutation_plugin(c.mutation), target), how);
  return audit(target, all_mutations(target), default_weights(), how);
}

class Audit : public testing::TestWithParam<Case> {};

/// Of caustics, and behind specular surfaces, samples are worth less.
uint64_t paths_for(const Case& c, uint64_t paths) {
  if (c.scene == "both_in_glass") return 20 * paths;  // few proposals there are accepted
  if (c.scene == "fog") return (c.mutation == "multi_chain" ? 20 : 10) * paths;  // weights vary
  if (c.mutation == "multi_chain" || c.scene == "sun_caustic" || c.scene == "glass_torus")
    return 5 * paths;
  if (c.scene == "openpbr" && c.mutation == "translucent") return 4 * paths;  // little light suits
  return c.mutation == "multiplexed" || c.mutation == "manifold" ? 2 * paths : paths;
}

TEST_P(Audit, LeavesTheTargetUnchanged) {
  const AuditReport report = audit_case(GetParam(), paths_for(GetParam(), 20000));
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

/// The other mutations in fog, which take many paths, are left to LongAudit.
std::vector<Case> short_cases() {
  std::vector<Case> all = cases({"mirrors", "near_specular", "windows"});
  all.push_back({"fog", "propagation"});
  all.push_back({"fog", "translucent"});
  all.push_back({"fog", "mixture"});
  all.push_back({"fire", "mixture"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Mutations, Audit, testing::ValuesIn(short_cases()), name_of_case);

/// Whether the scene has enough paths for something to be said.
bool has_paths(const Case& c) {
  if (c.mutation == "caustic") return c.scene != "camera_in_glass" && c.scene != "both_in_glass";
  if (c.mutation != "multi_chain" && c.mutation != "manifold" && c.mutation != "multiplexed")
    return true;
  for (const char* scene :
       {"caustic", "plastic", "camera_under_water", "light_under_water", "smooth_glass", "windows",
        "fog", "volume_caustic", "mirror", "mirrors", "near_specular", "near_specular_mirrors",
        "sun_caustic", "point_caustic", "glass_torus", "beam", "prism_beam"})
    if (c.scene == scene) return true;
  return false;
}

/// The edge of a perturbation may pass leaves and panes, or end at them.
TEST(AuditOfPassages, HoldsForTheLensPerturbation) {
  const AuditReport report = audit_case({"windows", "lens"}, 100000);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

TEST(AuditOfTranslucence, HoldsBehindRoughGlass) {
  const AuditReport report = audit_case({"rough_glass", "translucent"}, 200000);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

class LongAudit : public testing::TestWithParam<Case> {};

TEST_P(LongAudit, LeavesTheTargetUnchanged) {
  const Case& c = GetParam();
  const AuditReport report = audit_case(c, paths_for(c, 100000));
  EXPECT_NE(report.verdict, Verdict::wrong) << report.text();
  if (has_paths(c)) {
    EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
  }
  // A perturbation moves the paths of every signature that it takes on.
  if (c.mutation == "mixture" || !mutation_plugin(c.mutation).has_step_size()) return;
  for (const AuditRow& row : report.rows)
    if (row.steps > 2000) {
      EXPECT_GT(row.accepted, row.steps / 1000) << row.signature << "\n" << report.text();
    }
}

INSTANTIATE_TEST_SUITE_P(Mutations, LongAudit, testing::ValuesIn(cases(mutation_scene_names())),
                         name_of_case);

/// What the render may do besides: other step sizes, weights for each path length, a target divided
/// by a coarse image, short paths left to others.
AuditReport audit_variant(const std::string& name, bool two_stage, int min_depth, uint64_t paths) {
  const ScenePtr scene = make_scene(name).scene;
  PathRules rules;
  rules.max_depth = 8;
  rules.min_depth = min_depth;
  PathTarget target(scene, rules);
  TargetMap map(scene->camera().raster(), 2);
  if (two_stage) {
    for_each_light_path(target, 9, 2000, [&](const PathState& x) {
      map.add(x.raster, 1 + contribution(x.terms).y);
    });
    map.finish();
    target.set_map(map);
  }
  Mutations all;
  for (const double share : {0.02, 0.3})
    for (const MutationPlugin& plugin : mutation_plugins()) {
      MutationValues own;
      if (plugin.has_step_size()) own.push_back({"largest_share", share});
      all.push_back(make_large_mutation(plugin, target, own));
    }
  std::vector<std::vector<double>> rows;
  for (int k = 0; k < 6; ++k) {
    rows.emplace_back();
    for (size_t i = 0; i < all.size(); ++i)
      rows.back().push_back(1.0 + static_cast<double>((i + k) * (i + k) % 7));
  }
  AuditSettings how;
  how.paths = paths;
  return audit(target, all, MixtureWeights(rows), how);
}

TEST(AuditOfTheMixture, HoldsForWeightsByLengthAndManyStepSizes) {
  const AuditReport report = audit_variant("mirrors", false, 1, 20000);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

/// Where its techniques are about equally good, so that it matters how often each is drawn.
TEST(AuditOfMultiplexedSteps, HoldsForCausticsOfAPoint) {
  const AuditReport report = audit_case({"point_caustic", "multiplexed"}, 200000);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

/// Where a walk may stop or be reflected, both by chance.
TEST(AuditOfLensSubpaths, HoldsForPlastic) {
  const AuditReport report = audit_case({"plastic", "lens_subpath"}, 300000);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

/// Where what a walk has flown before says much about the channels that it may go on in.
TEST(AuditOfColouredMedia, HoldsForWalksThatGoOn) {
  const std::string coloured =
      "<bsdf type='null'/><medium name='interior' type='homogeneous'>"
      "<rgb name='sigma_t' value='0.5 3 16'/><float name='albedo' value='0.98'/></medium>";
  const ScenePtr scene =
      load_scene(camera("0, 0, 3.4", "0, 0, 0", 40, film(16, 12)) + sphere(0, 0, 0, 0.8, coloured) +
                 rectangle(rotate("y", 180) + translate(0, 0, 4),
                           diffuse("0.2 0.2 0.2") + area_light("6 5 4")));
  const PathTarget target = path_target(scene);
  AuditSettings how;
  how.paths = 100000;
  how.significance = 1e-5;
  for (const char* mutation : {"bidirectional", "lens_subpath"}) {
    const AuditReport report = audit(target, make_mutation(mutation, target), how);
    EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
  }
}

/// Small ones hardly change the cosines at the vertex that they start from.
TEST(AuditOfManifolds, HoldsForLargeMoves) {
  const ScenePtr scene = make_scene("mirrors").scene;
  const PathTarget target = path_target(scene);
  AuditSettings how;
  how.paths = 400000;
  how.significance = 1e-5;
  const MutationValues large = {{"smallest_pixels", 3.0}, {"largest_share", 1.0}};
  const AuditReport report = audit(target, make_mutation("manifold", target, large), how);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

/// Glass that disperses strongly, so that chains of specular vertices move far with the wavelength.
TEST(AuditOfWavelengths, HoldsBehindAPrism) {
  const AuditReport report = audit_case({"prism", "wavelength"}, 500000);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

TEST(AuditOfCaustics, HoldsForRoundMovesOfTheDirection) {
  const ScenePtr scene = make_scene("caustic").scene;
  const PathTarget target = path_target(scene);
  AuditSettings how;
  how.paths = 20000;
  const AuditReport report =
      audit(target, make_mutation("caustic", target, {{"anisotropic", false}}), how);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

/// A mutation that turned the first direction would break its delta.
TEST(AuditOfTheMixture, HoldsForLightAlongNormals) {
  const AuditReport report = audit_case({"beam", "mixture"}, 20000);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

TEST(AuditOfTheMixture, HoldsForATwoStageTarget) {
  const AuditReport report = audit_variant("cornell", true, 1, 100000);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

TEST(AuditOfTheMixture, HoldsWhereShortPathsAreLeftToOthers) {
  const AuditReport report = audit_variant("caustic", false, 3, 20000);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
  for (const AuditRow& row : report.rows) EXPECT_GE(row.signature.size(), 4u) << row.signature;
}

TEST(LongAuditOfTheMixture, HoldsForAllVariants) {
  for (const char* scene :
       {"cornell", "caustic", "mirrors", "near_specular", "thin_lens", "light_under_water"}) {
    const AuditReport report = audit_variant(scene, true, 3, 200000);
    EXPECT_EQ(report.verdict, Verdict::nothing_found) << scene << ": " << report.text();
  }
}

TEST(AuditReport, IsTheSameForAnyNumberOfThreads) {
  const ScenePtr scene = make_scene("caustic").scene;
  const PathTarget target = path_target(scene);
  AuditSettings how;
  how.paths = 5000;
  const auto text = [&](int threads) {
    how.threads = threads;
    return audit(target, all_mutations(target), default_weights(), how).text(1000);
  };
  EXPECT_EQ(text(1), text(3));
}

TEST(AuditReport, LeavesSignificanceForLaterStages) {
  const PathTarget target = path_target(make_scene("cornell").scene);
  AuditSettings how;
  how.paths = 5120;
  for (const auto& [most, stages] : {std::pair{5120, 1}, {10240, 2}, {0, 5}}) {
    how.most_paths = most;
    const AuditReport report = audit(target, make_mutation("lens", target), how);
    EXPECT_EQ(report.samples, how.paths);
    EXPECT_EQ(report.level, how.significance / (stages > 1 ? 2 : 1));
  }
}

TEST(AuditReport, SaysWhatItWouldHaveFound) {
  const PathTarget target = path_target(make_scene("cornell").scene);
  AuditSettings how;
  how.paths = 20000;
  const AuditReport report = audit(target, make_mutation("lens", target), how);
  ASSERT_GT(report.limits.size(), 3u);
  EXPECT_EQ(report.limits[0].edges, 0);
  for (const AuditLimit& limit : report.limits) EXPECT_GT(limit.pixels, 0);
  EXPECT_NE(report.reason.find("pixel would have been"), std::string::npos) << report.reason;
}

TEST(AuditReport, SaysWhyNothingIsConcluded) {
  const ScenePtr scene = make_scene("cornell").scene;
  const PathTarget target = path_target(scene);
  const auto multi_chain = make_mutation("multi_chain", target);
  AuditSettings how;
  how.paths = 2000;
  AuditReport report = audit(target, multi_chain, how);
  EXPECT_EQ(report.verdict, Verdict::inconclusive);
  EXPECT_EQ(report.reason, "no path suits");

  how.paths = 500;
  report = audit(target, make_mutation("lens", target), how);
  EXPECT_EQ(report.verdict, Verdict::inconclusive);
  EXPECT_NE(report.reason.find("at least 1000"), std::string::npos) << report.reason;
}

/// Proposes nothing, ever.
class Idle : public Mutation {
 public:
  explicit Idle(const PathTarget& target) : Mutation("idle", target) {}
  double suitability(const PathState&) const override { return 1; }
  std::optional<Edit> propose(const PathState&, PathState&, MutationContext&) const override {
    return std::nullopt;
  }
  double density(const PathState&, const PathState&, const Edit&) const override { return 0; }
};

TEST(AuditReport, DoesNotCallAMutationRightThatNeverMoves) {
  const ScenePtr scene = make_scene("cornell").scene;
  const PathTarget target = path_target(scene);
  AuditSettings how;
  how.paths = 5000;
  const AuditReport report = audit(target, std::make_shared<Idle>(target), how);
  EXPECT_EQ(report.verdict, Verdict::inconclusive) << report.text();
  EXPECT_NE(report.reason.find("only 0 moves"), std::string::npos) << report.reason;
}

TEST(AuditReport, NeedsLight) {
  const ScenePtr scene =
      load_scene(camera(in_front, "0, 0, 10", 40, film(16, 12)) + room() + ceiling_lamp());
  const PathTarget target = path_target(scene);
  EXPECT_THROW(audit(target, make_mutation("lens", target), {}), RenderError);
}

}  // namespace
}  // namespace mlt::test
