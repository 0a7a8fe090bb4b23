// The table of techniques: what bdpt keeps of each (s, t) with techniques=true.
#include <gtest/gtest.h>

#include "integrator_testing.h"
#include "path/technique_names.h"

namespace mlt {
namespace {

using namespace test;

std::map<std::string, Image> layers_of(const Rendering& rendering) {
  std::map<std::string, Image> layers;
  for (const NamedImage& layer : rendering.layers()) layers[layer.name] = layer.image;
  return layers;
}

TEST(Techniques, AreNamedByLengthThenByLightVertices) {
  EXPECT_EQ(technique_names(2), (std::vector<std::string>{"s0.t2", "s1.t1", "s2.t0", "s0.t3",
                                                          "s1.t2", "s2.t1", "s3.t0"}));
  const std::vector<std::string> names = technique_names(9);
  for (int k = 1; k <= 9; ++k)
    for (int s = 0; s <= k + 1; ++s) {
      const int t = k + 1 - s;
      ASSERT_EQ(names.at(technique_index(s, t)),
                "s" + std::to_string(s) + ".t" + std::to_string(t));
    }
}

TEST(Techniques, AreLeftOutUnlessAskedFor) {
  EXPECT_TRUE(rendered(make_scene("cornell").scene, integrator("bdpt"), 1, 1)->layers().empty());
}

TEST(Techniques, NeedABoundedDepth) {
  for (const char* depth : {"-1", "17"})
    EXPECT_THROW(integrator("bdpt", {{"techniques", "true"}, {"max_depth", depth}}), Error);
}

TEST(Techniques, HaveWeightedImagesThatSumToTheImage) {
  for (const char* filter : {"box", "gaussian"})
    for (const char* name : {"cornell", "thin_lens"}) {
      SCOPED_TRACE(std::string(name) + " " + filter);
      const ScenePtr scene = make_scene(name, with_size(40, 30, filter)).scene;
      const auto rendering =
          rendered(scene, integrator("bdpt", {{"max_depth", "4"}, {"techniques", "true"}}), 3, 32);
      const Image image = rendering->image();
      std::vector<double> sum(image.data.size());
      size_t weighted = 0;
      for (const NamedImage& layer : rendering->layers()) {
        ASSERT_EQ(layer.image.data.size(), image.data.size());
        if (layer.name.rfind("weighted.", 0) != 0) continue;
        ++weighted;
        for (size_t i = 0; i < sum.size(); ++i) sum[i] += layer.image.data[i];
      }
      EXPECT_EQ(weighted, technique_names(4).size());
      double brightest = 0, worst = 0;
      for (size_t i = 0; i < sum.size(); ++i) {
        brightest = std::max(brightest, sum[i]);
        worst = std::max(worst, std::abs(sum[i] - image.data[i]) / (0.01 + sum[i]));
      }
      EXPECT_GT(brightest, 0.1);
      EXPECT_LT(worst, 1e-5) << "relative to the pixel";
    }
}

TEST(Techniques, ShowNothingWhereTheyCannotWork) {
  const ScenePtr scene = make_scene("caustic").scene;
  const auto layers = layers_of(*rendered(
      scene,
      integrator("bdpt", {{"max_depth", "4"}, {"techniques", "true"}, {"light_image", "false"}}), 3,
      8));
  for (const auto& [name, image] : layers) {
    const bool light_image =
        name.find(".t0") != std::string::npos || name.find(".t1") != std::string::npos;
    const bool lit =
        std::any_of(image.data.begin(), image.data.end(), [](float x) { return x > 0; });
    EXPECT_EQ(lit, !light_image) << name;
  }
}

/// Image (name) of bdpt as a side of a comparison.
Side technique(const ScenePtr& scene, const std::string& name, int max_depth, double spp) {
  return {name, [=](uint64_t seed, double effort) {
            const auto algorithm = integrator("bdpt", {{"max_depth", std::to_string(max_depth)},
                                                       {"techniques", "true"},
                                                       {"rr_depth", "100"}});
            return layers_of(*rendered(scene, algorithm, seed, spp * effort)).at(name);
          }};
}

/// Without delta vertices each technique alone, unweighted, makes the whole image of its length.
void expect_same_techniques(const std::string& scene_name, const ScenePtr& scene, int k,
                            std::vector<int> skip = {}) {
  const int last = scene->camera().delta_position() ? k : k + 1;
  const auto name = [&](int s) {
    return "raw.s" + std::to_string(s) + ".t" + std::to_string(k + 1 - s);
  };
  for (int s = 0; s <= last; ++s) {
    if (s == 1 || std::count(skip.begin(), skip.end(), s)) continue;
    SameImageSettings settings;
    settings.whole = 0.02;
    settings.block = 0.1;
    settings.max_effort = 1000;
    const SameImage found =
        same_image(technique(scene, name(s), k, 64), technique(scene, name(1), k, 64), settings);
    EXPECT_TRUE(found) << scene_name << ": " << found.text;
  }
}

TEST(Techniques, EachAloneMakeTheImageOfDirectLight) {
  expect_same_techniques("cornell", make_scene("cornell", with_size(8, 6)).scene, 2, {0});
}

/// A lamp in a hollow ball of radius R. Where surfaces meet, the G of a connection has no bound,
/// and a single technique no variance; between two points inside of a ball it is 1 / (4 R^2).
ScenePtr hollow_ball(const std::string& sensor, const std::string& lens = "") {
  const std::string inwards = "<boolean name='flip_normals' value='true'/>";
  return load_scene(camera("0, -0.5, 1.2", "0, 0.2, 0", 90, film(8, 6), sensor, lens) +
                    sphere(0, 0, 0, 2, white + inwards) +
                    sphere(0, 0.8, 0, 0.5, diffuse("0.2 0.2 0.2") + area_light("6 5 4")));
}

TEST(LongTechniques, EachAloneMakeTheImageOfTheirLength) {
  const ScenePtr pinhole = hollow_ball("perspective");
  const ScenePtr lens = hollow_ball("thinlens",
                                    "<float name='aperture_radius' value='1'/>"
                                    "<float name='focus_distance' value='4'/>");
  for (const int k : {1, 2, 3}) {
    expect_same_techniques("pinhole", pinhole, k);
    expect_same_techniques("thin lens", lens, k);
  }
}

}  // namespace
}  // namespace mlt
