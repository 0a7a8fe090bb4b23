// Motion blur is the mean of what is seen at each moment: a render with an open shutter equals the
// mean of 64 renders with a closed one, by the integrators that share no estimator of time with it.
#include <fstream>
#include <regex>

#include "integrator_testing.h"
#include "scenes.h"

namespace mlt::test {
namespace {

constexpr int stills = 64;

SameImageSettings precision(double whole, double block, double most) {
  SameImageSettings settings;
  settings.whole = whole;
  settings.block = block;
  settings.max_effort = most;
  return settings;
}

/// Renders with the shutter closed at (i + 1/2) / 64, each with a 64th of the samples.
Side mean_of_stills(const std::string& name) {
  std::vector<ScenePtr> scenes;
  for (int i = 0; i < stills; ++i) {
    const double time = (i + 0.5) / stills;
    scenes.push_back(make_scene(name, with_shutter(time, time)).scene);
  }
  return {"stills", [=](uint64_t seed, double effort) {
            Image sum(16, 12, 3);
            for (int i = 0; i < stills; ++i) {
              const Image still = rendered(scenes[i], integrator("path", {{"max_depth", "5"}}),
                                           seed * stills + i, std::max(1.0, effort))
                                      ->image();
              for (size_t j = 0; j < sum.data.size(); ++j) sum.data[j] += still.data[j] / stills;
            }
            return sum;
          }};
}

class MotionBlur : public testing::TestWithParam<std::string> {};
class LongMotionBlur : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

std::string name_of(const testing::TestParamInfo<std::string>& info) { return info.param; }

void expect_mean_of_stills(const std::string& name, const std::string& algorithm,
                           const SameImageSettings& settings) {
  const ScenePtr scene = make_scene(name).scene;
  const double spp = algorithm == "mlt" || algorithm == "pssmlt" ? 128 : 32;
  const SameImage found =
      same_image(side(scene, algorithm, {{"max_depth", "5"}}, spp), mean_of_stills(name), settings);
  EXPECT_TRUE(found) << name << " by " << algorithm << ": " << found.text;
}

TEST_P(MotionBlur, IsTheMeanOfStills) {
  expect_mean_of_stills(GetParam(), "bdpt", precision(0.03, 0.15, 100));
}
INSTANTIATE_TEST_SUITE_P(Scenes, MotionBlur, testing::ValuesIn(moving_scene_names()), name_of);

TEST_P(LongMotionBlur, IsTheMeanOfStills) {
  const auto& [name, algorithm] = GetParam();
  expect_mean_of_stills(name, algorithm, precision(0.02, 0.1, 10000));
}
INSTANTIATE_TEST_SUITE_P(Scenes, LongMotionBlur,
                         testing::Combine(testing::ValuesIn(moving_scene_names()),
                                          testing::Values("path", "bdpt", "pssmlt", "mlt")),
                         [](const auto& info) {
                           return std::get<0>(info.param) + "_" + std::get<1>(info.param);
                         });

/// Light walks alone see no mirrors and no glass.
TEST(LongLightTracing, SeesMotionToo) {
  for (const char* name : {"moving_ball", "moving_camera", "moving_lens", "moving_spot"})
    expect_mean_of_stills(name, "ptracer", precision(0.02, 0.1, 10000));
}

/// The scene with the first keys in the place of its animations.
ScenePtr without_animations(const std::string& name, const LoadOptions& options) {
  std::ifstream file("tests/scenes/" + name + ".xml");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const std::regex animation(
      R"(<animation name="to_world">\s*<transform time="0">([^]*?)</transform>)"
      R"([^]*?</animation>)");
  const std::regex colors(
      R"re(<animation name="(\w+)">\s*<(rgb|float) time="[0-9.]+"([^>]*>)[^]*?</animation>)re");
  const std::string still = std::regex_replace(
      std::regex_replace(text, animation, R"(<transform name="to_world">$1</transform>)"), colors,
      R"re(<$2 name="$1"$3)re");
  EXPECT_NE(still, text);
  return without_warnings(load_string(still, "tests/scenes", plugins(), options));
}

void expect_same_bits(const std::string& name, const LoadOptions& options) {
  const ScenePtr moving = make_scene(name, options).scene,
                 still = without_animations(name, options);
  for (const char* algorithm : {"path", "bdpt", "ptracer", "pssmlt", "mlt"}) {
    const auto image = [&](const ScenePtr& scene) {
      return rendered(scene,
                      integrator(algorithm, std::string(algorithm).find("mlt") == std::string::npos
                                                ? Assignments{}
                                                : Assignments{{"luminance_samples", "2000"},
                                                              {"chains", "16"}}),
                      7, 2)
          ->image();
    };
    EXPECT_EQ(image(moving).data, image(still).data) << algorithm;
  }
}

TEST(ClosedShutter, IsAStillBitForBit) {
  for (const std::string& name : moving_scene_names()) expect_same_bits(name, with_shutter(0, 0));
}

TEST(OpenShutter, ChangesNothingWhereNothingMoves) {
  for (const char* name : {"moving_ball", "moving_lamp", "spinning_instance"})
    expect_same_bits(name, with_shutter(-2, -1));
}

}  // namespace
}  // namespace mlt::test
