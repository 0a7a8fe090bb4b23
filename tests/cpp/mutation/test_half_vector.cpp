// The half vector carries a nearly specular vertex along: it goes back the same way, and its
// Jacobian is that of the map from h to the leaving direction, by finite differences.
#include <gtest/gtest.h>

#include "base/rng.h"
#include "math/warp.h"
#include "path/half_vector.h"

namespace mlt::test {
namespace {

constexpr double etas[] = {1.5, 1 / 1.5, 1.33, 1 / 2.4};

Vec3 random_direction(Rng& rng, double least_z = 0.05) {
  for (;;) {
    const double z = 2 * rng.next() - 1, phi = 2 * pi * rng.next(), r = std::sqrt(1 - z * z);
    if (std::abs(z) > least_z) return {r * std::cos(phi), r * std::sin(phi), z};
  }
}

/// Calls see(in, out, h, eta) for what is reflected and refracted about random normals.
template <class See>
void for_each_scattering(int count, See&& see) {
  Rng rng(1, Purpose::test, 0);
  for (int i = 0; i < count; ++i) {
    const Vec3 in = random_direction(rng);
    Vec3 h = random_direction(rng, 0.5);
    if (h.z < 0) h = -h;
    const double eta = etas[rng.below(4)];
    const bool reflected = rng.next() < 0.5;
    const auto out = reflected ? reflect_about(in, h) : refract_about(in, h, eta);
    if (out && std::abs(out->z) > 0.02 && std::abs(dot(in, h)) > 0.05) see(in, *out, h, eta);
  }
}

TEST(HalfVector, IsFoundAgain) {
  int seen = 0;
  for_each_scattering(20000, [&](const Vec3& in, const Vec3& out, const Vec3& h, double eta) {
    EXPECT_NEAR(length(out), 1, 1e-12);
    const auto again = half_vector(in, out, eta);
    ASSERT_TRUE(again);
    EXPECT_NEAR(length(*again - h), 0, 1e-9);
    ++seen;
  });
  EXPECT_GT(seen, 5000);
}

TEST(HalfVector, LeadsFromBothSides) {
  for_each_scattering(20000, [&](const Vec3& in, const Vec3& out, const Vec3& h, double eta) {
    const auto back = same_side(in, out) ? reflect_about(out, h) : refract_about(out, h, 1 / eta);
    ASSERT_TRUE(back);
    EXPECT_NEAR(length(*back - in), 0, 1e-8);
  });
}

TEST(HalfVector, ObeysSnell) {
  for_each_scattering(20000, [&](const Vec3& in, const Vec3& out, const Vec3& h, double eta) {
    if (same_side(in, out)) return;
    EXPECT_NEAR(eta * length(cross(in, h)), length(cross(out, h)), 1e-10);
    EXPECT_LT(dot(in, h) * dot(out, h), 0);
  });
}

TEST(HalfVector, DoesNotExistBeyondTotalReflection) {
  const Vec3 in = normalize(Vec3(1, 0, 0.2)), h(0, 0, 1);
  EXPECT_FALSE(refract_about(in, h, 1.5));
  EXPECT_TRUE(refract_about(in, h, 1 / 1.5));
}

TEST(HalfVector, DoesNotReflectBelowTheSurface) {
  EXPECT_FALSE(reflect_about(normalize(Vec3(1, 0, 0.1)), normalize(Vec3(-0.6, 0, 1))));
}

/// d omega_out / d omega_h by central differences: the area that two small turns of h span.
double numeric_stretch(const Vec3& in, const Vec3& h, double eta, bool reflected) {
  constexpr double step = 1e-5;
  const Frame frame = Frame::around(h);
  const auto leave = [&](const Vec3& turn) {
    const Vec3 turned = normalize(h + turn);
    return reflected ? reflect(in, turned) : *refract_about(in, turned, eta);
  };
  const Vec3 ds = (leave(step * frame.s) - leave(-step * frame.s)) / (2 * step);
  const Vec3 dt = (leave(step * frame.t) - leave(-step * frame.t)) / (2 * step);
  return length(cross(ds, dt));
}

TEST(HalfVector, HasTheJacobianOfItsMap) {
  int seen = 0;
  for_each_scattering(20000, [&](const Vec3& in, const Vec3& out, const Vec3& h, double eta) {
    const bool reflected = same_side(in, out);
    if (!reflected && std::abs(dot(out, h)) < 0.05) return;
    const double stretch = numeric_stretch(in, h, eta, reflected);
    EXPECT_NEAR(half_vector_jacobian(in, out, h, eta) * stretch, 1, 1e-5);
    ++seen;
  });
  EXPECT_GT(seen, 5000);
}

}  // namespace
}  // namespace mlt::test
