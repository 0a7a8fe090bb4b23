// Which lights most samples of a place see.
#include "mutation/certain_light.h"
#include "scenes.h"

namespace mlt::test {
namespace {

constexpr double no_bound = CertainLight::no_bound;
const std::string glow = area_light("9 9 9");

/// 22 pixels have the length 1. From the left a lamp, one in a ball of glass, and between them one
/// of a fifth of a pixel, and a wall.
ScenePtr lamps(const std::string& type = "perspective", const std::string& more = "") {
  return load_scene(camera("0, 0, 4", "0, 0, 0", 40, film(64, 48), type, more) +
                    sphere(-0.8, 0, 0, 0.3, glow) + sphere(0.8, 0, 0, 0.2, glow) +
                    sphere(0.8, 0, 0, 0.4, glass) + sphere(0, 0.6, 0, 0.005, glow) +
                    rectangle(scale(4) + translate(0, 0, -1), white));
}
constexpr Vec2 lamp(32 - 0.8 * 22, 24), behind_glass(32 + 0.8 * 22, 24), spot(32, 24 - 0.6 * 22),
    wall(32, 24);

CertainLight light_of(const ScenePtr& scene, int threads = 1) {
  const std::atomic<bool> cancelled{false};
  return {*scene, {}, 4 * 64 * 48, 1, threads, cancelled};
}

TEST(CertainLight, IsWhereALampFillsACell) {
  const CertainLight light = light_of(lamps());
  EXPECT_EQ(light.most_certain(lamp), 0.5);
  EXPECT_EQ(light.most_certain(behind_glass), 0.5);
  EXPECT_EQ(light.most_certain(spot), no_bound);
  EXPECT_EQ(light.most_certain(wall), no_bound);
}

TEST(CertainLight, IsNotWhereALensBlursTheLamp) {
  const CertainLight light =
      light_of(lamps("thinlens",
                     "<float name='aperture_radius' value='1'/><float name='focus_distance' "
                     "value='1.5'/>"));
  EXPECT_EQ(light.most_certain(lamp), no_bound);
}

TEST(CertainLight, IsTheSameForAnyNumberOfThreads) {
  const ScenePtr scene = lamps();
  EXPECT_EQ(light_of(scene, 1).cells(), light_of(scene, 3).cells());
}

TEST(CertainLight, IsSavedAsItsCells) {
  const ScenePtr scene = lamps();
  const CertainLight light = light_of(scene);
  const Raster& raster = scene->camera().raster();
  const CertainLight same(raster, 4 * 64 * 48, light.cells());
  for (const Vec2& position : {lamp, behind_glass, spot, wall})
    EXPECT_EQ(same.most_certain(position), light.most_certain(position));
  EXPECT_THROW(CertainLight(raster, 4 * 64 * 48, {1, 0}), RenderError);
}

}  // namespace
}  // namespace mlt::test
