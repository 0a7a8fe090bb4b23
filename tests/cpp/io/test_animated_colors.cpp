// Animations of colours in scene files: what is read, what the shutter makes of it, what is
// refused.
#include <gtest/gtest.h>

#include "io/animation_times.h"
#include "io/load.h"
#include "job/plugins.h"
#include "scene/scene.h"
#include "scene_files.h"

namespace mlt {
namespace {

using test::message_of;

const std::string keys = "<rgb time='0' value='0.2 0.4 0.6'/><float time='2' value='0.8'/>";

std::string animation(const std::string& content, const std::string& name = "reflectance") {
  return "<animation name='" + name + "'>" + content + "</animation>";
}
std::string square(const std::string& bsdf) {
  return "<shape type='rectangle'><bsdf type='diffuse'>" + bsdf + "</bsdf></shape>";
}

LoadedScene load(const std::string& content, double open = 0, double close = 1) {
  const std::string shutter = "<float name='shutter_open' value='" + std::to_string(open) +
                              "'/><float name='shutter_close' value='" + std::to_string(close) +
                              "'/>";
  return load_string("<scene version='3.0.0'><sensor type='perspective'>" + shutter +
                         "</sensor><emitter type='constant'/>\n" + content + "</scene>",
                     "", plugins(), {});
}
std::string error_of(const std::string& content) {
  return message_of([&] { load(content); });
}

/// What a ray finds that hits the square at this time.
Lambertian found_at(const LoadedScene& loaded, double time) {
  SurfacePoint at;
  EXPECT_TRUE(loaded.scene->intersect({{0.1, 0.2, 2}, {0, 0, -1}, time}, at));
  return at.lambertian;
}

TEST(AnimatedColors, AreWhatARayFindsAtItsTime) {
  const LoadedScene loaded = load(square(animation(keys)));
  EXPECT_FALSE(loaded.scene->shapes()[0]->bsdf().lambertian().uniform());
  for (const double time : {0.0, 0.5, 1.0}) {
    const double b = time / 2;
    const Color expected = (1 - b) * Color(0.2, 0.4, 0.6) + b * Color(0.8);
    EXPECT_LE(length(found_at(loaded, time).f.rgb() * pi - expected), 1e-15) << time;
  }
}

TEST(AnimatedColors, AreConstantForAClosedShutter) {
  const LoadedScene loaded = load(square(animation(keys)), 1, 1);
  EXPECT_TRUE(loaded.scene->shapes()[0]->bsdf().lambertian().uniform());
  EXPECT_LE(length(found_at(loaded, 0).f.rgb() * pi - Color(0.5, 0.6, 0.7)), 1e-15);
}

TEST(AnimatedColors, MayBeTexturesAndReferences) {
  const LoadedScene loaded =
      load("<texture type='checkerboard' id='checks'><float name='color0' value='1'/></texture>" +
           square(animation("<ref time='0' id='checks'/><texture time='1' type='checkerboard'>"
                            "<float name='color0' value='0'/></texture>"
                            "<spectrum time='2' value='0.5'/>")));
  EXPECT_NEAR(found_at(loaded, 0.25).f.rgb().x * pi, 0.75, 1e-15);
}

TEST(AnimatedColors, TellWhenTheyChange) {
  const LoadedScene loaded =
      load(square(animation(keys)) + "<shape type='sphere'>" +
           animation("<transform time='-1'/><transform time='3'><translate x='1'/></transform>"
                     "<transform time='4'><translate x='1'/></transform>",
                     "to_world") +
           "</shape>");
  EXPECT_EQ(animation_times(loaded.tree),
            (std::vector<std::pair<double, double>>{{0, 2}, {-1, 3}}));
}

TEST(AnimatedColors, AreRefusedWithTheirLine) {
  const auto starts = [](const std::string& message, const std::string& start) {
    EXPECT_EQ(message.substr(0, start.size()), start);
  };
  starts(error_of(square(animation("<rgb time='0' value='0.2'/>"))),
         "<string>:2: texture 'animation' has 1 key, but needs two or more");
  starts(error_of(square(animation("<rgb value='0.2'/>"))), "<string>:2: <rgb> needs");
  starts(error_of(square(animation("<rgb time='soon' value='0.2'/>"))),
         "<string>:2: <rgb> has the time 'soon'");
  starts(error_of(square(animation("<rgb time='0' name='a' value='0.2'/>"))),
         "<string>:2: rgb 'a' should have no name");
  starts(error_of(square(animation(keys + "<transform time='3'/>"))),
         "<string>:2: <transform> does not belong in an <animation> of colours");
  starts(error_of(square(animation(keys + "now"))), "<string>:2: animation 'reflectance' contains");
  starts(error_of(square(animation("<transform time='0'/>" + keys))),
         "<string>:2: <rgb> does not belong in an <animation>; give <transform>s");
  starts(error_of(animation(keys)), "<string>:2: animation 'reflectance' has no effect at the top");
  starts(error_of("<shape type='sphere'>" + animation(keys, "radius") + "</shape>"),
         "<string>:2: shape 'sphere': 'radius' cannot change over time");
  starts(error_of("<shape type='sphere'>" + animation(keys, "to_world") + "</shape>"),
         "<string>:2: shape 'sphere': 'to_world' cannot change over time");
}

}  // namespace
}  // namespace mlt
