// Light that enters a medium through a rough boundary, with and without its technique.
#include <gtest/gtest.h>

#include "harness/statistics.h"
#include "path/path_tracer.h"
#include "path/samplers.h"
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

/// Along one ray, so that little but the technique varies.
Moments radiance(const Scene& scene, bool through_boundaries, int max_depth, int samples) {
  PathRules rules;
  rules.max_depth = max_depth;
  rules.through_boundaries = through_boundaries;
  Moments found;
  RayCounts rays;
  for (int i = 0; i < samples; ++i) {
    Rng rng(through_boundaries, Purpose::test, static_cast<uint64_t>(i));
    RandomSampler sampler(rng);
    const auto start = camera_ray(scene.camera(), Vec2(4, 3), sampler);
    const Color rgb = trace_path(scene, rules, start.ray, sampler, rays);
    found.add(rgb.x + 0.7 * rgb.y + 1.9 * rgb.z);
  }
  return found;
}

/// The variance with the technique over that without.
void expect_same_mean(const Scene& scene, int max_depth, int samples, double most_variance) {
  EXPECT_TRUE(scene.has_rough_boundaries());
  const Moments with = radiance(scene, true, max_depth, samples);
  const Moments without = radiance(scene, false, max_depth, samples);
  EXPECT_GT(welch_t_test(with, without).p_value, 1e-3) << with.mean() << " for " << without.mean();
  EXPECT_LT(with.variance(), most_variance * without.variance());
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
