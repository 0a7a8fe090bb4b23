// Animations in scene files: what is read, what the shutter makes of it, and what is refused.
#include <gtest/gtest.h>

#include "io/load.h"
#include "io/node_bytes.h"
#include "io/pack.h"
#include "job/plugins.h"
#include "scene/accel/instance.h"
#include "scene_files.h"

#include <array>

namespace mlt {
namespace {

using test::message_of;

const std::string up = "<transform time='0'/><transform time='1'><translate y='2'/></transform>";

std::string animation(const std::string& keys, const std::string& name = "to_world") {
  return "<animation name='" + name + "'>" + keys + "</animation>";
}
std::string sphere(const std::string& inside) {
  return "<shape type='sphere'>" + inside + "</shape>";
}
std::string sensor(double open, double close, const std::string& more = "") {
  return "<sensor type='perspective'><float name='shutter_open' value='" + std::to_string(open) +
         "'/><float name='shutter_close' value='" + std::to_string(close) + "'/>" + more +
         "</sensor>";
}
const std::string light = "<emitter type='constant'/>";

LoadedScene load(const std::string& content) {
  return load_string("<scene>" + content + "</scene>", "", plugins(), {});
}
std::string error_of(const std::string& content) {
  return message_of([&] { load(sensor(0, 1) + light + "\n" + content); });
}

TEST(Animation, IsReadAsTimesAndMatrices) {
  std::vector<std::string> warnings;
  const Node scene = read_xml_string(
      "<scene>" +
          sphere(animation("<transform time='-0.5'><scale value='2'/><translate x='1'/>"
                           "</transform><transform time='2'/>",
                           "toWorld")) +
          "</scene>",
      "", {}, warnings);
  const Node::Property& property = scene.children[0].properties.at(0);
  EXPECT_EQ(property.name, "toWorld");
  const auto& keys = std::get<Animation>(property.value);
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].time, -0.5);
  EXPECT_EQ(keys[1].time, 2);
  EXPECT_EQ(keys[0].transform, (Matrix{2, 0, 0, 1, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1}));
  EXPECT_EQ(keys[1].transform, (Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
}

TEST(Animation, MovesAShapeWhileTheShutterIsOpen) {
  const LoadedScene loaded = load(sensor(0.25, 0.75) + light + sphere(animation(up)));
  const Instance* moving = loaded.scene->shapes().at(0)->as_instance();
  ASSERT_TRUE(moving);
  EXPECT_EQ(moving->motion().at(0.25)[3], Vec4(0, 0.5, 0, 1));
  EXPECT_EQ(moving->motion().at(0.75)[3], Vec4(0, 1.5, 0, 1));
  Vec3 low, high;
  moving->bounds(low, high);
  EXPECT_EQ(low, Vec3(-1, -0.5, -1));
  EXPECT_EQ(high, Vec3(1, 2.5, 1));
}

TEST(Animation, IsAStillWhereNothingMoves) {
  for (const auto& [open, close, y] :
       std::vector<std::array<double, 3>>{{0.5, 0.5, 1}, {-2, 0, 0}, {1, 4, 2}}) {
    const LoadedScene loaded = load(sensor(open, close) + light + sphere(animation(up)));
    ASSERT_FALSE(loaded.scene->shapes().at(0)->as_instance());
    Vec3 low, high;
    loaded.scene->shapes()[0]->bounds(low, high);
    EXPECT_EQ(low, Vec3(-1, y - 1, -1));
  }
}

TEST(Animation, MovesCamerasAndLights) {
  const LoadedScene loaded =
      load(sensor(0, 1, animation(up)) + "<emitter type='point'>" + animation(up) +
           "</emitter><emitter type='spot'>" + animation(up) + "</emitter>" +
           sphere(animation(up) + "<emitter type='area'/>"));
  for (const double time : {0.0, 0.25, 1.0}) {
    EXPECT_EQ(loaded.scene->camera().sample_position(Vec2(0.5), time).at.p, Vec3(0, 2 * time, 0));
    for (int i = 0; i < 2; ++i)
      EXPECT_EQ(loaded.scene->emitters()[i]->sample_position(Vec2(0.5), time).at.p,
                Vec3(0, 2 * time, 0));
    const SurfacePoint x0 = loaded.scene->emitters()[2]->sample_position({0.1, 0.6}, time).at;
    EXPECT_NEAR(length(x0.p - Vec3(0, 2 * time, 0)), 1, 1e-12);
    EXPECT_EQ(loaded.scene->emitter(x0), loaded.scene->emitters()[2].get());
  }
}

TEST(Animation, OfAnInstanceMovesItsGroup) {
  const LoadedScene loaded =
      load(sensor(0, 1) + light + "<shape type='shapegroup' id='a'>" + sphere("") + sphere("") +
           "</shape><shape type='instance'>" + animation(up) + "<ref id='a'/></shape>");
  const Instance* instance = loaded.scene->shapes().at(0)->as_instance();
  ASSERT_TRUE(instance);
  EXPECT_TRUE(instance->motion().moves());
  EXPECT_EQ(instance->group().shapes().size(), 2u);
}

TEST(Animation, SurvivesBytes) {
  const LoadedScene loaded = load(sensor(0, 1) + light + sphere(animation(up)));
  const LoadedScene again = unpack_scene(pack(loaded), plugins());
  EXPECT_EQ(again.hash, loaded.hash);
  EXPECT_EQ(again.scene->bounds().radius, loaded.scene->bounds().radius);
  EXPECT_TRUE(again.scene->shapes()[0]->as_instance());
  const LoadedScene other =
      load(sensor(0, 1) + light +
           sphere(animation("<transform time='0'/><transform time='1'><translate y='3'/>"
                            "</transform>")));
  EXPECT_NE(other.hash, loaded.hash);
}

TEST(Animation, IsRefusedWithItsLine) {
  const auto starts = [](const std::string& message, const std::string& start) {
    EXPECT_EQ(message.substr(0, start.size()), start);
  };
  starts(error_of(sphere(animation(""))),
         "<string>:2: shape 'sphere': 'to_world' has 0 transforms");
  starts(error_of(sphere(animation("<transform time='0'/>"))),
         "<string>:2: shape 'sphere': 'to_world' has 1 transform, but an animation needs two");
  starts(error_of(sphere(animation("<transform time='1'/><transform time='1'/>"))),
         "<string>:2: shape 'sphere': 'to_world' has a transform at time 1 after one at time 1");
  starts(error_of(sphere(animation("<transform time='0'/><transform time='1'><scale x='0'/>"
                                   "</transform>"))),
         "<string>:2: shape 'sphere': 'to_world' is singular");
  starts(error_of(sphere(animation("<transform time='0'/><transform time='1'><scale x='-1'/>"
                                   "</transform>"))),
         "<string>:2: shape 'sphere': 'to_world' mirrors at one");
  starts(error_of(sphere(animation("<transform/>"))), "<string>:2: <transform> needs");
  starts(error_of(sphere(animation("<transform time='soon'/>"))),
         "<string>:2: <transform> has the time 'soon'");
  starts(error_of(sphere(animation("<scale value='2'/>"))),
         "<string>:2: <scale> does not belong in an <animation>");
  starts(error_of(sphere(animation("now"))), "<string>:2: animation 'to_world' contains a text");
  starts(error_of(animation(up)), "<string>:2: animation 'to_world' has no effect at the top");
}

TEST(Animation, IsRefusedWhereNothingCanMove) {
  const auto refused = [](const std::string& content, const std::string& title) {
    const std::string message = error_of(content);
    EXPECT_NE(message.find(title), std::string::npos) << message;
    EXPECT_NE(message.find("is an animation, but should be a"), std::string::npos) << message;
  };
  refused("<bsdf type='diffuse'><texture name='reflectance' type='checkerboard'>" +
              animation(up, "to_uv") + "</texture></bsdf>",
          "texture 'checkerboard': 'to_uv'");
  refused("<emitter type='directional'>" + animation(up) + "</emitter>",
          "emitter 'directional': 'to_world'");
  refused(sphere(animation(up, "radius")), "shape 'sphere': 'radius'");
  EXPECT_NE(error_of("<shape type='shapegroup' id='a'>" + sphere(animation(up)) + "</shape>")
                .find("a shape that moves cannot be in a group"),
            std::string::npos);
  const std::string zoom =
      "<transform time='0'/><transform time='1'><scale value='2'/></transform>";
  EXPECT_NE(message_of([&] {
              load("<sensor type='orthographic'><float name='shutter_close' value='1'/>" +
                   animation(zoom) + "</sensor>" + light);
            }).find("sensor 'orthographic': 'to_world' zooms"),
            std::string::npos);
}

}  // namespace
}  // namespace mlt
