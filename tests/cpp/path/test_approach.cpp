// Equiangular distances, and light near lamps in a medium with and without their technique.
#include <gtest/gtest.h>

#include "along_one_ray.h"
#include "scene_pieces.h"

namespace mlt {
namespace {

using namespace test;

// ---- distances

/// Their density from 0 to t, by the midpoint rule.
double cumulated(const Equiangular& distances, double t) {
  constexpr int steps = 200000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += distances.pdf((i + 0.5) / steps * t);
  return sum * t / steps;
}

TEST(Equiangular, SamplesItsDensity) {
  const Vec3 start(1, 2, 3), w = normalize(Vec3(1, 1, 0.5));
  for (const double along : {-1.0, 0.4, 7.0})
    for (const double most : {3.0, infinity}) {
      const Vec3 light = start + along * w + 0.1 * normalize(Vec3(1, -1, 0));
      const Equiangular distances(start, w, most, light);
      for (const double u : {0.1, 0.5, 0.93})
        EXPECT_NEAR(cumulated(distances, distances.sample(u)), u, 1e-6) << along << " " << most;
      EXPECT_NEAR(distances.sample(0), 0, 1e-12);
    }
}

TEST(Equiangular, HasNoDensityOnRaysThroughTheLight) {
  const Vec3 w(0, 0, 1);
  EXPECT_EQ(Equiangular(Vec3(0), w, 5, Vec3(0, 0, 2)).pdf(1), 0);
}

// ---- paths

/// A lens in a box of coloured haze, or before it, and in it a lamp of this radius and a faint one
/// of no size.
ScenePtr hazy_room(bool outside, double radius) {
  const std::string haze =
      "<medium type='homogeneous' id='haze'><rgb name='sigma_t' value='0.1 0.2 0.4'/>"
      "<rgb name='albedo' value='0.9 0.7 0.8'/><phase type='hg'><float name='g' value='0.9'/>"
      "</phase></medium>";
  return load_scene(camera(outside ? "0, 0, 5" : "0, 0, 2", "0, 0.1, 0", 40, film(8, 6)) + haze +
                    cube(scale(2.5), "<bsdf type='null'/><ref name='interior' id='haze'/>") +
                    cube(scale(5.2), diffuse("0.4 0.5 0.3")) +
                    sphere(-1.2 * radius - 0.1, 0.1, 0, radius, area_light("3 2 1")) +
                    "<emitter type='point'><point name='position' x='0.5' y='-0.1' z='-1'/>"
                    "<rgb name='intensity' value='.01 .02 .03'/></emitter>");
}

void expect_same_mean(const Scene& scene, int max_depth, int samples) {
  PathRules with, without;
  with.max_depth = without.max_depth = max_depth;
  with.equiangular = true;
  test::expect_same_mean(scene, with, without, samples, 0.8);
}

TEST(Approach, ChangesNoMeanNearALargeLamp) { expect_same_mean(*hazy_room(false, 0.8), 2, 800000); }

TEST(Approach, ChangesNoMeanNearASmallLampSeenFromOutside) {
  expect_same_mean(*hazy_room(true, 0.05), 5, 200000);
}

}  // namespace
}  // namespace mlt
