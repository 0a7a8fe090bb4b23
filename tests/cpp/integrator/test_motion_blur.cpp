// Motion blur is the mean of what is seen at each moment: a render with an open shutter equals the
// mean of 64 renders with a closed one, by the integrators that share no estimator of time with it.
#include "integrator_testing.h"
#include "moving_scenes.h"

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
    scenes.push_back(load_scene(moving_scene(name, time, time)));
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
  const ScenePtr scene = load_scene(moving_scene(name));
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

/// What the scene would be with transforms in the place of its animations.
std::string without_animations(std::string scene) {
  for (size_t i; (i = scene.find("<animation name='to_world'><transform time='0.000000'>")) !=
                 std::string::npos;) {
    const size_t first = scene.find("<transform", i), end = scene.find("</transform>", first),
                 after = scene.find("</animation>", end) + 12;
    const size_t steps = scene.find('>', first) + 1;
    scene = scene.substr(0, i) + to_world(scene.substr(steps, end - steps)) + scene.substr(after);
  }
  return scene;
}

void expect_same_bits(const std::string& a, const std::string& b) {
  for (const char* algorithm : {"path", "bdpt", "ptracer", "pssmlt", "mlt"}) {
    const auto image = [&](const std::string& scene) {
      return rendered(load_scene(scene),
                      integrator(algorithm, std::string(algorithm).find("mlt") == std::string::npos
                                                ? Assignments{}
                                                : Assignments{{"luminance_samples", "2000"},
                                                              {"chains", "16"}}),
                      7, 2)
          ->image();
    };
    EXPECT_EQ(image(a).data, image(b).data) << algorithm;
  }
}

TEST(ClosedShutter, IsAStillBitForBit) {
  for (const std::string& name : moving_scene_names())
    expect_same_bits(moving_scene(name, 0, 0), without_animations(moving_scene(name, 0, 0)));
}

TEST(OpenShutter, ChangesNothingWhereNothingMoves) {
  for (const char* name : {"moving_ball", "moving_lamp", "spinning_instance"})
    expect_same_bits(moving_scene(name, -2, -1), without_animations(moving_scene(name, -2, -1)));
}

}  // namespace
}  // namespace mlt::test
