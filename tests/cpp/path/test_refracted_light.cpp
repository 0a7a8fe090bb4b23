// Light that enters a medium through a rough boundary, with and without its technique.
#include <gtest/gtest.h>

#include "along_one_ray.h"
#include "scene_pieces.h"

namespace mlt {
namespace {

using namespace test;

/// A block of coloured wax in a room, beside it a lamp and a small one of no size; `material` is
/// its surface, `inside` lies in it.
ScenePtr wax(const std::string& material, const std::string& inside = "") {
  const std::string medium =
      "<medium type='homogeneous' id='wax'><rgb name='sigma_t' value='2 3 5'/>"
      "<rgb name='albedo' value='0.9 0.7 0.8'/></medium>";
  return load_scene(
      camera("0, 0, 4", "0, 0.1, 0", 40, film(8, 6)) + medium +
      cube(scale(0.7), "<bsdf " + material + "</bsdf><ref name='interior' id='wax'/>") +
      cube(scale(5.2), diffuse("0.4 0.5 0.3")) +
      sphere(-1.6, 0.4, 0.3, 0.2, area_light("30 20 10")) + inside +
      "<emitter type='point'><point name='position' x='0.5' y='1.6' z='-1'/>"
      "<rgb name='intensity' value='.5 .6 .7'/></emitter>");
}

const char* const rough =
    "type='roughdielectric'><float name='alpha' value='0.15'/><float name='int_ior' value='1.4'/>";

void expect_same_mean(const Scene& scene, int max_depth, int samples, double most_variance) {
  EXPECT_TRUE(scene.has_rough_boundaries());
  PathRules with, without;
  with.max_depth = without.max_depth = max_depth;
  with.through_boundaries = true;
  test::expect_same_mean(scene, with, without, samples, most_variance);
}

TEST(RefractedLight, ChangesNoMeanOfLightScatteredOnce) {
  expect_same_mean(*wax(rough), 4, 400000, 0.2);
}

TEST(RefractedLight, ChangesNoMeanOfLightScatteredOften) {
  expect_same_mean(*wax(rough), 12, 100000, 0.5);
}

TEST(RefractedLight, ChangesNoMeanAroundALampInside) {
  expect_same_mean(*wax(rough, sphere(0.3, 0.2, 0.3, 0.1, area_light("2 3 1"))), 6, 200000, 1.1);
}

TEST(RefractedLight, ChangesNoMeanThroughOtherMaterials) {
  const std::string milky =
      "type='openpbr'><float name='transmission_weight' value='0.6'/>"
      "<float name='specular_roughness' value='0.4'/>";
  expect_same_mean(*wax(milky), 6, 200000, 1.1);
  expect_same_mean(*wax("type='difftrans'>"), 6, 200000, 1.1);
}

TEST(RefractedLight, IsThatOfRoughBoundaries) {
  EXPECT_FALSE(wax("type='dielectric'>")->has_rough_boundaries());
  EXPECT_FALSE(wax("type='null'>")->has_rough_boundaries());
  EXPECT_FALSE(load_scene(camera("0, 0, 4", "0, 0.1, 0", 40, film(8, 6)) +
                          cube(scale(1), diffuse("1")) + "<emitter type='constant'/>")
                   ->has_rough_boundaries());
}

}  // namespace
}  // namespace mlt
