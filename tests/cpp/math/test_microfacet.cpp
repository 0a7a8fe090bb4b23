// Microfacet distributions: the identities that define them, and sample / pdf / invert as a triple.
#include "math/microfacet.h"

#include "harness/chi_square.h"
#include "math/erf_inverse.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

Vec2 uniform2(Rng& rng) {
  const double x = rng.next();
  return {x, rng.next()};
}

Vec3 direction(double cos_theta, double phi) {
  const double s = std::sqrt((1 - cos_theta) * (1 + cos_theta));
  return {s * std::cos(phi), s * std::sin(phi), cos_theta};
}

struct Alpha {
  double u, v;
};
constexpr Alpha alphas[] = {{0.001, 0.001}, {0.01, 0.01}, {0.1, 0.1}, {0.1, 0.4},
                            {0.5, 0.02},    {0.5, 0.5},   {1, 1},     {1, 0.001}};
constexpr double cosines[] = {1, 0.999, 0.7, 0.3, 0.05, 0.001, 1e-5};
constexpr MicrofacetType types[] = {MicrofacetType::beckmann, MicrofacetType::ggx};

std::string describe(const Microfacet& d, double cosine) {
  std::ostringstream out;
  out << (d.type() == MicrofacetType::ggx ? "ggx" : "beckmann") << " alpha " << d.alpha_u() << ", "
      << d.alpha_v() << (d.sample_visible() ? " visible" : " all") << " cos " << cosine;
  return out.str();
}

/// The integral of f(m) over the hemisphere, by the midpoint rule in the slope plane: slopes are
/// (alpha_u r cos phi, alpha_v r sin phi) with r = t / (1 - t).
template <class F>
double integrate_normals(const Microfacet& d, F f, int steps = 600) {
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double t = (i + 0.5) / steps, r = t / (1 - t), phi = 2 * pi * (j + 0.5) / steps;
      const Vec3 m =
          normalize(Vec3(d.alpha_u() * r * std::cos(phi), d.alpha_v() * r * std::sin(phi), 1));
      // d(slope) = alpha_u alpha_v r dr dphi, d(slope) = dm / cos^3, dr = dt / (1 - t)^2.
      sum += f(m) * d.alpha_u() * d.alpha_v() * r * m.z * m.z * m.z / sqr(1 - t);
    }
  return sum * 2 * pi / sqr(steps);
}

TEST(Microfacet, ProjectedAreaIsOne) {
  for (MicrofacetType type : types)
    for (const Alpha& a : alphas) {
      const Microfacet d(type, a.u, a.v);
      EXPECT_NEAR(integrate_normals(d, [&](const Vec3& m) { return d.D(m) * m.z; }), 1, 1e-4)
          << describe(d, 1);
    }
}

TEST(Microfacet, VisibleAreaIsTheCosine) {
  for (MicrofacetType type : types)
    for (const Alpha& a : alphas)
      for (double c : {1.0, 0.7, 0.3, 0.05}) {
        const Microfacet d(type, a.u, a.v);
        const Vec3 v = direction(c, 0.8);
        const double area = integrate_normals(
            d, [&](const Vec3& m) { return d.g1(v, m) * std::max(0.0, dot(v, m)) * d.D(m); });
        // The integrand has a kink where m is seen edge-on: the midpoint rule is of second order.
        EXPECT_NEAR(area, c, 2e-4) << describe(d, c);
      }
}

/// Lambda(v) = 1 / G1 - 1 (Heitz 2014, eqs. 66 and 72), for either side.
double lambda(const Microfacet& d, const Vec3& v) {
  const double a = std::abs(v.z) / std::sqrt(sqr(d.alpha_u() * v.x) + sqr(d.alpha_v() * v.y));
  if (d.type() == MicrofacetType::ggx) return 0.5 * (std::sqrt(1 + 1 / (a * a)) - 1);
  if (a > 6) return 0;  // below 1e-18
  return std::exp(-a * a) / (2 * std::sqrt(pi) * a) - 0.5 * std::erfc(a);
}

TEST(Microfacet, MaskingIsAProbabilityAndConsistentWithLambda) {
  for (MicrofacetType type : types)
    for (const Alpha& a : alphas)
      for (double c : cosines) {
        const Microfacet d(type, a.u, a.v);
        const Vec3 v = direction(c, 2.1), m(0, 0, 1), w = direction(0.4, -1);
        const double g = d.g1(v, m);
        EXPECT_GT(g, 0);
        EXPECT_LE(g, 1 + 1e-15);
        EXPECT_NEAR(g * (1 + lambda(d, v)), 1, 1e-9) << describe(d, c);
        EXPECT_EQ(g, d.g1(-v, m));  // on either side
        EXPECT_NEAR(d.g1_fit(v, m) / g, 1, type == MicrofacetType::ggx ? 1e-15 : 0.0035)
            << describe(d, c);
        EXPECT_EQ(d.g1(v, -m), 0);
        EXPECT_EQ(d.G(v, w, m), d.g1_fit(v, m) * d.g1_fit(w, m));
        EXPECT_EQ(d.G(v, -w, m), d.G(v, w, m));  // transmission
        EXPECT_EQ(d.G(v, w, -m), 0);
      }
}

TEST(Microfacet, MatchesMitsuba) {
  const Vec3 wi = normalize(Vec3(1, .5, .4));
  const Vec3 wo = normalize(Vec3(-.3, -.8, .5)), m = normalize(Vec3(.1, -.2, 1));
  const Microfacet beckmann(MicrofacetType::beckmann, 0.2, 0.5), ggx(MicrofacetType::ggx, 0.2, 0.5);
  EXPECT_NEAR(beckmann.D(m), 2.32899, 1e-5);
  EXPECT_NEAR(beckmann.G(wi, wo, m), 0.98800, 1e-5);
  EXPECT_NEAR(ggx.D(m), 1.765186, 1e-6);
  EXPECT_NEAR(ggx.G(wi, wo, m), 0.767077, 1e-6);
  EXPECT_NEAR(ggx.pdf(wi, m), 1.510517, 1e-6);
}

TEST(Microfacet, SamplesFollowTheDensity) {
  // In (z, phi) a lobe of 1000 : 1 is too thin a ridge to integrate; 25 : 1 is not.
  constexpr Alpha tested[] = {{0.001, 0.001}, {0.01, 0.01}, {0.1, 0.1}, {0.1, 0.4},
                              {0.5, 0.02},    {0.5, 0.5},   {1, 1},     {1, 0.05}};
  std::vector<double> p_values;
  std::vector<std::string> names;
  for (MicrofacetType type : types)
    for (const Alpha& a : tested)
      for (double c : {1.0, 0.7, 0.05, 0.001})
        for (bool visible : {true, false}) {
          if (!visible && c != 1.0) continue;
          const Microfacet d(type, a.u, a.v, visible);
          const Vec3 wi = direction(c, 0.8);
          ChiSquareOptions options;
          options.cells = 256;
          options.pilot_samples = 10000;
          const ChiSquareResult r = chi_square_sphere(
              [&](Rng& rng) -> std::optional<Vec3> { return d.sample(wi, uniform2(rng)); },
              [&](const Vec3& m) { return d.pdf(wi, m); }, 50000, 17, options);
          EXPECT_NEAR(r.integral, 1, 2e-3) << describe(d, c) << ": " << r;
          p_values.push_back(r.p_value);
          names.push_back(describe(d, c) + (std::ostringstream() << ": " << r).str());
        }
  const std::vector<bool> rejected = holm(p_values, 1e-3);
  for (size_t i = 0; i < rejected.size(); ++i) EXPECT_FALSE(rejected[i]) << names[i];
}

TEST(Microfacet, AWrongRoughnessIsFound) {
  for (MicrofacetType type : types) {
    const Microfacet d(type, 0.2, 0.2), other(type, 0.204, 0.2);
    const Vec3 wi = direction(0.5, 0.8);
    const ChiSquareResult r = chi_square_sphere(
        [&](Rng& rng) -> std::optional<Vec3> { return d.sample(wi, uniform2(rng)); },
        [&](const Vec3& m) { return other.pdf(wi, m); }, 400000, 17);
    EXPECT_LT(r.p_value, 1e-6) << r;
  }
}

TEST(Microfacet, InvertsItsSamples) {
  Rng rng(5, Purpose::test, 0);
  for (MicrofacetType type : types)
    for (const Alpha& a : alphas)
      for (double c : cosines)
        for (bool visible : {true, false}) {
          const Microfacet d(type, a.u, a.v, visible);
          const Vec3 wi = direction(c, 0.8);
          const bool azimuth = !visible || type == MicrofacetType::ggx;  // u.y is an angle
          double worst = 0;
          for (int i = 0; i < 3000; ++i) {
            const Vec2 u = uniform2(rng);
            const Vec3 m = d.sample(wi, u);
            ASSERT_GT(m.z, 0);
            ASSERT_GT(d.pdf(wi, m), 0) << describe(d, c);
            const Vec2 e = glm::abs(d.invert(wi, m) - u);
            worst = std::max({worst, e.x, azimuth ? std::min(e.y, 1 - e.y) : e.y});
          }
          EXPECT_LT(worst, 1e-7) << describe(d, c);
        }
}

TEST(Microfacet, ExtremeRandomNumbersGiveNormals) {
  for (MicrofacetType type : types)
    for (const Alpha& a : alphas)
      for (double c : cosines)
        for (bool visible : {true, false})
          for (double x : {0.0, 1e-300, 0x1p-53, 0.5, 1 - 0x1p-53})
            for (double y : {0.0, 0x1p-53, 0.5, 1 - 0x1p-53}) {
              const Microfacet d(type, a.u, a.v, visible);
              const Vec3 wi = direction(c, 0.8), m = d.sample(wi, {x, y});
              EXPECT_TRUE(is_finite(m)) << describe(d, c) << " u " << x << " " << y;
              EXPECT_NEAR(length(m), 1, 1e-12);
              EXPECT_TRUE(std::isfinite(d.pdf(wi, m)));
              EXPECT_GE(d.pdf(wi, m), 0);
              const Vec2 u = d.invert(wi, m);
              EXPECT_TRUE(u.x >= 0 && u.x <= 1 && u.y >= 0 && u.y <= 1) << u.x << " " << u.y;
            }
}

TEST(Microfacet, NothingIsNegativeOrNaN) {
  Rng rng(6, Purpose::test, 0);
  for (MicrofacetType type : types)
    for (int i = 0; i < 200000; ++i) {
      const Microfacet d(type, std::pow(10, -4 * rng.next()), std::pow(10, -4 * rng.next()));
      const Vec3 v = direction(2 * rng.next() - 1, 7 * rng.next());
      const Vec3 m = direction(2 * rng.next() - 1, 7 * rng.next());
      for (double x : {d.D(m), d.g1(v, m), d.g1_fit(v, m), d.pdf(v, m), d.G(v, m, m)})
        ASSERT_TRUE(x >= 0 && std::isfinite(x)) << x;
    }
}

TEST(Microfacet, ErfInverse) {
  for (double x : {-5.0, -2.3, -1.0, -1e-3, 0.0, 1e-9, 0.4, 1.7, 3.5})
    EXPECT_NEAR(erf_inverse(std::erf(x)), x, 1e-14 + 2e-16 * std::exp(x * x)) << x;
}

}  // namespace
}  // namespace mlt::test
