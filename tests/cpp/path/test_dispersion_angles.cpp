// Walks through a prism and through a drop of water, against geometry.
#include <gtest/gtest.h>

#include "math/dispersion.h"
#include "path/walk.h"
#include "scenes.h"

namespace mlt::test {
namespace {

/// The u of a wavelength: the inverse of wavelength_of.
double u_of_nm(double nm) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i)
    (wavelength_of(0.5 * (low + high)) < nm ? low : high) = 0.5 * (low + high);
  return low;
}

/// The direction in which a ray leaves, after it has been scattered by these lobes.
Vec3 follow(const Scene& scene, const Vec3& o, const Vec3& d, double nm,
            const std::vector<Lobe>& lobes) {
  RayCounts rays;
  const Walker walker{scene, 0, rays};
  Ray ray{o, d};
  ray.wavelength = u_of_nm(nm);
  for (const Lobe lobe : lobes) {
    SurfacePoint at;
    EXPECT_TRUE(walker.arrive(ray, 0, at));
    // the first number chooses the lobe: reflection comes first
    const auto sample =
        BsdfAt(scene, at).sample(-ray.d, {lobe == Lobe::reflection ? 0 : 0.999999, 0.5, 0.5});
    if (!sample || sample->lobe != lobe) return Vec3(0);
    ray = walker.leave(at, sample->w);
  }
  return ray.d;
}

ScenePtr scene_of(const std::string& shape, const std::string& ior) {
  return load_string(
             "<scene version='3.0.0'><sensor type='perspective'>"
             "<transform name='to_world'><lookat origin='0, 0, 9' target='0, 0, 0' "
             "up='0, 1, 0'/></transform><film type='hdrfilm'><boolean name='spectral' "
             "value='true'/></film></sensor><emitter type='constant'/>" +
                 shape + "<bsdf type='dielectric'><string name='int_ior' value='" + ior +
                 "'/><float name='ext_ior' value='1'/></bsdf></shape></scene>",
             "", plugins(), {})
      .scene;
}

/// The deviation by a prism with the refracting angle A, of light that arrives at the angle i:
/// i + e - A, with sin e = n sin(A - asin(sin i / n)) (Born & Wolf, sec. 4.7.2).
double deviation(double n, double A, double i) {
  return i + std::asin(n * std::sin(A - std::asin(std::sin(i) / n))) - A;
}

TEST(Dispersion, IsThatOfAPrism) {
  // A cube, of which two faces at a right angle are the prism: A = 90 degrees.
  const RefractiveIndex glass = RefractiveIndex::cauchy(1.08, 6000);
  const ScenePtr scene = scene_of("<shape type='cube'>", "cauchy 1.08 6000");
  const double A = pi / 2, i = 50 * degree;
  double last = 10;
  for (int k = 0; k < 10; ++k) {
    const double nm = 380 + 40 * k, expected = deviation(glass.at(nm), A, i);
    // into the face at x = 1 from the right, out of that at y = 1; rotated in the plane z = 0
    const Vec3 in(-std::cos(i), std::sin(i), 0);
    const Vec3 out = follow(*scene, Vec3(1, 0.8, 0) - 3.0 * in, in, nm,
                            {Lobe::transmission, Lobe::transmission});
    ASSERT_GT(length(out), 0.5) << nm;
    EXPECT_NEAR(std::acos(dot(in, out)), expected, 1e-6) << nm;
    EXPECT_LT(expected, last);
    last = expected;
  }
}

/// The largest angle between the sun and the bow of light that a drop has reflected once inside.
double bow_angle(const Scene& scene, double nm) {
  double largest = 0;
  for (double b = 0.8; b < 0.92; b += 0.0005) {  // around the ray of least deviation
    const Vec3 in(0, 0, -1);
    const Vec3 out = follow(scene, {b, 0, 5}, in, nm,
                            {Lobe::transmission, Lobe::reflection, Lobe::transmission});
    if (length(out) > 0.5) largest = std::max(largest, std::acos(dot(-in, out)));
  }
  return largest / degree;
}

/// Descartes' and Newton's angles of the primary bow: red at 42.4, violet at 40.6 degrees.
TEST(Dispersion, MakesARainbow) {
  const ScenePtr scene = scene_of("<shape type='sphere'>", "water");
  EXPECT_NEAR(bow_angle(*scene, 700), 42.4, 0.1);
  EXPECT_NEAR(bow_angle(*scene, 400), 40.6, 0.1);
}

TEST(Dispersion, IsNoneOfADefault) {
  const ScenePtr scene = load_string(
                             "<scene version='3.0.0'><sensor type='perspective'/><emitter "
                             "type='constant'/><shape type='sphere'><bsdf type='dielectric'/>"
                             "</shape></scene>",
                             "", plugins(), {})
                             .scene;
  SurfacePoint at;
  ASSERT_TRUE(scene->intersect({{0, 0, 5}, {0, 0, -1}}, at));
  at.wavelength = 0.1;
  const double eta = scene->bsdf(at).relative_eta(at, {0, 0, 1});
  at.wavelength = 0.9;
  EXPECT_EQ(scene->bsdf(at).relative_eta(at, {0, 0, 1}), eta);
}

}  // namespace
}  // namespace mlt::test
