#include "math/fresnel.h"

#include <gtest/gtest.h>

#include <complex>

namespace mlt::test {
namespace {

TEST(Fresnel, NormalIncidence) {
  for (double eta : {1.1, 1.5, 2.4, 0.7}) {
    EXPECT_NEAR(fresnel_dielectric(1, eta).reflectance, sqr((eta - 1) / (eta + 1)), 1e-15);
    EXPECT_NEAR(fresnel_dielectric(-1, eta).reflectance, sqr((eta - 1) / (eta + 1)), 1e-15);
  }
}

TEST(Fresnel, GrazingIncidenceReflectsAll) {
  EXPECT_EQ(fresnel_dielectric(0, 1.5).reflectance, 1);
  EXPECT_NEAR(fresnel_dielectric(1e-9, 1.5).reflectance, 1, 1e-8);
  EXPECT_NEAR(fresnel_conductor(0, 0.2, 3.9), 1, 1e-15);
}

TEST(Fresnel, TotalInternalReflection) {
  const double critical = std::sqrt(1 - 1 / sqr(1.5));
  const Fresnel inside = fresnel_dielectric(-(critical - 1e-6), 1.5);
  EXPECT_EQ(inside.reflectance, 1);
  EXPECT_EQ(inside.cos_t, 0);
  EXPECT_LT(fresnel_dielectric(-(critical + 1e-6), 1.5).reflectance, 1);
}

TEST(Fresnel, EqualIndicesDoNothing) {
  for (double c : {1.0, 0.2, 0.0, -0.4}) {
    const Fresnel f = fresnel_dielectric(c, 1);
    EXPECT_EQ(f.reflectance, 0);
    EXPECT_EQ(f.cos_t, -c);
  }
}

TEST(Fresnel, ReversibleAlongTheRefractedRay) {
  for (double c = -0.99; c < 1; c += 0.0371) {
    const Fresnel there = fresnel_dielectric(c, 1.5);
    if (there.reflectance == 1) continue;
    const Fresnel back = fresnel_dielectric(there.cos_t, 1.5);
    EXPECT_NEAR(back.reflectance, there.reflectance, 1e-12) << c;
    EXPECT_NEAR(back.cos_t, c, 1e-12);
    EXPECT_NEAR(back.eta_it, there.eta_ti, 1e-15);
  }
}

TEST(Fresnel, BrewsterAngleHasNoParallelReflection) {
  // At tan(theta) = eta, R_p = 0 and R_s = ((eta^2 - 1) / (eta^2 + 1))^2.
  const double eta = 1.5, c = 1 / std::sqrt(1 + eta * eta);
  EXPECT_NEAR(fresnel_dielectric(c, eta).reflectance, 0.5 * sqr((eta * eta - 1) / (eta * eta + 1)),
              1e-15);
}

TEST(Fresnel, RefractionObeysSnell) {
  const Vec3 m = normalize(Vec3(0.2, -0.3, 0.9));
  for (const Vec3& d : {Vec3(0.3, 0.4, 0.6), Vec3(-0.7, 0.1, 0.2), Vec3(0.1, 0.1, -0.9)}) {
    const Vec3 w = normalize(d);
    const Fresnel f = fresnel_dielectric(dot(w, m), 1.4);
    const Vec3 t = refract(w, m, f.cos_t, f.eta_ti);
    EXPECT_NEAR(length(t), 1, 1e-14);
    EXPECT_NEAR(dot(t, m), f.cos_t, 1e-14);
    EXPECT_NEAR(length(cross(t, m) * f.eta_it + cross(w, m)), 0, 1e-14);
    const Fresnel g = fresnel_dielectric(w.z, 1.4);
    EXPECT_NEAR(length(refract(w, g.cos_t, g.eta_ti) - refract(w, {0, 0, 1}, g.cos_t, g.eta_ti)), 0,
                1e-14);
  }
}

TEST(Fresnel, ConductorMatchesComplexArithmetic) {
  using Complex = std::complex<double>;
  for (const Complex n : {Complex(0.2, 3.9), Complex(1.5, 0), Complex(2.9, 3.1), Complex(0, 1)})
    for (double c = 0.01; c <= 1; c += 0.03) {
      const Complex ct = std::sqrt(1.0 - (1 - c * c) / (n * n));
      const double expected =
          0.5 * (std::norm((c - n * ct) / (c + n * ct)) + std::norm((n * c - ct) / (n * c + ct)));
      EXPECT_NEAR(fresnel_conductor(c, n.real(), n.imag()), expected, 1e-12) << n << " " << c;
    }
}

TEST(Fresnel, TransparentConductorIsADielectric) {
  for (double c = 0.01; c <= 1; c += 0.03)
    EXPECT_NEAR(fresnel_conductor(c, 1.5, 0), fresnel_dielectric(c, 1.5).reflectance, 1e-12);
}

/// Walsh's closed form (1926) as given by Duntley 1942, "The optical properties of diffusing
/// materials", for m > 1.
double walsh(double m) {
  const double m2 = m * m, m4 = m2 * m2;
  return 0.5 + (m - 1) * (3 * m + 1) / (6 * sqr(m + 1)) +
         m2 * sqr(m2 - 1) / std::pow(m2 + 1, 3) * std::log((m - 1) / (m + 1)) -
         2 * m * m2 * (m2 + 2 * m - 1) / ((m2 + 1) * (m4 - 1)) +
         8 * m4 * (m4 + 1) / ((m2 + 1) * sqr(m4 - 1)) * std::log(m);
}

TEST(Fresnel, DiffuseReflectanceMatchesTheClosedForm) {
  for (double m : {1.2, 1.33, 1.5, 1.9, 2.419, 4.0})
    EXPECT_NEAR(fresnel_diffuse_reflectance(m), walsh(m), 1e-10) << m;
}

TEST(Fresnel, DiffuseReflectanceFromInside) {
  EXPECT_EQ(fresnel_diffuse_reflectance(1), 0);
  // Fine midpoint sums over both sides of the critical angle.
  for (double m : {1.000277, 1.5, 2.4}) {
    constexpr int n = 2000000;
    double outside = 0, inside = 0;
    for (int i = 0; i < n; ++i) {
      const double c = std::sqrt((i + 0.5) / n);  // uniform in c^2: 2 c dc
      outside += fresnel_dielectric(c, m).reflectance;
      inside += fresnel_dielectric(-c, m).reflectance;
    }
    EXPECT_NEAR(fresnel_diffuse_reflectance(m), outside / n, 1e-6) << m;
    EXPECT_NEAR(fresnel_diffuse_reflectance(1 / m), inside / n, 1e-6) << m;
  }
}

}  // namespace
}  // namespace mlt::test
