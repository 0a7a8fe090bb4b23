// Light that enters a medium through a rough boundary, with and without its technique.
#include <gtest/gtest.h>

#include "along_one_ray.h"
#include "path/inspect.h"
#include "path_testing.h"
#include "scene_pieces.h"

namespace mlt {
namespace {

using namespace test;

/// A block of coloured wax; `material` is its surface.
ScenePtr block(const std::string& material, const std::string& around) {
  const std::string medium =
      "<medium type='homogeneous' id='wax'><rgb name='sigma_t' value='2 3 5'/>"
      "<rgb name='albedo' value='0.9 0.7 0.8'/></medium>";
  return load_scene(
      camera("0, 0, 4", "0, 0.1, 0", 40, film(8, 6)) + medium +
      cube(scale(0.7), "<bsdf " + material + "</bsdf><ref name='interior' id='wax'/>") + around);
}

/// The block in a room, beside it a lamp and a small one of no size; `inside` lies in it.
ScenePtr wax(const std::string& material, const std::string& inside = "") {
  return block(material, cube(scale(5.2), diffuse("0.4 0.5 0.3")) +
                             sphere(-1.6, 0.4, 0.3, 0.2, area_light("30 20 10")) + inside +
                             "<emitter type='point'><point name='position' x='0.5' y='1.6' z='-1'/>"
                             "<rgb name='intensity' value='.5 .6 .7'/></emitter>");
}

/// The block under a sun of no size.
ScenePtr sunny(const std::string& material) {
  return block(material,
               "<emitter type='directional'><vector name='direction' x='1' y='-1' z='-1.5'/>"
               "<rgb name='irradiance' value='3 2 1'/></emitter>");
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

TEST(RefractedLight, ChangesNoMeanUnderASun) { expect_same_mean(*sunny(rough), 6, 200000, 0.5); }

TEST(RefractedLight, ChangesNoMeanThroughOtherMaterials) {
  const std::string milky =
      "type='openpbr'><float name='transmission_weight' value='0.6'/>"
      "<float name='specular_roughness' value='0.4'/>";
  expect_same_mean(*wax(milky), 6, 200000, 1.1);
  expect_same_mean(*wax("type='difftrans'>"), 6, 200000, 1.1);
}

BidirectionalSettings all_techniques(int max_depth, bool through_boundaries) {
  BidirectionalSettings settings = without_roulette(max_depth);
  settings.rules.through_boundaries = through_boundaries;
  return settings;
}

/// The sampler caches sums along its walks; the terms of the whole path have the same weights.
TEST(RefractedLight, WeighsPathsByTheirTerms) {
  for (const ScenePtr& scene : {wax(rough), sunny(rough)}) {
    BidirectionalSettings settings = all_techniques(6, true);
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
      settings.heuristic = heuristic;
      Worst worst;
      int assembled = 0, others = 0;
      for_each_path(*scene, settings, 1, 3000, [&](const Connection& c, const Path& path) {
        RayCounts rays;
        PathTerms terms;
        ExtraTechnique extra;
        compute_terms(*scene, path, {true}, terms);
        if (is_black(relative_contribution(terms))) return;  // in the tail of a lobe
        const auto weight_of = [&](const Path& x) {
          compute_terms(*scene, x, {true}, terms);
          extra = refracted_technique({*scene, x.time, rays}, x, terms);
          return std::vector<double>{weights_by_terms(c, terms, extra, heuristic).chosen};
        };
        worst.add(excess(*scene, path, weight_of, {c.weight}), technique_name(*scene, c, path));
        assembled += c.assembled;
        others += !c.assembled && extra.count > 0;
      });
      EXPECT_LT(worst.value, 1) << worst.where;
      EXPECT_GT(assembled, 100);
      EXPECT_GT(others, 100);
    }
  }
}

/// The light of samples along one ray, by the techniques that join walks to the lens nowhere else.
Moments bidirectional_along_one_ray(const Scene& scene, bool through_boundaries, int samples) {
  BidirectionalSettings settings = all_techniques(6, through_boundaries);
  settings.light_image = false;
  BidirectionalSampler paths(scene, settings);
  Moments found;
  RayCounts rays;
  for (int i = 0; i < samples; ++i) {
    Rng rng(2 + through_boundaries, Purpose::test, static_cast<uint64_t>(i));
    RandomSampler sampler(rng);
    paths.sample(Vec2(4, 3), sampler, rays);
    double sum = 0;
    paths.connect_all(rays, [&](const Connection& c) {
      const Color rgb = c.contribution * c.weight * radiance_scale(scene);
      sum += rgb.x + 0.7 * rgb.y + 1.9 * rgb.z;
    });
    found.add(sum);
  }
  return found;
}

TEST(RefractedLight, ChangesNoMeanOfBidirectionalPathTracing) {
  for (const ScenePtr& scene : {wax(rough), sunny(rough)}) {
    const Moments with = bidirectional_along_one_ray(*scene, true, 60000),
                  without = bidirectional_along_one_ray(*scene, false, 60000);
    EXPECT_GT(welch_t_test(with, without).p_value, 1e-3) << with.mean() << " " << without.mean();
    EXPECT_LT(with.variance(), 0.5 * without.variance());
  }
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
