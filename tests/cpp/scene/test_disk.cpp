#include "scene/shape/disk.h"

#include "scene/shape_testing.h"

namespace mlt {

Plugin shape_disk();

namespace {

using namespace shape_testing;

using testing::HasSubstr;

const Location here{"scene.xml", 3};

/// Stretches, shears and moves; mirrors, too.
const Matrix affine{1, 0.5, 0.2, 0.5, -0.3, 2, 0.1, -0.25, 0.4, 0.6, -0.7, 0.125, 0, 0, 0, 1};

const Disk& skew_disk() {
  static const Disk disk(rows(affine), false, here);
  return disk;
}

/// What Mitsuba 3.9.1 (scalar_rgb) finds along a ray from `from` to `to`.
struct Reference {
  bool skew;  ///< to_world = affine
  bool flipped;
  Vec3 from, to, p, n, s;
  Vec2 uv;
};

const std::vector<Reference>& references() {
  // clang-format off
  static const std::vector<Reference> list{
    {false, false, {-2.41, -3.97, -0.75}, {-0.43, -0.89, 0}, {-0.4300002, -0.89, 0}, {0, 0, 1}, {-0.4350322, -0.9004149, 0}, {0.9884331, 0.6783686}},
    {false, false, {-2.87, 4.8, 0.61}, {0.69, -0.22, 0}, {0.6900002, -0.22, 0}, {0, 0, 1}, {0.9527444, -0.3037735, 0}, {0.724224, 0.9508767}},
    {true, false, {1.73, 2.24, -4.8}, {1.38, 1.26, -0.57}, {1.27458, 0.9648235, 0.7040779}, {0.4089408, 0.1669146, -0.8971661}, {0.4988368, 0.7823579, 0.3729317}, {0.8030862, 0.1581843}},
    {true, false, {-3.37, -0.19, 0.01}, {0.36, -1.45, -0.13}, {0.434494, -1.475164, -0.1327961}, {0.4089408, 0.1669146, -0.8971661}, {-0.05225001, -0.9772345, -0.2056273}, {0.6207997, 0.8087485}},
    {true, true, {-0.49, -2.77, 4.47}, {-0.08, 0.73, 0.38}, {-0.05195876, 0.9693771, 0.1002704}, {-0.4089408, -0.1669146, 0.8971661}, {-0.4123057, 0.9108583, -0.01847268}, {0.9356722, 0.412251}},
    {true, true, {3.03, 2.27, -1.69}, {0.82, -1.84, 0.4}, {1.063176, -1.387758, 0.1700277}, {-0.4089408, -0.1669146, 0.8971661}, {0.4433377, -0.8956535, 0.03544627}, {0.9081559, 0.9173681}},
  };
  // clang-format on
  return list;
}

TEST(Disk, AgreesWithMitsuba3) {
  for (const Reference& r : references()) {
    std::map<std::string, Value> given{{"flip_normals", r.flipped}};
    if (r.skew) given["to_world"] = affine;
    const auto at = trace(*make_shape(shape_disk(), given), {r.from, normalize(r.to - r.from)});
    ASSERT_TRUE(at.has_value());
    expect_near(at->p, r.p, 1e-5);  // Mitsuba computes in single precision.
    expect_near(at->shading.n, r.n, 1e-5);
    expect_near(at->ng, r.n, 1e-5);
    expect_near(at->shading.s, r.s, 1e-5);
    EXPECT_NEAR(at->uv.x, r.uv.x, 1e-5);
    EXPECT_NEAR(at->uv.y, r.uv.y, 1e-5);
  }
  EXPECT_NEAR(skew_disk().area(), 7.528623104095459, 1e-6);
}

TEST(Disk, IsHitInsideItsRimOnly) {
  Rng rng(1, Purpose::test, 0);
  for (int i = 0; i < 2000; ++i) {
    const double r = 2 * rng.next(), phi = 2 * pi * rng.next();
    const Vec3 target = transform_point(rows(affine), {r * std::cos(phi), r * std::sin(phi), 0});
    const Vec3 d = random_direction(rng);
    const Vec3 o = target - d * (5 * rng.next());
    if (std::abs(r - 1) < 1e-9 || std::abs(dot(d, Vec3(0.41, 0.17, -0.9))) < 1e-3) continue;
    EXPECT_EQ(skew_disk().intersect(o, d, 0, infinity).has_value(), r < 1);
    EXPECT_FALSE(skew_disk().intersect(o, -d, 1e-9, infinity));
  }
}

TEST(Disk, RespectsTheLimitsOfTheRay) {
  const Disk disk(Mat4(1), false, here);
  const Vec3 o(0.5, 0, 3), d(0, 0, -1);
  EXPECT_DOUBLE_EQ(*disk.intersect(o, d, 0, infinity), 3);
  EXPECT_FALSE(disk.intersect(o, d, 0, 2.9));
  EXPECT_FALSE(disk.intersect(o, d, 3.1, infinity));
  EXPECT_FALSE(disk.intersect({0, 0, 0}, {1, 0, 0}, 0, infinity));  // In its plane.
  EXPECT_FALSE(disk.intersect({0, 0, 1}, {1, 0, 0}, 0, infinity));  // Parallel to it.
}

TEST(Disk, HasAFrameAtItsCenter) {
  const auto at = trace(Disk(Mat4(1), false, here), {{0, 0, 3}, {0, 0, -1}});
  expect_near(at->shading.s, {1, 0, 0}, 0);
  EXPECT_EQ(at->uv, Vec2(0, 0));
}

TEST(Disk, AreaSamplingIsATriple) {
  Rng rng(2, Purpose::test, 0);
  constexpr int samples = 10000;
  double radius2 = 0;
  for (int i = 0; i < samples; ++i) {
    const Vec2 u(rng.next(), rng.next());
    const PositionSample sample = skew_disk().sample_position(u);
    EXPECT_NEAR(sample.pdf * skew_disk().area(), 1, 1e-15);
    EXPECT_NEAR(dot(sample.at.p - Vec3(0.5, -0.25, 0.125), sample.at.ng), 0, 1e-15);
    EXPECT_LE(sample.at.uv.x, 1 + 1e-15);
    EXPECT_NEAR(length(sample.at.shading.s), 1, 1e-14);
    const Vec2 inverse = skew_disk().invert_position(sample.at);
    EXPECT_NEAR(inverse.x, u.x, 1e-9);
    EXPECT_NEAR(inverse.y, u.y, 1e-9);
    radius2 += sqr(sample.at.uv.x);
  }
  // The squared radius is uniform in [0, 1]; 4.4 standard deviations are the 1e-5 level.
  EXPECT_LT(std::abs(radius2 - samples / 2.0), 4.4 * std::sqrt(samples / 12.0));
}

TEST(Disk, BoundsTouchIt) {
  Vec3 low, high, least(infinity), most(-infinity);
  skew_disk().bounds(low, high);
  for (int i = 0; i < 10000; ++i) {
    const double phi = 2 * pi * i / 10000;
    const Vec3 p = transform_point(rows(affine), {std::cos(phi), std::sin(phi), 0});
    least = glm::min(least, p);
    most = glm::max(most, p);
  }
  expect_near(low, least, 1e-6);
  expect_near(high, most, 1e-6);
}

TEST(Disk, RefusesWhatFlattensIt) {
  const auto error = [](const Mat4& m) { return error_of([&] { Disk(m, false, here); }); };
  EXPECT_THAT(error(scaling(1, 0, 1)), HasSubstr("scene.xml:3: 'to_world' is singular"));
  EXPECT_THAT(error(scaling(1, 1, 0)), HasSubstr("singular"));
  EXPECT_THAT(error(rows({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.3, 1})), HasSubstr("affine"));
  EXPECT_EQ(error(scaling(1e-7, 1e3, -1)), "");
}

}  // namespace
}  // namespace mlt
