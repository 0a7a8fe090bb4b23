// The quotients q(x -> y) / L*(y) that the acceptance is made of: those of q and L*, as long as
// these are numbers, and right where these are none.
#include <sstream>

#include "mutation/mutation_testing.h"

namespace mlt::test {
namespace {

/// Of two positive numbers, or of two zeros.
double relative_difference(double a, double b) { return a == b ? 0 : std::abs(a / b - 1); }

/// q(x -> y) / L*(y), both in full.
double full_quotient(const Mutation& mutation, const PathState& x, const PathState& y,
                     const Edit& edit) {
  return mutation.density(x, y, edit) / target_luminance(contribution(y.terms));
}

/// Whether full products may have lost digits: far out in a lobe that is an exponential.
bool has_underflowed(const PathState& x) {
  const auto tiny = [](const TermsAt& at) { return max_component(at.vertex.f) < 1e-30; };
  return std::any_of(x.terms.at.begin(), x.terms.at.end(), tiny);
}

class Quotients : public testing::TestWithParam<std::string> {};

TEST_P(Quotients, AreThoseOfTheFullProducts) {
  const ScenePtr scene = make_scene(GetParam()).scene;
  const PathTarget target = path_target(scene);
  const Mutations all = all_mutations(target);
  std::vector<int> compared(all.size(), 0), reversible(all.size(), 0);
  const auto compare = [&](size_t i, const PathState& x, const PathState& y, const Edit& edit) {
    const Transition own = all[i]->quotients(x, y, edit);
    const double forward = full_quotient(*all[i], x, y, edit);
    const double backward = full_quotient(*all[i], y, x, edit.reversed());
    if (forward == 0) {  // y has another form
      ASSERT_EQ(own.forward, 0);
      return;
    }
    if (has_underflowed(x) || has_underflowed(y)) return;
    const std::string what =
        all[i]->name() + " on " + signature(x.terms) + " to " + signature(y.terms);
    ASSERT_LT(relative_difference(own.backward / own.forward, backward / forward), 1e-11) << what;
    // Each by itself lacks |f| of what stays.
    const int end = edit.first + edit.inserted;
    double stays = 1;
    if (edit.first > 1) stays *= magnitude(y.terms, 0, edit.first - 2) * y.terms[edit.first - 2].G;
    if (end < y.edges()) stays *= y.terms[end].G * magnitude(y.terms, end + 1, y.edges());
    ASSERT_LT(relative_difference(own.forward, forward * stays), 1e-11) << what;
    ASSERT_LT(relative_difference(own.backward, backward * stays), 1e-11) << what;
    ++compared[i];
    reversible[i] += backward > 0;
  };
  for_each_proposal(target, all, 3, 2000, compare);
  for (size_t i = 0; i < all.size(); ++i)
    if (all[i]->name() == "bidirectional" || all[i]->name() == "lens") {
      EXPECT_GT(compared[i], 50) << all[i]->name();
      EXPECT_GT(reversible[i], 20) << all[i]->name();
    }
}

TEST_P(Quotients, OfAMutationThatKnowsItsDensityAloneAreTheSame) {
  const ScenePtr scene = make_scene(GetParam()).scene;
  const PathTarget target = path_target(scene);
  const Mutations all = all_mutations(target);
  const auto compare = [&](size_t i, const PathState& x, const PathState& y, const Edit& edit) {
    if (has_underflowed(x) || has_underflowed(y)) return;
    const BrokenTwin unbroken(all[i], [](auto&, auto&, auto&) { return 1; });
    const Transition own = all[i]->quotients(x, y, edit);
    const Transition by_density = unbroken.quotients(x, y, edit);
    ASSERT_LT(relative_difference(own.forward, by_density.forward), 1e-11) << all[i]->name();
    ASSERT_LT(relative_difference(own.backward, by_density.backward), 1e-11) << all[i]->name();
  };
  for_each_proposal(target, all, 4, 500, compare);
}

TEST_P(Quotients, OfTheTargetAndTheDensityOfAllTechniquesAreThoseOfTheFullProducts) {
  const ScenePtr scene = make_scene(GetParam()).scene;
  PathTarget target = path_target(scene);
  int compared = 0;
  for_each_light_path(target, 6, 500, [&](const PathState& x) {
    if (!(x.target > 0) || has_underflowed(x)) return;
    double all = 0;
    for (int s = 0; s <= x.edges() + 1; ++s) all += technique_density(x.terms, s);
    target.set_techniques(SampleTechniques::all);
    ASSERT_LT(relative_difference(target.over_density(x), x.brightness() / all), 1e-11);
    const double traced =
        technique_density(x.terms, 0) + (x.edges() > 1 ? technique_density(x.terms, 1) : 0);
    target.set_techniques(SampleTechniques::path_tracing);
    x.known.invalidate();
    if (traced > 0)
      ASSERT_LT(relative_difference(target.over_density(x), x.brightness() / traced), 1e-11);
    else
      ASSERT_EQ(target.over_density(x), std::numeric_limits<double>::infinity());
    ++compared;
  });
  EXPECT_GT(compared, 100);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Quotients, testing::ValuesIn(mutation_scene_names()),
                         [](const auto& info) { return info.param; });

// ---- where q and L* are no numbers

/// A closed box, `unit` long, in which light of all wavelengths goes on and on, with fog in its
/// middle.
ScenePtr closed_box(double unit) {
  std::ostringstream text;
  text.precision(17);
  text << "<scale value='" << unit << "'/>";
  const std::string in_units = text.str();
  text.str("");
  text
      << "<bsdf type='null'/><medium name='interior' type='homogeneous'><rgb name='sigma_t' value='"
      << 1 / unit << " " << 1.2 / unit << " " << 1.5 / unit
      << "'/><float name='albedo' value='0.9'/></medium>";
  const std::string fog = text.str();
  text.str("");
  text << "0, 0, " << 0.9 * unit;
  const std::string pale = diffuse("0.9 0.8 0.85");
  const auto wall = [&](const std::string& steps, const std::string& bsdf) {
    return rectangle(steps + in_units, bsdf);
  };
  const std::string spectral = "<rfilter type='box'/><boolean name='spectral' value='true'/>";
  return load_scene(
      camera(text.str(), "0, 0, 0", 60, film(16, 12, spectral)) + cube(scale(0.7) + in_units, fog) +
      wall(rotate("x", -90) + translate(0, -1, 0), pale) +
      wall(rotate("x", 90) + translate(0, 1, 0), pale) + wall(translate(0, 0, -1), pale) +
      wall(rotate("y", 180) + translate(0, 0, 1), pale) +
      wall(rotate("y", 90) + translate(-1, 0, 0), mirror) +
      wall(rotate("y", -90) + translate(1, 0, 0),
           "<bsdf type='roughconductor'><float name='alpha' value='0.06'/>"
           "<string name='material' value='Al'/></bsdf>") +
      wall(scale(0.5) + rotate("x", 90) + translate(0, 0.98, 0),
           diffuse("0.2 0.2 0.2") + area_light("6 5 4")));
}

PathTarget target_of_long_paths(const ScenePtr& scene) {
  PathRules rules;
  rules.min_depth = rules.rr_depth = 40;
  rules.max_depth = 44;
  return PathTarget(scene, rules);
}

/// The same path where all is `unit` times as large.
PathState enlarged(const PathState& x, double unit, const PathTarget& target) {
  PathState large;
  large.path = x.path;
  for (Vertex& vertex : large.path.vertices) {
    vertex.at.p *= unit;
    vertex.at.extent *= unit;
  }
  target.evaluate(large);
  return large;
}

TEST(QuotientsOfLongPaths, AreRightInScenesOfAnySize) {
  const PathTarget target = target_of_long_paths(closed_box(1));
  const Mutations all = all_mutations(target);
  for (const int exponent : {40, -40}) {  // about 1e12 and 1e-12
    const double unit = std::ldexp(1.0, exponent);
    const PathTarget large_target = target_of_long_paths(closed_box(unit));
    const Mutations large_all = all_mutations(large_target);
    std::vector<int> compared(all.size(), 0);
    const auto compare = [&](size_t i, const PathState& x, const PathState& y, const Edit& edit) {
      const PathState large_x = enlarged(x, unit, large_target);
      const PathState large_y = enlarged(y, unit, large_target);
      for (const PathState* state : {&large_x, &large_y}) {
        const double full = target_luminance(contribution(state->terms));
        ASSERT_TRUE(full == 0 || full == infinity || std::isnan(full)) << full;
      }
      if (all[i]->name() == "wavelength") return;  // which proposes nothing then
      const Transition own = all[i]->quotients(x, y, edit);
      const Transition large = large_all[i]->quotients(large_x, large_y, edit);
      if (own.forward == 0) {  // y has another form
        EXPECT_EQ(large.forward, 0);
        return;
      }
      const double a = acceptance(own);
      ASSERT_NEAR(acceptance(large), a, 1e-9 * a + 1e-100) << all[i]->name();
      compared[i] += a > 0;
    };
    for_each_proposal(target, all, 5, 20, compare);
    for (size_t i = 0; i < all.size(); ++i) {
      if (all[i]->name() == "wavelength") continue;
      EXPECT_GT(compared[i], 20) << all[i]->name() << " in units of " << unit;
    }
  }
}

}  // namespace
}  // namespace mlt::test
