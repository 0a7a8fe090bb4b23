// Every warp as a triple: samples follow the density, the density integrates to one, and the
// inverse gives back the random numbers.
#include "math/warp.h"

#include "harness/chi_square.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

constexpr size_t n_samples = 100000;
constexpr double level = 1e-4;

Vec2 uniform2(Rng& rng) {
  const double x = rng.next();
  return {x, rng.next()};
}

/// The largest error of invert(sample(u)); azimuths of 0 and 1 turn are the same.
template <class Sample, class Invert>
double round_trip_error(Sample sample, Invert invert, bool azimuth) {
  Rng rng(7, Purpose::test, 0);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vec2 u = uniform2(rng);
    const Vec2 d = glm::abs(invert(sample(u)) - u);
    worst = std::max({worst, d.x, azimuth ? std::min(d.y, 1 - d.y) : d.y});
  }
  return worst;
}

template <class Sample, class Pdf, class Invert>
void check_direction(Sample sample, Pdf pdf, Invert invert, bool azimuth) {
  const ChiSquareResult r = chi_square_sphere(
      [&](Rng& rng) -> std::optional<Vec3> { return sample(uniform2(rng)); }, pdf, n_samples, 11);
  EXPECT_GT(r.p_value, level) << r;
  EXPECT_NEAR(r.integral, 1, 1e-3) << r;
  EXPECT_LT(round_trip_error(sample, invert, azimuth), 1e-8);
}

TEST(Warp, SinCosOfTurns) {
  double worst = 0;
  for (int i = -4096; i <= 4096; ++i) {
    const double u = i * (0x1p-10 + 0x1p-17);  // exact: it must not depend on contraction
    const long double x = 2 * 3.14159265358979323846264338327950288L * u;
    const SinCos a = sincos_turns(u);
    worst = std::max(
        {worst, std::abs(double(a.sin - std::sin(x))), std::abs(double(a.cos - std::cos(x)))});
  }
  EXPECT_LT(worst, 1e-15);
  EXPECT_EQ(sincos_turns(0.25).sin, 1);
  EXPECT_EQ(sincos_turns(0.5).cos, -1);
}

TEST(Warp, SignedTurnsAreThoseOfTheArcTangent) {
  Rng rng(3, Purpose::test, 0);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    const double azimuth = 2 * pi * rng.next(), stretch = std::exp2(120 * rng.next() - 60);
    const double x = std::cos(azimuth), y = std::sin(azimuth) * (i % 2 ? 1 : stretch);
    const long double expected =
        std::atan2(static_cast<long double>(y), static_cast<long double>(x)) /
        (2 * 3.14159265358979323846264338327950288L);
    worst = std::max(worst, std::abs(static_cast<double>(signed_turns(x, y) / expected - 1)));
  }
  EXPECT_LT(worst, 5e-16);
  EXPECT_EQ(signed_turns(-1., 0.), 0.5);
  EXPECT_EQ(signed_turns(0., -2.), -0.25);
  EXPECT_EQ(signed_turns(3., 3.), 0.125);
}

TEST(Warp, TurnsStayBelowOne) {
  EXPECT_LT(turns(1, -1e-300), 1);
  EXPECT_EQ(turns(1, 0), 0);
  EXPECT_EQ(turns(0, 0), 0);
}

TEST(Warp, Disk) {
  const ChiSquareResult r = chi_square_rect(
      [](Rng& rng) -> std::optional<Vec2> {
        const Vec2 p = sample_disk(uniform2(rng));
        return Vec2(dot(p, p), std::atan2(p.y, p.x));  // equal areas
      },
      [](const Vec2&) { return 0.5 * disk_pdf(); }, {0, -pi}, {1, pi}, n_samples, 11);
  EXPECT_GT(r.p_value, level) << r;
  EXPECT_NEAR(r.integral, 1, 1e-6);
  EXPECT_LT(round_trip_error(sample_disk, invert_disk, false), 1e-12);
  EXPECT_EQ(sample_disk({0.5, 0.5}), Vec2(0));
  EXPECT_EQ(invert_disk({0, 0}), Vec2(0.5));
}

TEST(Warp, CosineHemisphere) {
  check_direction(sample_cosine_hemisphere<double>, cosine_hemisphere_pdf, invert_cosine_hemisphere,
                  false);
}

TEST(Warp, UniformSphere) {
  check_direction(
      sample_uniform_sphere, [](const Vec3&) { return uniform_sphere_pdf(); },
      invert_uniform_sphere, true);
}

TEST(Warp, Cone) {
  for (double height : {2.0, 1.0, 0.3, 1e-2, 1e-5, 1e-10}) {
    SCOPED_TRACE(height);
    const auto sample = [=](const Vec2& u) { return sample_cone(u, height); };
    const auto invert = [=](const Vec3& w) { return invert_cone(w, height); };
    EXPECT_LT(round_trip_error(sample, invert, true), 1e-8);
    const ChiSquareResult r = chi_square_rect(
        [=](Rng& rng) -> std::optional<Vec2> {
          const Vec3 w = sample(uniform2(rng));
          return Vec2((1 - w.z) / height, std::atan2(w.y, w.x));
        },
        [=](const Vec2&) { return cone_pdf(height) * height; }, {0, -pi}, {1 + 1e-5, pi}, n_samples,
        13,
        [] {
          ChiSquareOptions options;
          options.x_breaks = {1};
          return options;
        }());
    EXPECT_NEAR(r.integral, 1 + 1e-5, 1e-8) << r;
    EXPECT_GT(r.p_value, level) << r;
  }
  EXPECT_EQ(cone_pdf(Vec3(0, 0, 0.4), 0.5), 0);
  EXPECT_GT(cone_pdf(Vec3(0, 0, 0.6), 0.5), 0);
}

TEST(Warp, CosinePower) {
  for (double n : {0.0, 1.0, 20.0, 1e3, 1e6}) {
    SCOPED_TRACE(n);
    check_direction([=](const Vec2& u) { return sample_cosine_power(u, n); },
                    [=](const Vec3& w) { return cosine_power_pdf(w, n); },
                    [=](const Vec3& w) { return invert_cosine_power(w, n); }, true);
  }
}

TEST(Warp, LobeAboutAnAxis) {
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(0, 0, -1), normalize(Vec3(1, -2, 0.1))})
    check_direction([=](const Vec2& u) { return sample_lobe(u, axis, 30.0); },
                    [=](const Vec3& w) { return lobe_pdf(w, axis, 30); },
                    [=](const Vec3& w) { return invert_lobe(w, axis, 30); }, true);
}

TEST(Warp, Triangle) {
  const auto inside = [](const Vec2& b) { return b.x + b.y <= 1; };
  // Its image under (b1, b2) -> (b1 + b2, b1 / (b1 + b2)) is a square with density 2 (b1 + b2).
  const ChiSquareResult r = chi_square_rect(
      [](Rng& rng) -> std::optional<Vec2> {
        const Vec2 b = sample_triangle(uniform2(rng));
        return Vec2(b.x + b.y, b.x / (b.x + b.y));
      },
      [](const Vec2& p) { return triangle_pdf() * p.x; }, {0, 0}, {1, 1}, n_samples, 11);
  EXPECT_GT(r.p_value, level) << r;
  EXPECT_NEAR(r.integral, 1, 1e-6);
  EXPECT_LT(round_trip_error(sample_triangle, invert_triangle, false), 1e-14);
  for (const Vec2& u : {Vec2(0, 0), Vec2(0, 1), Vec2(1, 0), Vec2(1, 1)})
    EXPECT_TRUE(inside(sample_triangle(u)));
}

}  // namespace
}  // namespace mlt::test
