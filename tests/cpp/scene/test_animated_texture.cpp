// Colours that change: values and means against the linear formula, by hand.
#include <gtest/gtest.h>

#include "scene/plugin_testing.h"
#include "scene/texture/animation.h"

namespace mlt {

Plugin texture_animation();
Plugin texture_checkerboard();
Plugin texture_key();

namespace {

using test::expect_close;
using test::make;

std::shared_ptr<Object> key(double time, const Value& value) {
  return make<Object>(texture_key(), {{"time", time}, {"value", value}});
}

std::shared_ptr<AnimatedTexture> animation(const std::vector<std::shared_ptr<Object>>& keys) {
  const Plugin plugin = texture_animation();
  Params params(plugin.schema, {"scene.xml", 7});
  for (const auto& key : keys) params.add("texture", key, {"scene.xml", 8});
  return std::dynamic_pointer_cast<AnimatedTexture>(make_object(plugin, params));
}

/// From (1, 0, 0) at time 1 to (0, 0.5, 0) at time 2, and to (0, 0, 2) at time 4.
std::shared_ptr<AnimatedTexture> three_colors() {
  return animation({key(1, Triple{1, 0, 0}), key(2, Triple{0, 0.5, 0}), key(4, Triple{0, 0, 2})});
}

Shutter shutter(double open, double close) { return {open, close, 1, 1}; }

Color value_at(const Texture& texture, double time, const Vec2& uv = Vec2(0)) {
  SurfacePoint at;
  at.time = time;
  at.uv = uv;
  return texture.eval(at).rgb();
}

TEST(AnimatedTexture, IsLinearBetweenItsKeysAndConstantOutside) {
  const auto colors = three_colors();
  const std::vector<std::pair<double, Color>> expected = {
      {-3, {1, 0, 0}},        {1, {1, 0, 0}},         {1.25, {0.75, 0.125, 0}}, {2, {0, 0.5, 0}},
      {2.5, {0, 0.375, 0.5}}, {3.5, {0, 0.125, 1.5}}, {4, {0, 0, 2}},           {9, {0, 0, 2}}};
  for (const auto& [time, color] : expected)
    expect_close(value_at(*colors, time), color, 1e-15, std::to_string(time));
}

TEST(AnimatedTexture, HasTheMeanOfTheShutter) {
  const std::vector<std::pair<double, double>> shutters = {{1, 4},  {0, 9}, {1.25, 1.75}, {1.5, 3},
                                                           {-2, 0}, {5, 7}, {2, 4}};
  for (const auto& [open, close] : shutters) {
    const auto seen = three_colors()->during(shutter(open, close));
    constexpr int steps = 20000;
    Color sum(0);
    for (int i = 0; i < steps; ++i)
      sum += value_at(*seen, open + (close - open) * (i + 0.5) / steps) / double{steps};
    expect_close(seen->mean(), sum, 1e-7, std::to_string(open));
    EXPECT_FALSE(seen->is_constant());
  }
}

TEST(AnimatedTexture, IsConstantWhileTheShutterOpensForAnInstant) {
  const auto seen = three_colors()->during(shutter(3, 3));
  EXPECT_TRUE(seen->is_constant());
  expect_close(seen->mean(), {0, 0.25, 1}, 1e-15);
  expect_close(value_at(*seen, 0), {0, 0.25, 1}, 1e-15);
  const auto checks = make<Object>(texture_checkerboard());
  EXPECT_FALSE(animation({key(0, 0.5), key(1, checks)})->during(shutter(1, 1))->is_constant());
}

TEST(AnimatedTexture, IsBoundedByTheKeysThatAreSeen) {
  EXPECT_EQ(three_colors()->maximum(), Color(1, 0.5, 2));
  EXPECT_EQ(three_colors()->during(shutter(0, 1.5))->maximum(), Color(1, 0.5, 0));
}

TEST(AnimatedTexture, MixesTexturesPointByPoint) {
  const auto checks = make<Texture>(texture_checkerboard(), {{"color0", 0.1}, {"color1", 0.9}});
  const auto mixed = animation({key(0, 0.5), key(2, checks)});
  for (const Vec2& uv : {Vec2(0.2, 0.2), Vec2(0.2, 0.7)}) {
    SurfacePoint at;
    at.uv = uv;
    expect_close(value_at(*mixed, 0.5, uv), 0.75 * Color(0.5) + 0.25 * checks->eval(at).rgb(),
                 1e-15);
  }
}

/// In a spectral scene an RGB colour is D65 times a reflectance where it is light.
TEST(AnimatedTexture, IsLightUnderD65) {
  const TexturePtr light = as_light(three_colors());
  const TexturePtr still = constant_texture({Color(0, 0.5, 0), RgbMeaning::light});
  SurfacePoint at;
  at.time = 2;
  at.wavelength = 0.4;
  const Spectrum found = light->eval(at), expected = still->eval(at);
  EXPECT_GT(max_component(expected), 0);
  EXPECT_LE(max_component(found - expected), 1e-15);
  EXPECT_LE(max_component(expected - found), 1e-15);
}

std::string error_of(const std::vector<std::shared_ptr<Object>>& keys) {
  try {
    animation(keys);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(AnimatedTexture, IsRefusedWithoutKeysThatFollowEachOther) {
  EXPECT_EQ(error_of({key(0, 0.5)}),
            "scene.xml:7: texture 'animation' has 1 key, but needs two or more");
  EXPECT_EQ(error_of({key(0, 0.5), key(1, 0.5), key(1, 0.3)}),
            "scene.xml:7: texture 'animation' has a key at time 1 after one at time 1; times must "
            "increase");
}

}  // namespace
}  // namespace mlt
