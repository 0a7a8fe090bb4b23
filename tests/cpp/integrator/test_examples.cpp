// The examples of docs/how-to-add.md do what the page says. The material is also one of the cases
// of tests/cpp/scene/bsdf, which check its sampling, its energy and its reciprocity.
#include "integrator_testing.h"
#include "mutation/mutation_testing.h"
#include "scene/bsdf/bsdf_testing.h"

namespace mlt {

Plugin bsdf_minnaert();
Plugin integrator_next_event();
MutationPlugin mutation_nudge();

namespace test {
namespace {

/// The plug-ins of the library and those of the examples.
const Registry& registry() {
  static const Registry all = [] {
    Registry registry = plugins();
    registry.add(bsdf_minnaert());
    registry.add(integrator_next_event());
    return registry;
  }();
  return all;
}

LoadedScene load(const std::string& content) {
  return load_string("<scene>\n" + content + "</scene>", "", registry(), {});
}

IntegratorPtr integrator_by_name(const std::string& name, const Assignments& assignments) {
  const Node node = choose_integrator(LoadedScene(), name, assignments, registry());
  return make_integrator(node, registry()).integrator;
}

// ---- the material

std::string minnaert(const std::string& parameters) {
  return "<bsdf type='minnaert'>" + parameters + "</bsdf>";
}

std::string moon_above_the_floor(const std::string& bsdf) {
  return camera(in_front, "0, 0, 0", 40, film(16, 12)) + room() + ceiling_lamp() +
         sphere(0.2, -0.4, 0, 0.6, bsdf);
}

TEST(MinnaertExample, IsLambertianForAnExponentOfOne) {
  const BsdfPtr moon = make_bsdf("minnaert", {{"k", 1.0}}), lambertian = make_bsdf("diffuse");
  Rng rng(1, Purpose::test, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 wl = random_direction(rng), wc = random_direction(rng);
    const Spectrum f = moon->eval(point(), wl, wc, Lobe::smooth);
    EXPECT_NEAR(f[0], lambertian->eval(point(), wl, wc, Lobe::smooth)[0], 1e-15);
  }
}

/// Light over one reflection, by a lamp straight above: the closed form along one ray.
TEST(MinnaertExample, HasTheFormulaOfThePage) {
  const BsdfPtr moon = make_bsdf("minnaert", {{"reflectance", 0.6}, {"k", 3.0}});
  const Vec3 wl = normalize(Vec3(0.6, 0, 0.8)), wc = normalize(Vec3(0, 0.8, 0.6));
  EXPECT_NEAR(moon->eval(point(), wl, wc, Lobe::smooth)[0], 0.6 * 4 / (2 * pi) * sqr(0.8 * 0.6),
              1e-15);
  EXPECT_NEAR(moon->albedo(point())[0], 0.3, 1e-15);
}

TEST(MinnaertExample, IsOneMoreMaterialOfASceneFile) {
  const LoadedScene moon = load(moon_above_the_floor(minnaert("<float name='k' value='3'/>")));
  SameImageSettings settings;
  settings.whole = 0.02;
  settings.block = 0.1;
  const Assignments depth{{"max_depth", "4"}};
  const SameImage found = same_image(side(moon.scene, "path", depth, 16),
                                     side(moon.scene, "bdpt", depth, 16), settings);
  EXPECT_TRUE(found) << found.text;
}

TEST(MinnaertExample, HasErrorMessagesFromItsSchema) {
  const auto message = [](const std::string& parameters) {
    try {
      load(moon_above_the_floor(minnaert(parameters)));
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message("<float name='reflektance' value='0.5'/>").find("did you mean 'reflectance'?"),
            std::string::npos);
  EXPECT_NE(message("<float name='k' value='0.5'/>").find("'k'"), std::string::npos);
}

// ---- the mutation

MutationPtr nudge(const PathTarget& target, double side) {
  const MutationPlugin plugin = mutation_nudge();
  Params own(plugin.schema, {});
  own.set("side", side, {});
  return plugin.make(target, own);
}

AuditReport audit_nudge(const std::string& scene, double side, bool spoilt = false) {
  const PathTarget target = path_target(make_scene(scene).scene);
  MutationPtr mutation = nudge(target, side);
  if (spoilt)
    mutation = std::make_shared<BrokenTwin>(
        mutation, [](const PathState&, const PathState& y, const Edit& edit) {
          return y.terms[edit.first].from_camera;
        });
  AuditSettings how;
  how.paths = 20000;
  return audit(target, mutation, how);
}

TEST(NudgeExample, LeavesTheTargetUnchanged) {
  for (const char* scene : {"cornell", "thin_lens_sky", "near_specular"})
    for (const double side : {0.5, 4.0}) {
      const AuditReport report = audit_nudge(scene, side);
      EXPECT_EQ(report.verdict, Verdict::nothing_found) << scene << "\n" << report.text();
    }
}

TEST(NudgeExample, IsWrongWithoutItsJacobian) {
  const AuditReport report = audit_nudge("cornell", 4, true);
  EXPECT_EQ(report.verdict, Verdict::wrong) << report.text();
}

TEST(NudgeExample, MovesTheImagePositionBySideAtTheMost) {
  const PathTarget target = path_target(make_scene("cornell").scene);
  double furthest = 0;
  for_each_proposal(target, {nudge(target, 3)}, 1, 1000,
                    [&](size_t, const PathState& x, const PathState& y, const Edit&) {
                      const Vec2 move = glm::abs(y.raster - x.raster);
                      furthest = std::max({furthest, move.x, move.y});
                    });
  EXPECT_GT(furthest, 1.4);
  EXPECT_LE(furthest, 1.5 + 1e-9);
}

TEST(NudgeExample, HasItsParameterUnderTheNameThatMltGivesIt) {
  const MutationPlugin plugin = mutation_nudge();
  ASSERT_EQ(plugin.schema.parameters.size(), 1u);
  EXPECT_EQ(plugin.full_name(plugin.schema.parameters[0].name), "nudge_side");
  EXPECT_EQ(plugin.weight_name(), "nudge_weight");
}

// ---- the integrator

TEST(NextEventExample, HasThePixelsOfDirectWithoutSamplesOfBsdfs) {
  for (const char* name : {"cornell", "mixed_lights", "thin_lens_sky", "mirror"})
    for (const std::string count : {"1", "3"}) {
      const ScenePtr scene = make_scene(name).scene;
      const auto one =
          rendered(scene, integrator_by_name("next_event", {{"light_samples", count}}), 7, 4);
      const auto other = rendered(
          scene, integrator("direct", {{"emitter_samples", count}, {"bsdf_samples", "0"}}), 7, 4);
      EXPECT_EQ(one->image(), other->image()) << name << ", " << count << " samples";
    }
}

TEST(NextEventExample, ConvergesToTheImageOfPathOnLambertianSurfaces) {
  const ScenePtr scene = make_scene("cornell").scene;
  SameImageSettings settings;
  settings.whole = 0.02;
  settings.block = 0.1;
  const auto all_lights = integrator_by_name("next_event", {{"light_samples", "2"}});
  const Side examples{"next_event", [&](uint64_t seed, double effort) {
                        return rendered(scene, all_lights, seed, 16 * effort)->image();
                      }};
  const SameImage found =
      same_image(examples, side(scene, "path", {{"max_depth", "2"}}, 16), settings);
  EXPECT_TRUE(found) << found.text;
}

}  // namespace
}  // namespace test
}  // namespace mlt
