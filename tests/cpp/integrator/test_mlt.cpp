// mlt as a whole: its images are those of bdpt, its b is their mean, it does not matter how many
// samples its bootstrap has, how many threads there are, and whether it was saved on the way.
#include "integrator_testing.h"
#include "mutation/mutation_registry.h"
#include "rendering/stats.h"
#include "scenes.h"

namespace mlt::test {
namespace {

Assignments mlt_settings(int luminance_samples, Assignments more = {}) {
  more.push_back({"max_depth", "6"});
  more.push_back({"chains", "32"});
  more.push_back({"luminance_samples", std::to_string(luminance_samples)});
  return more;
}

Side mlt_side(const ScenePtr& scene, Assignments more = {}, double luminance_samples = 10000) {
  more.push_back({"max_depth", "6"});
  return side(scene, "mlt", more, 256, luminance_samples);
}

Side bdpt_side(const ScenePtr& scene) { return side(scene, "bdpt", {{"max_depth", "6"}}, 16); }

/// What must not stay unseen: 5 % of the whole and 25 % of a block in the quick suite, 2 % and 10 %
/// in the long one. Half as much takes four times as long.
SameImageSettings in_short() {
  SameImageSettings settings;
  settings.whole = 0.05;
  settings.block = 0.25;
  return settings;
}

SameImageSettings at_length() {
  SameImageSettings settings;
  settings.whole = 0.02;
  settings.block = 0.1;
  settings.max_effort = 2000;
  return settings;
}

/// Light through water, seen through water: chains find it so rarely that 40 % of a block take
/// minutes.
SameImageSettings under_water() {
  SameImageSettings settings = at_length();
  settings.whole = 0.05;
  settings.block = 0.4;
  return settings;
}

// ---- the same image as bdpt

/// A scene, and what independent samples there are.
class MltImage : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

Assignments with_samples(const std::string& kind, Assignments settings = {}) {
  settings.push_back({"independent_share", kind == "none" ? "0" : "0.3"});
  if (kind != "none") settings.push_back({"independent", kind});
  return settings;
}

TEST_P(MltImage, IsThatOfBdpt) {
  const auto& [name, samples] = GetParam();
  const ScenePtr scene = make_scene(name).scene;
  const SameImage found =
      same_image(mlt_side(scene, with_samples(samples, {{"adaptive", "false"}})), bdpt_side(scene),
                 in_short());
  EXPECT_TRUE(found) << found.text;
}

INSTANTIATE_TEST_SUITE_P(Scenes, MltImage,
                         testing::Combine(testing::Values("cornell", "caustic", "beam"),
                                          testing::Values("none", "bdpt", "path")));

/// Scenes that bdpt renders in reasonable time; in the others it hardly sees some features.
std::vector<std::string> scenes_of_bdpt() {
  std::vector<std::string> names;
  for (const std::string& name : mutation_scene_names())
    if (name != "sun_caustic" && name != "both_in_glass" && name != "point_caustic")
      names.push_back(name);
  return names;
}

class LongMltImage : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(LongMltImage, IsThatOfBdpt) {
  const auto& [name, samples] = GetParam();
  const bool wet = name.find("water") != std::string::npos;
  const ScenePtr scene = make_scene(name).scene;
  const SameImage found = same_image(mlt_side(scene, with_samples(samples)), bdpt_side(scene),
                                     wet ? under_water() : at_length());
  EXPECT_TRUE(found) << found.text;
}

INSTANTIATE_TEST_SUITE_P(Scenes, LongMltImage,
                         testing::Combine(testing::ValuesIn(scenes_of_bdpt()),
                                          testing::Values("none", "bdpt", "path")));

/// Each mutation alone with the bidirectional one, which makes the chain ergodic, and each variant.
class LongMltVariant : public testing::TestWithParam<Assignments> {};

TEST_P(LongMltVariant, HasTheSameImage) {
  for (const char* name : {"cornell", "mirrors", "glass_torus"}) {
    const ScenePtr scene = make_scene(name).scene;
    const SameImage found = same_image(mlt_side(scene, GetParam()), bdpt_side(scene), at_length());
    EXPECT_TRUE(found) << name << ": " << found.text;
  }
}

/// Beside the bidirectional mutation only this one, or none.
Assignments only(const std::string& name) {
  Assignments all;
  for (const MutationPlugin& plugin : mutation_plugins()) {
    const bool on = plugin.name() == name || plugin.name() == "bidirectional";
    all.push_back({plugin.switch_name, on ? "true" : "false"});
  }
  return all;
}

std::vector<Assignments> long_variants() {
  std::vector<Assignments> all;
  for (const MutationPlugin& plugin : mutation_plugins()) all.push_back(only(plugin.name()));
  all.push_back({{"two_stage", "false"}});
  all.push_back({{"direct_samples", "256"}});
  all.push_back({{"delayed_rejection", "true"}});
  all.push_back({{"caustic_anisotropic", "false"}});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Variants, LongMltVariant, testing::ValuesIn(long_variants()));

// ---- two runs

TEST(MltRuns, AgreeWhateverTheBootstrap) {
  // Start-up bias must vanish in the mean over seeds.
  const ScenePtr scene = make_scene("cornell").scene;
  const SameImage found = same_image(
      mlt_side(scene, {{"adaptive", "false"}, {"independent_share", "0"}}, 2000),
      mlt_side(scene, {{"adaptive", "false"}, {"independent_share", "0"}}, 16000), in_short());
  EXPECT_TRUE(found) << found.text;
}

TEST(MltRuns, EstimateBAsTheMeanOfTheImage) {
  const ScenePtr scene = make_scene("caustic").scene;
  Moments b, errors, mean;
  for (uint64_t seed = 1; seed <= 16; ++seed) {
    Stats stats;
    rendered(scene,
             integrator("mlt", mlt_settings(4000, {{"adaptive", "false"},
                                                   {"two_stage", "false"},
                                                   {"independent_share", "0.2"}})),
             seed, 1)
        ->add_stats(stats);
    b.add(stats.b);
    errors.add(stats.b_error);
    const Image image =
        rendered(scene, integrator("bdpt", {{"max_depth", "6"}}), seed, 32)->image();
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        sum += target_luminance({image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)});
    mean.add(sum / (image.width * image.height));
  }
  EXPECT_GT(welch_t_test(b, mean).p_value, 1e-3) << b.mean() << " and " << mean.mean();
  // The error that is told is the one that is made: chi-square of 16 values, two-sided.
  const double ratio = 15 * b.variance() / (errors.mean() * errors.mean());
  EXPECT_GT(chi_square_tail(ratio, 15), 1e-4)
      << std::sqrt(b.variance()) << " and " << errors.mean();
  EXPECT_LT(chi_square_tail(ratio, 15), 1 - 1e-4)
      << std::sqrt(b.variance()) << " and " << errors.mean();
}

TEST(MltRuns, MakeNoInvalidSteps) {
  for (const std::string& name : mutation_scene_names()) {
    const ScenePtr scene = make_scene(name).scene;
    Stats stats;
    rendered(scene, integrator("mlt", mlt_settings(2000)), 3, 16)->add_stats(stats);
    EXPECT_EQ(stats.invalid_samples, 0u) << name;
    for (const std::string& warning : stats.warnings)
      EXPECT_EQ(warning.find("fixed-point"), std::string::npos) << name << ": " << warning;
  }
}

// ---- determinism

std::vector<Assignments> variants() {
  return {mlt_settings(2000),
          mlt_settings(2000, {{"adaptive", "false"}, {"independent_share", "0"}}),
          mlt_settings(2000, {{"two_stage", "false"}, {"independent_share", "0.3"}}),
          mlt_settings(2000, {{"independent", "path"}, {"independent_share", "0.5"}}),
          mlt_settings(2000, {{"direct_samples", "4"}, {"independent_share", "0.1"}})};
}

TEST(MltBits, AreTheSameForAnyNumberOfThreads) {
  const ScenePtr scene = make_scene("near_specular").scene;
  for (const Assignments& settings : variants()) {
    const IntegratorPtr made = integrator("mlt", settings);
    const Image one = rendered(scene, made, 5, 20, 1)->image();
    for (const int threads : {2, 3})
      EXPECT_TRUE(one == rendered(scene, made, 5, 20, threads)->image());
    EXPECT_FALSE(one == rendered(scene, made, 6, 20)->image()) << "the seed does not matter";
  }
}

TEST(MltBits, AreTheSameWhenARenderGoesOnAfterItWasSaved) {
  const ScenePtr scene = make_scene("thin_lens").scene;
  for (const Assignments& settings : variants()) {
    const IntegratorPtr made = integrator("mlt", settings);
    const auto straight = prepared(scene, made, 7);
    const uint64_t units = straight->plan().unit_count(20);
    run_units(*straight, 0, units);
    const auto first = prepared(scene, made, 7);
    uint64_t done = 0;
    for (const uint64_t stop : {uint64_t{0}, uint64_t{1}, units / 2 + 1, units}) {
      run_units(*first, done, stop);
      done = stop;
      const auto second = made->start(scene, 7);
      second->load(first->save());
      EXPECT_TRUE(first->image() == second->image());
      run_units(*second, stop, units, 2);
      EXPECT_TRUE(straight->image() == second->image());
    }
  }
}

}  // namespace
}  // namespace mlt::test
