// The layers that a path belongs to.
#include "path/light_layers.h"

#include "scene_pieces.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

ScenePtr lamps(int count) {
  std::string xml = "<scene version='3.0.0'>" + camera("0, 0, 4", "0, 0, 0", 40, film(4, 4));
  for (int i = 0; i < count; ++i)
    xml += "<emitter type='point' id='lamp " + std::to_string(i) + "'/>";
  for (int i = 0; i < 2; ++i) xml += "<emitter type='point'/>";
  return load_string(xml + "</scene>", "", plugins(), {}).scene;
}

/// A path from a lamp, over inner vertices of these kinds.
Path path_of(uint32_t emitter, const std::string& letters) {
  Path path;
  path.vertices.push_back({VertexKind::light, Lobe::smooth, emitter, {}});
  for (const char letter : letters) {
    Vertex inner{VertexKind::inner, letter == 'S' ? Lobe::transmission : Lobe::smooth, 0, {}};
    if (letter == 'M') inner.at.kind = PointKind::medium;
    path.vertices.push_back(inner);
  }
  path.vertices.push_back({VertexKind::camera, Lobe::smooth, 0, {}});
  return path;
}

TEST(LightLayers, TellTheLettersOfAPath) {
  for (const std::string letters : {"", "D", "SSD", "DMSM"})
    EXPECT_EQ(path_class(path_of(0, letters)), "L" + letters + "E");
}

TEST(LightLayers, AreThoseOfTheLampAndOfAllClassesThatMatch) {
  const LightLayers layers(*lamps(2), {true, {{"caustics", "LS+DE"}, {"late", "L.*DE"}}});
  EXPECT_EQ(layers.names(), (std::vector<std::string>{"light.lamp_0", "light.lamp_1", "light.rest",
                                                      "caustics", "late"}));
  EXPECT_EQ(layers.group_count(), 3);
  LightLayers::Finder finder(&layers);
  for (int again = 0; again < 2; ++again) {
    EXPECT_EQ(finder.of(path_of(0, "SD")), 0b11001u);
    EXPECT_EQ(finder.of(path_of(1, "DD")), 0b10010u);
    EXPECT_EQ(finder.of(path_of(3, "DS")), 0b00100u);
  }
  EXPECT_EQ(LightLayers::Finder(nullptr).of(path_of(0, "D")), 0u);
}

TEST(LightLayers, AreAsManyAsASetHasBits) {
  const LightLayers layers(*lamps(62), {true, {}});
  EXPECT_EQ(layers.count(), 63);
  EXPECT_EQ(LightLayers::Finder(&layers).of(path_of(63, "")), uint64_t{1} << 62);
  EXPECT_THROW(LightLayers(*lamps(63), {true, {}}), UsageError);
}

TEST(LightLayers, OfExposuresFollowFromTheTime) {
  const ScenePtr scene = load_scene(
      camera("0, 0, 4", "0, 0, 0", 40, film(4, 4), "perspective",
             "<float name='shutter_open' value='2'/><float name='shutter_close' value='5'/>"
             "<integer name='exposures' value='3'/>") +
      "<emitter type='point'/>");
  const LightLayers layers(*scene, {false, {{"all", ".*"}}, true});
  EXPECT_EQ(layers.names(),
            (std::vector<std::string>{"exposure.1", "exposure.2", "exposure.3", "all"}));
  EXPECT_EQ(layers.group_count(), 3);
  LightLayers::Finder finder(&layers);
  Path path = path_of(0, "D");
  for (const auto& [time, set] : {std::pair{2.0, 0b1001u}, {3.0, 0b1010u}, {4.9, 0b1100u}}) {
    path.time = time;
    EXPECT_EQ(finder.of(path), set) << time;
  }
  EXPECT_THROW(LightLayers(*scene, {true, {}, true}), UsageError);
}

TEST(LightLayers, OfASavedStateExist) {
  EXPECT_NO_THROW(check_layers(0, 0));
  EXPECT_NO_THROW(check_layers(0b111, 3));
  EXPECT_NO_THROW(check_layers(~0u, 32));
  EXPECT_THROW(check_layers(1, 0), RenderError);
  EXPECT_THROW(check_layers(0b1000, 3), RenderError);
}

}  // namespace
}  // namespace mlt::test
