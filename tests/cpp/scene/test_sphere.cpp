#include "scene/shape/sphere.h"

#include "math/warp.h"
#include "scene/shape_testing.h"

namespace mlt {
namespace {

using namespace shape_testing;

using testing::HasSubstr;

const Location here{"scene.xml", 3};

const Sphere& unit_sphere() {
  static const Sphere sphere({0, 0, 0}, 1, Mat4(1), false, here);
  return sphere;
}

TEST(Sphere, IntersectsPreciselyAtAnyDistance) {
  const Vec3 center(0.3, -0.2, 0.7);
  const Sphere sphere(center, 0.5, Mat4(1), false, here);
  Rng rng(1, Purpose::test, 0);
  for (int i = 0; i < 2000; ++i) {
    const double distance = std::pow(10.0, 8 * rng.next() - 0.2);
    const Vec3 target = center + random_direction(rng) * 0.49 * rng.next();
    const Vec3 d = random_direction(rng), o = target - d * distance;
    const auto t = sphere.intersect(o, d, 1e-9, infinity);
    ASSERT_TRUE(t.has_value());
    EXPECT_NEAR(length(o + d * *t - center), 0.5, 1e-14 * (1 + distance));
    Ray ray;
    ray.o = o;
    ray.d = d;
    SurfacePoint at;
    sphere.surface_point(ray, {static_cast<float>(*t), 0, 0, 0, 0}, at);
    expect_near(at.p, o + d * *t, 1e-14 * (1 + distance));
    EXPECT_NEAR(length(at.p - center), 0.5, 4e-16);
  }
}

TEST(Sphere, RaysFromItsSurfaceFindTheOtherSide) {
  Rng rng(2, Purpose::test, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 o = random_direction(rng), d = random_direction(rng);
    const double cosine = dot(o, d);
    const auto t = unit_sphere().intersect(o, d, 1e-12, infinity);
    if (std::abs(cosine) < 1e-6) continue;
    EXPECT_EQ(t.has_value(), cosine < 0);
    // The origin is off the surface by a rounding, which the quadratic magnifies by 1 / cosine.
    if (t) {
      EXPECT_NEAR(*t, -2 * cosine, 1e-15 * (1 - 1 / cosine));
    }
  }
}

TEST(Sphere, RespectsTheLimitsOfTheRay) {
  const Vec3 o(-3, 0, 0), d(1, 0, 0);
  EXPECT_DOUBLE_EQ(*unit_sphere().intersect(o, d, 0, infinity), 2);
  EXPECT_DOUBLE_EQ(*unit_sphere().intersect(o, d, 2.5, infinity), 4);
  EXPECT_FALSE(unit_sphere().intersect(o, d, 2.5, 3.9));
  EXPECT_FALSE(unit_sphere().intersect(o, d, 0, 1.9));
  EXPECT_FALSE(unit_sphere().intersect(o, -d, 0, infinity));
  EXPECT_FALSE(unit_sphere().intersect({0, 0, 2}, d, 0, infinity));
}

TEST(Sphere, FrameFollowsTheAzimuth) {
  const auto at = trace(unit_sphere(), {{3, 3, 0}, normalize(Vec3(-1, -1, 0))});
  expect_near(at->shading.s, normalize(Vec3(-1, 1, 0)), 1e-15);
  const auto pole = trace(unit_sphere(), {{0, 0, 3}, {0, 0, -1}});
  EXPECT_NEAR(length(pole->shading.s), 1, 1e-15);
  EXPECT_EQ(pole->uv.y, 0);
}

TEST(Sphere, MovesWithItsTransform) {
  const Mat4 m = rows({0, -2, 0, 1, 2, 0, 0, 2, 0, 0, 2, 3, 0, 0, 0, 1});  // Rotates x to y.
  const Sphere sphere({1, 0, 0}, 0.25, m, false, here);
  expect_near(sphere.center(), {1, 4, 3}, 1e-15);
  EXPECT_NEAR(sphere.radius(), 0.5, 1e-15);
  EXPECT_NEAR(sphere.area(), pi, 1e-14);
  Vec3 low, high;
  sphere.bounds(low, high);
  expect_near(low, {0.5, 3.5, 2.5}, 1e-14);
  expect_near(high, {1.5, 4.5, 3.5}, 1e-14);
  const auto at = trace(sphere, {{1, 9, 3}, {0, -1, 0}});
  EXPECT_NEAR(at->extent, 4.5, 1e-14);
  EXPECT_NEAR(at->uv.x, 0, 1e-15);  // Its own +x.
  EXPECT_NEAR(at->uv.y, 0.5, 1e-15);
}

TEST(Sphere, MirroringTurnsTheNormals) {
  const Ray ray{{0, 0, 5}, {0, 0, -1}};
  for (const bool mirrored : {false, true})
    for (const bool flipped : {false, true}) {
      const Sphere sphere({0, 0, 0}, 1, scaling(mirrored ? -1 : 1, 1, 1), flipped, here);
      const auto at = trace(sphere, ray);
      expect_near(at->ng, {0, 0, mirrored != flipped ? -1. : 1.}, 1e-15);
      expect_near(at->shading.n, at->ng, 0);
    }
}

TEST(Sphere, RefusesEllipsoidsAndNothing) {
  const auto error = [](double radius, const Mat4& m) {
    return error_of([&] { Sphere({0, 0, 0}, radius, m, false, here); });
  };
  EXPECT_THAT(error(1, scaling(1, 2, 1)), HasSubstr("scene.xml:3: 'to_world' makes this sphere"));
  EXPECT_THAT(error(1, rows({1, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1})),
              HasSubstr("ellipsoid"));
  EXPECT_THAT(error(1, rows({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1})),
              HasSubstr("ellipsoid"));
  EXPECT_THAT(error(1, scaling(1, 0, 1)), HasSubstr("singular"));
  EXPECT_THAT(error(0, Mat4(1)), HasSubstr("radius"));
  EXPECT_THAT(error(-1, Mat4(1)), HasSubstr("radius"));
  EXPECT_EQ(error(1, scaling(1e-7, 1e-7, -1e-7)), "");
}

TEST(Sphere, AreaSamplingIsATriple) {
  const Sphere sphere({1, 2, 3}, 0.5, Mat4(1), true, here);
  Rng rng(3, Purpose::test, 0);
  Vec3 sum(0);
  constexpr int samples = 10000;
  for (int i = 0; i < samples; ++i) {
    const Vec2 u(rng.next(), rng.next());
    const PositionSample sample = sphere.sample_position(u);
    EXPECT_NEAR(length(sample.at.p - sphere.center()), 0.5, 1e-15);
    EXPECT_NEAR(sample.pdf * sphere.area(), 1, 1e-15);
    const Vec2 inverse = sphere.invert_position(sample.at);
    EXPECT_NEAR(inverse.x, u.x, 1e-12);
    EXPECT_NEAR(inverse.y, u.y, 1e-6);
    sum += (sample.at.p - sphere.center()) / 0.5;
  }
  // Each component has variance 1/3; 4.4 standard deviations are the 1e-5 level.
  for (int k = 0; k < 3; ++k) EXPECT_LT(std::abs(sum[k]), 4.4 * std::sqrt(samples / 3.0));
}

TEST(Sphere, ThatShinesInwardsIsSampledAsAWholeFromItsSurface) {
  const Sphere sphere{{1, 2, 3}, 0.5, Mat4(1), true, here};
  const Vec3 outward = normalize(Vec3(0.3, -0.5, 0.8));
  for (const double distance : {0.5 * (1 - 1e-7), 0.5, 0.5 * (1 + 1e-7)}) {
    const Vec3 from = sphere.center() + distance * outward;
    const PositionSample sample = sphere.sample_direct(from, {0.3, 0.6});
    EXPECT_EQ(sample.pdf * sphere.area(), 1);
    EXPECT_EQ(sphere.pdf_direct(from, sample.at), sample.pdf);
  }
}

class SphereSeenFrom : public testing::TestWithParam<double> {
 protected:
  const Sphere sphere{{1, 2, 3}, 0.5, Mat4(1), false, here};
  Vec3 from() const {
    return sphere.center() + normalize(Vec3(0.3, -0.5, 0.8)) * (0.5 * GetParam());
  }
};

TEST_P(SphereSeenFrom, DirectSamplingIsATriple) {
  Rng rng(4, Purpose::test, 0);
  for (int i = 0; i < 3000; ++i) {
    const Vec2 u(rng.next(), rng.next());
    const PositionSample sample = sphere.sample_direct(from(), u);
    ASSERT_GT(sample.pdf, 0);
    EXPECT_EQ(sample.pdf, sphere.pdf_direct(from(), sample.at));
    EXPECT_NEAR(length(sample.at.p - sphere.center()), 0.5, 1e-15);
    const Vec2 inverse = sphere.invert_direct(from(), sample.at);
    EXPECT_NEAR(inverse.x, u.x, 1e-6);
    EXPECT_NEAR(inverse.y, u.y, 1e-5);
  }
}

TEST_P(SphereSeenFrom, DensityIntegratesToOne) {
  // Over the area by the midpoint rule, in a variable that is fine near the point below `from`.
  const Vec3 axis = normalize(from() - sphere.center());
  const Frame frame = Frame::around(axis);
  constexpr int steps = 200000;
  double integral = 0;
  for (int i = 0; i < steps; ++i) {
    const double x = (i + 0.5) / steps, height = 2 * x * x * x;  // 1 - cos alpha
    const double r = std::sqrt(height * (2 - height));
    SurfacePoint at;
    at.ng = frame.to_world({r, 0, 1 - height});
    at.p = sphere.center() + at.ng * 0.5;
    integral += sphere.pdf_direct(from(), at) * 2 * pi * 0.25 * 6 * x * x / steps;
  }
  EXPECT_NEAR(integral, 1, 1e-4);
}

class SphereSeenFromOutside : public SphereSeenFrom {};

TEST_P(SphereSeenFromOutside, DirectionsAreUniformInTheCone) {
  const double distance = GetParam();
  const double sin2 = 1 / sqr(distance),
               cosine = std::sqrt((1 - 1 / distance) * (1 + 1 / distance));
  const double height = sin2 / (1 + cosine);  // Of the cone: 1 - cos theta_max.
  const Frame frame = Frame::around(normalize(sphere.center() - from()));
  Rng rng(5, Purpose::test, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 u(rng.next(), rng.next());
    const PositionSample sample = sphere.sample_direct(from(), u);
    const Vec3 to = sample.at.p - from();
    const Vec3 local = frame.to_local(normalize(to));
    EXPECT_NEAR(invert_cone(local, height).x, u.x, 1e-6);
    const double solid_angle_pdf =
        sample.pdf * length_squared(to) / std::abs(dot(sample.at.ng, normalize(to)));
    EXPECT_NEAR(solid_angle_pdf * 2 * pi * height, 1, 1e-6);
  }
}

TEST_P(SphereSeenFromOutside, TheFarSideHasNoDensity) {
  SurfacePoint at;
  at.ng = -normalize(from() - sphere.center());
  at.p = sphere.center() + at.ng * 0.5;
  EXPECT_EQ(sphere.pdf_direct(from(), at), 0);
}

INSTANTIATE_TEST_SUITE_P(Distances, SphereSeenFrom,
                         testing::Values(0.0, 0.7, 1.001, 1.1, 2.0, 30.0, 1e4));
INSTANTIATE_TEST_SUITE_P(Distances, SphereSeenFromOutside,
                         testing::Values(1.001, 1.1, 2.0, 30.0, 1e4));

}  // namespace
}  // namespace mlt
