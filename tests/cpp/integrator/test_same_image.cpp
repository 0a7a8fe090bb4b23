// path = ptracer = bdpt = pssmlt, by a test of significance, on every test scene that both sides of
// a pair can see. The short suite would see a difference of 2 % of an image and 10 % of a block;
// the long one takes all scenes and 1 % and 5 %.
#include <gtest/gtest.h>

#include "integrator_testing.h"

namespace mlt {
namespace {

using namespace test;

struct Pair {
  std::string scene, integrator;
};

void PrintTo(const Pair& pair, std::ostream* out) {
  *out << pair.scene << " by " << pair.integrator;
}

std::string pair_name(const testing::TestParamInfo<Pair>& info) {
  return info.param.scene + "_" + info.param.integrator;
}

SameImageSettings short_test() {
  SameImageSettings settings;
  settings.whole = 0.02;
  settings.block = 0.1;
  settings.max_effort = 1000;
  return settings;
}

SameImageSettings long_test() {
  SameImageSettings settings;
  settings.max_effort = 50000;
  return settings;
}

void expect_same(const Pair& pair, const SameImageSettings& settings) {
  const ScenePtr scene = make_scene(pair.scene).scene;
  const Assignments depth{{"max_depth", "6"}};
  const SameImage found =
      same_image(side(scene, pair.integrator, depth,
                      has_chains(variant(pair.integrator).integrator) ? 64 : 16),
                 side(scene, "bdpt", depth, 16), settings);
  EXPECT_TRUE(found) << pair.scene << ": " << found.text;
}

class SameImageOf : public testing::TestWithParam<Pair> {};

TEST_P(SameImageOf, TwoIntegrators) { expect_same(GetParam(), short_test()); }

INSTANTIATE_TEST_SUITE_P(
    Pairs, SameImageOf,
    testing::Values(
        Pair{"cornell", "ptracer"}, Pair{"caustic", "path"}, Pair{"rough_glass", "path"},
        Pair{"sky", "path"}, Pair{"sky", "pssmlt"}, Pair{"sky_map", "path"}, Pair{"sun", "path"},
        Pair{"point", "ptracer"}, Pair{"thin_lens", "path"}, Pair{"thin_lens_sky", "path"},
        Pair{"camera_in_glass", "path"}, Pair{"light_under_water", "path"},
        Pair{"smooth_normals", "path"}, Pair{"smooth_normals", "ptracer"},
        Pair{"smooth_glass", "path"}, Pair{"spot", "ptracer"}, Pair{"luminaire", "ptracer"},
        Pair{"goniometric", "ptracer"}, Pair{"goniometric", "mlt"}, Pair{"materials", "path"},
        Pair{"materials", "pssmlt"}, Pair{"thin_lens_sky", "pssmlt_bdpt"},
        Pair{"cornell", "pssmlt_ptracer"}, Pair{"sky", "pssmlt_gaussian"}, Pair{"sky", "mmlt"},
        Pair{"thin_lens_sky", "rjmlt_chains"}, Pair{"thin_lens_sky", "erpt"},
        Pair{"instances", "path"}, Pair{"orthographic", "path"}, Pair{"orthographic", "ptracer"},
        Pair{"spherical", "path"}, Pair{"spherical", "mlt"}, Pair{"spherical", "pssmlt_bdpt"},
        Pair{"spherical", "mmlt"}, Pair{"fisheye", "path"}, Pair{"fisheye", "pssmlt"},
        Pair{"projector", "ptracer"}, Pair{"daylight", "path"}, Pair{"bent_normals", "path"},
        Pair{"more_materials", "path"}, Pair{"windows", "path"}, Pair{"fog", "path"},
        Pair{"wax", "path"}, Pair{"wax", "mlt"}, Pair{"fog", "path_equiangular"},
        Pair{"fire", "path_equiangular"}, Pair{"smoke_box", "path"}, Pair{"smoke", "path"},
        Pair{"fire", "path"}, Pair{"fire", "ptracer"}, Pair{"fire", "pssmlt"}, Pair{"fire", "mmlt"},
        Pair{"beam", "ptracer"}, Pair{"beam", "mmlt"}, Pair{"beam", "rjmlt"}, Pair{"beam", "erpt"},
        Pair{"clipped", "path"}, Pair{"clipped", "mlt"}, Pair{"clipped", "pssmlt"},
        Pair{"clipped", "mmlt"}, Pair{"clipped_fog", "path"}, Pair{"clipped_fog", "mlt"},
        Pair{"clipped_fog", "pssmlt"}, Pair{"solids", "path"}, Pair{"solids", "mlt"},
        Pair{"solids", "pssmlt"}, Pair{"openpbr", "path"}, Pair{"openpbr", "mlt"},
        Pair{"openpbr", "pssmlt_bdpt"}),
    pair_name);

class LongSameImageOf : public testing::TestWithParam<Pair> {};

TEST_P(LongSameImageOf, TwoIntegrators) { expect_same(GetParam(), long_test()); }

std::vector<Pair> all_pairs() {
  std::vector<Pair> pairs{{"point", "mmlt_chains"},
                          {"thin_lens_sky", "mmlt_chains"},
                          {"beam", "pssmlt_bdpt"},
                          {"prism_beam", "mmlt"},
                          {"prism_beam", "rjmlt"}};
  std::vector<std::string> names = scene_names();
  for (const char* more : {"clipped", "clipped_fog", "solids", "openpbr"}) names.push_back(more);
  for (const std::string& name : names) {
    for (const char* algorithm : {"path", "pssmlt", "pssmlt_bdpt", "mmlt", "rjmlt", "erpt"})
      pairs.push_back({name, algorithm});
    if (light_sees_all(name))
      for (const char* algorithm : {"ptracer", "pssmlt_ptracer"})
        pairs.push_back({name, algorithm});
  }
  return pairs;
}

INSTANTIATE_TEST_SUITE_P(Pairs, LongSameImageOf, testing::ValuesIn(all_pairs()), pair_name);

// ---- the order of a scene's shapes, and a pane that no ray meets, change no image

void expect_same_behind_pane(const Pair& pair, const SameImageSettings& settings) {
  const Assignments depth{{"max_depth", "6"}};
  const SameImage found =
      same_image(side(with_pane_first(pair.scene, true).scene, pair.integrator, depth,
                      has_chains(variant(pair.integrator).integrator) ? 64 : 16),
                 side(make_scene(pair.scene).scene, "bdpt", depth, 16), settings);
  EXPECT_TRUE(found) << pair.scene << ": " << found.text;
}

class ShapeOrderOf : public testing::TestWithParam<Pair> {};

TEST_P(ShapeOrderOf, ChangesNoImage) { expect_same_behind_pane(GetParam(), short_test()); }

INSTANTIATE_TEST_SUITE_P(Pairs, ShapeOrderOf,
                         testing::Values(Pair{"sky", "bdpt"}, Pair{"sky", "mlt"},
                                         Pair{"thin_lens_sky", "bdpt"},
                                         Pair{"thin_lens_sky", "mlt"}, Pair{"materials", "bdpt"},
                                         Pair{"materials", "mlt"}),
                         pair_name);

class LongShapeOrderOf : public testing::TestWithParam<Pair> {};

TEST_P(LongShapeOrderOf, ChangesNoImage) { expect_same_behind_pane(GetParam(), long_test()); }

std::vector<Pair> all_pairs_and_their_reference() {
  std::vector<Pair> pairs = all_pairs();
  for (const std::string& name : scene_names())
    for (const char* algorithm : {"bdpt", "mlt"}) pairs.push_back({name, algorithm});
  return pairs;
}

INSTANTIATE_TEST_SUITE_P(Pairs, LongShapeOrderOf,
                         testing::ValuesIn(all_pairs_and_their_reference()), pair_name);

/// Where there are passages before, the pane changes no random number: each bit is the same.
TEST(ShapeOrder, KeepsAllBitsOfPathAndBdptWhereLightPassesSomeShapeAnyway) {
  int compared = 0;
  for (const std::string& name : scene_names()) {
    const ScenePtr scene = make_scene(name).scene;
    if (!scene->has_passages() || scene->has_media()) continue;
    ++compared;
    for (const char* algorithm : {"path", "bdpt"}) {
      const auto image = [&](const ScenePtr& of) {
        return rendered(of, integrator(algorithm, {}), 1, 4)->image().data;
      };
      EXPECT_EQ(image(scene), image(with_pane_first(name).scene)) << name << " by " << algorithm;
    }
  }
  EXPECT_GE(compared, 2);
}

// ---- the parameters of bdpt change the noise, not the image; others change it for all alike

void expect_same_with(const std::string& scene_name, const std::string& other, const Assignments& a,
                      const Assignments& b) {
  const ScenePtr scene = make_scene(scene_name).scene;
  const SameImage found =
      same_image(side(scene, other, a, 16), side(scene, "bdpt", b, 16), short_test());
  EXPECT_TRUE(found) << scene_name << ", " << a.back().first << " = " << a.back().second << ": "
                     << found.text;
}

TEST(BdptParameters, ChangeTheNoiseNotTheImage) {
  const Assignments plain{{"max_depth", "4"}};
  for (const auto& [name, value] : Assignments{{"heuristic", "balance"},
                                               {"heuristic", "maximum"},
                                               {"light_image", "false"},
                                               {"sample_direct", "false"},
                                               {"rr_depth", "1"},
                                               {"rr_depth", "1000"}})
    expect_same_with("thin_lens_sky", "bdpt", {{"max_depth", "4"}, {name, value}}, plain);
}

TEST(BdptParameters, JoinLightsAcrossChainsInTheSameImage) {
  const Assignments plain{{"max_depth", "6"}};
  for (const char* scene : {"caustic", "light_under_water"})
    expect_same_with(scene, "bdpt", {{"max_depth", "6"}, {"manifolds", "true"}}, plain);
}

TEST(SharedParameters, MeanTheSameForPathAndBdpt) {
  for (const auto& [scene, name, value] :
       std::vector<std::array<std::string, 3>>{{"sky", "max_depth", "-1"},
                                               {"sky", "hide_emitters", "true"},
                                               {"sphere_light", "hide_emitters", "true"},
                                               {"smooth_normals", "strict_normals", "true"},
                                               {"thin_lens_sky", "max_depth", "2"}}) {
    Assignments both{{name, value}};
    if (name != "max_depth") both.insert(both.begin(), {"max_depth", "4"});
    expect_same_with(scene, "path", both, both);
  }
}

TEST(SharedParameters, HideLightsFromLightWalksToo) {
  const Assignments both{{"max_depth", "3"}, {"hide_emitters", "true"}};
  expect_same_with("sphere_light", "ptracer", both, both);
}

// ---- a broken twin: what is 2 % brighter is not the same

TEST(SameImageTest, RejectsAnImageThatIsTwoPercentBrighter) {
  const ScenePtr scene = make_scene("sky").scene;
  const Assignments depth{{"max_depth", "3"}};
  Side bright = side(scene, "path", depth, 16);
  const Render plain = bright.render;
  bright.render = [=](uint64_t seed, double effort) {
    Image image = plain(seed, effort);
    for (float& x : image.data) x *= 1.02f;
    return image;
  };
  const SameImage found = same_image(bright, side(scene, "bdpt", depth, 16));
  EXPECT_TRUE(found.powerful) << found.text;
  EXPECT_FALSE(found.same) << found.text;
}

}  // namespace
}  // namespace mlt
