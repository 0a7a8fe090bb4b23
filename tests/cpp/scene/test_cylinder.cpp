#include "scene/shape/cylinder.h"

#include "scene/shape_testing.h"

namespace mlt {

Plugin shape_cylinder();

namespace {

using namespace shape_testing;

using testing::HasSubstr;

/// Rotates, mirrors, scales by 1.5 and moves.
const Matrix mirroring{0, 0, -1.5, -0.5, 0.9, 1.2, 0, -0.25, -1.2, 0.9, 0, 0.125, 0, 0, 0, 1};
/// Rotates and moves; scales by 2 across and by 0.5 along the z axis.
const Matrix flattening{0, 0, 0.5, 0.5, 1.2, 1.6, 0, -0.25, -1.6, 1.2, 0, 0.125, 0, 0, 0, 1};

Cylinder cylinder_of(const std::map<std::string, Value>& given) {
  return dynamic_cast<const Cylinder&>(*make_shape(shape_cylinder(), given));
}

const Cylinder& slanted() {
  static const Cylinder cylinder = cylinder_of({{"p0", Triple{0.3, -0.2, 0.7}},
                                                {"p1", Triple{1, 0.5, -0.4}},
                                                {"radius", 0.5},
                                                {"to_world", mirroring}});
  return cylinder;
}

double distance_from_axis(const Cylinder& cylinder, const Vec3& p) {
  return length(cross(p - cylinder.base(), cylinder.axis()));
}

/// What Mitsuba 3.9.1 (scalar_rgb) finds along a ray from `from` to `to`.
struct Reference {
  std::map<std::string, Value> given;
  Vec3 from, to, p, n, s;
  Vec2 uv;
};

const std::vector<Reference>& references() {
  // clang-format off
  static const std::map<std::string, Value> flip{{"flip_normals", true}}, mirror{{"to_world", mirroring}},
    mirror_flip{{"to_world", mirroring}, {"flip_normals", true}}, flat{{"to_world", flattening}},
    long_mirror{{"to_world", mirroring}, {"p0", Triple{1, 2, 3}}, {"p1", Triple{2, 4, -4}}, {"radius", 0.5}};
  static const std::vector<Reference> list{
    {{}, {5.2, 1.04, -2.32}, {-0.89, -0.99, 0.2}, {-0.5065798, -0.8621933, 0.04134317}, {-0.5065796, -0.8621932, 0}, {0.8621932, -0.5065796, 0}, {0.6654547, 0.04134316}},
    {{}, {-1.9, -2.98, 0.64}, {-0.04, -0.09, 0.67}, {-0.5284632, -0.8489563, 0.6621215}, {-0.5284631, -0.8489562, 0}, {0.8489562, -0.5284631, 0}, {0.6613842, 0.6621215}},
    {{}, {5.63, -3.64, 1.27}, {-0.2, 0.19, 0.74}, {0.8616735, -0.5074632, 0.8365157}, {0.8616735, -0.5074632, 0}, {0.5074632, 0.8616735, 0}, {0.9152916, 0.8365157}},
    {{}, {2.61, 1.38, 1.96}, {-0.57, 0.2, 0.89}, {-0.9991695, 0.04074858, 0.7455941}, {-0.9991694, 0.04074857, 0}, {-0.04074857, -0.9991694, 0}, {0.4935129, 0.745594}},
    {flip, {2.13, -2.76, -0.51}, {0.36, 0.57, 0.94}, {0.8974453, -0.4411259, 0.4997199}, {-0.8974453, 0.4411258, -0}, {0.4411258, 0.8974453, 0}, {0.9272897, 0.4997199}},
    {flip, {0.1, -5.44, -0.76}, {-0.37, -0.01, 0.05}, {-0.4482394, 0.8939136, 0.1848379}, {0.4482394, -0.8939135, -0}, {-0.8939135, -0.4482394, 0}, {0.3239744, 0.1848379}},
    {mirror, {-2.01, -1.08, -1.01}, {-0.75, -1.69, 0.3}, {-0.6716765, -1.727919, 0.3814315}, {-0, -0.985279, 0.1709543}, {0, -0.1709543, -0.985279}, {0.620241, 0.114451}},
    {mirror, {0.62, -3.03, -3.32}, {-1.21, -0.06, 0.1}, {-0.5647316, -1.107239, -1.105911}, {-0, -0.5714924, -0.8206074}, {0, 0.8206074, -0.5714924}, {0.8007659, 0.0431544}},
    {mirror_flip, {-0.05, -3.19, -1.6}, {-1.25, -0.1, -0.02}, {-0.7125025, -1.484056, -0.7277049}, {0, 0.822704, 0.56847}, {0, 0.5684699, -0.822704}, {0.7438158, 0.1416683}},
    {mirror_flip, {-0.08, -2.87, 1.64}, {-1.7, 0.45, -0.62}, {-0.6991038, -1.601219, 0.7763119}, {0, 0.9008127, -0.4342079}, {0, -0.4342079, -0.9008127}, {0.5760978, 0.1327359}},
    {flat, {0.33, -0.54, -2.46}, {0.81, -0.22, -1.46}, {0.6120483, -0.3519678, -1.872399}, {0, -0.05098398, -0.9986994}, {0, 0.9986994, -0.05098398}, {0.8894657, 0.2240966}},
    {flat, {0.17, 3.56, 4.09}, {0.69, 1.54, -0.38}, {0.63605, 1.749575, 0.08376308}, {0, 0.9997874, -0.0206185}, {0, 0.0206185, 0.9997874}, {0.1443019, 0.2720999}},
    {long_mirror, {-3.63, 2.57, 2.98}, {-2.37, 4.61, 0.5}, {-2.926182, 3.709515, 1.594707}, {-0.05487946, -0.006923337, 0.998469}, {-0.2993006, 0.9541082, -0.009834899}, {0.6026536, 0.2014264}},
    {long_mirror, {3.14, 7.49, 5.02}, {-1.59, 4.35, 0.79}, {-0.7527512, 4.905806, 1.538744}, {-0.2375715, 0.6199425, 0.7478175}, {-0.1901378, 0.7252873, -0.6616691}, {0.7163705, 0.4214693}},
  };
  // clang-format on
  return list;
}

TEST(Cylinder, AgreesWithMitsuba3) {
  for (const Reference& r : references()) {
    const auto at =
        trace(*make_shape(shape_cylinder(), r.given), {r.from, normalize(r.to - r.from)});
    ASSERT_TRUE(at.has_value());
    expect_near(at->p, r.p, 1e-5);  // Mitsuba computes in single precision.
    expect_near(at->shading.n, r.n, 1e-5);
    expect_near(at->ng, r.n, 1e-5);
    expect_near(at->shading.s, r.s, 1e-5);
    EXPECT_NEAR(at->uv.x, r.uv.x, 1e-5);
    EXPECT_NEAR(at->uv.y, r.uv.y, 1e-5);
  }
  EXPECT_NEAR(cylinder_of({}).area(), 2 * pi, 1e-14);
  EXPECT_NEAR(cylinder_of({{"to_world", flattening}}).area(), 2 * pi, 1e-14);
  EXPECT_NEAR(cylinder_of(references().back().given).area(), 51.943275451660156, 1e-5);
}

TEST(Cylinder, IntersectsPreciselyAtAnyDistance) {
  Rng rng(1, Purpose::test, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 inside = slanted().base() + slanted().axis() * (slanted().length() * rng.next());
    const Vec3 d = random_direction(rng);
    const double distance = std::pow(10.0, 8 * rng.next() - 8 * rng.next());
    const Vec3 o = inside - d * distance;
    const auto t = slanted().intersect(o, d, 0, infinity);
    if (!t) continue;  // It passes through the open ends.
    const double sine = length(cross(d, slanted().axis()));
    EXPECT_NEAR(distance_from_axis(slanted(), o + d * *t), slanted().radius(),
                1e-14 * (1 + distance) / sine);
    SurfacePoint at;
    const Ray ray{o, d};
    slanted().surface_point(ray, {static_cast<float>(*t), 0, 0, 0, 0}, at);
    expect_near(at.p, o + d * *t, 1e-14 * (1 + distance) / sine);
    EXPECT_NEAR(distance_from_axis(slanted(), at.p), slanted().radius(), 1e-14);
  }
}

TEST(Cylinder, RaysFromItsSurfaceFindTheOtherSide) {
  const Cylinder tall = cylinder_of({{"p0", Triple{0, 0, -1e6}}, {"p1", Triple{0, 0, 1e6}}});
  Rng rng(2, Purpose::test, 0);
  for (int i = 0; i < 2000; ++i) {
    const double phi = 2 * pi * rng.next();
    const Vec3 o(std::cos(phi), std::sin(phi), 0), d = random_direction(rng);
    const double cosine = dot(o, d), across = d.x * d.x + d.y * d.y;
    if (std::abs(cosine) < 1e-6 || across < 1e-6) continue;
    const auto t = tall.intersect(o, d, 1e-12, infinity);
    EXPECT_EQ(t.has_value(), cosine < 0);
    // The origin is off the surface by a rounding, which the quadratic magnifies by 1 / cosine.
    if (t) {
      EXPECT_NEAR(*t, -2 * cosine / across, 1e-15 * (1 - 1 / cosine) / across);
    }
  }
}

TEST(Cylinder, IsOpenAtItsEnds) {
  const Cylinder unit = cylinder_of({});
  EXPECT_FALSE(unit.intersect({0.5, 0, 3}, {0, 0, -1}, 0, infinity));
  EXPECT_FALSE(unit.intersect({1, 0, 3}, {0, 0, -1}, 0, infinity));  // Along its side.
  EXPECT_FALSE(unit.intersect({-3, 0, 1.1}, {1, 0, 0}, 0, infinity));
  EXPECT_DOUBLE_EQ(*unit.intersect({-3, 0, 0.9}, {1, 0, 0}, 0, infinity), 2);
  // In through the open end, out through the side.
  EXPECT_DOUBLE_EQ(*unit.intersect({-0.2, 0, 2}, {0.6, 0, -0.8}, 0, infinity), 2);
}

TEST(Cylinder, RespectsTheLimitsOfTheRay) {
  const Cylinder unit = cylinder_of({});
  const Vec3 o(-3, 0, 0.5), d(1, 0, 0);
  EXPECT_DOUBLE_EQ(*unit.intersect(o, d, 2.5, infinity), 4);
  EXPECT_FALSE(unit.intersect(o, d, 2.5, 3.9));
  EXPECT_FALSE(unit.intersect(o, d, 0, 1.9));
  EXPECT_FALSE(unit.intersect(o, -d, 0, infinity));
}

TEST(Cylinder, TellsItsTwoSidesApartAlsoAtTheRim) {
  // The line enters through the open end just above the rim that it would meet first.
  const Cylinder unit = cylinder_of({});
  const Vec3 d = normalize(Vec3(1, 0, -0.3)), o = Vec3(-1, 0, 1 + 1e-12) - 2. * d;
  const auto t = unit.intersect(o, d, 0, infinity);
  ASSERT_TRUE(t.has_value());
  SurfacePoint at;
  unit.surface_point({o, d}, {static_cast<float>(*t), 0, 0, 0, 0}, at);
  expect_near(at.p, {1, 0, 0.4}, 1e-11);
}

TEST(Cylinder, AreaSamplingIsATriple) {
  Rng rng(3, Purpose::test, 0);
  Vec3 sum(0);
  constexpr int samples = 10000;
  for (int i = 0; i < samples; ++i) {
    const Vec2 u(rng.next(), rng.next());
    const PositionSample sample = slanted().sample_position(u);
    EXPECT_NEAR(distance_from_axis(slanted(), sample.at.p), slanted().radius(), 1e-14);
    EXPECT_NEAR(sample.pdf * slanted().area(), 1, 1e-15);
    const Vec2 inverse = slanted().invert_position(sample.at);
    EXPECT_NEAR(inverse.x, u.x, 1e-12);
    EXPECT_NEAR(inverse.y, u.y, 1e-12);
    sum += Vec3(std::sqrt(2.0) * std::cos(2 * pi * sample.at.uv.x),
                std::sqrt(2.0) * std::sin(2 * pi * sample.at.uv.x),
                std::sqrt(12.0) * (sample.at.uv.y - 0.5));
  }
  // Each component has variance 1; 4.4 standard deviations are the 1e-5 level.
  for (int k = 0; k < 3; ++k) EXPECT_LT(std::abs(sum[k]), 4.4 * std::sqrt(samples));
}

TEST(Cylinder, BoundsTouchIt) {
  Vec3 low, high, least(infinity), most(-infinity);
  slanted().bounds(low, high);
  for (const double end : {0.0, 1 - 0x1p-53})
    for (int i = 0; i < 10000; ++i) {
      const Vec3 p = slanted().sample_position({end, i / 10000.0}).at.p;
      least = glm::min(least, p);
      most = glm::max(most, p);
    }
  expect_near(low, least, 1e-6);
  expect_near(high, most, 1e-6);
}

TEST(Cylinder, RefusesWhatIsNone) {
  const auto error = [](const std::map<std::string, Value>& given) {
    return error_of([&] { cylinder_of(given); });
  };
  const auto diagonal = [](double x, double y, double z) {
    return Matrix{x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1};
  };
  EXPECT_THAT(error({{"to_world", diagonal(1, 2, 1)}}), HasSubstr("an ellipse"));
  EXPECT_THAT(error({{"to_world", Matrix{1, 0, 0.1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}),
              HasSubstr("shears"));
  EXPECT_THAT(error({{"to_world", diagonal(1, 1, 0)}}), HasSubstr("singular"));
  EXPECT_THAT(error({{"to_world", Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1}}}),
              HasSubstr("affine"));
  EXPECT_THAT(error({{"radius", -1.0}}), HasSubstr("must be positive"));
  EXPECT_THAT(error({{"p1", Triple{0, 0, 0}}}), HasSubstr("no length"));
  EXPECT_EQ(error({{"to_world", diagonal(1e-3, -1e-3, 50)}}), "");
}

}  // namespace
}  // namespace mlt
