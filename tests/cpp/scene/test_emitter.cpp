#include "scene/emitter/emitter.h"

#include <gmock/gmock.h>

#include "base/atomic_file.h"
#include "base/rng.h"
#include "harness/chi_square.h"
#include "scene/mesh/mesh.h"
#include "scene/plugin_testing.h"
#include "scene/shape/shape.h"
#include "scene/texture/texture.h"

namespace mlt {

Plugin emitter_area();
Plugin emitter_constant();
Plugin emitter_directional();
Plugin emitter_envmap();
Plugin emitter_goniometric();
Plugin emitter_ies();
Plugin emitter_point();
Plugin emitter_projector();
Plugin emitter_sky();
Plugin emitter_spot();
Plugin emitter_sun();
Plugin emitter_sunsky();
Plugin shape_cube();
Plugin shape_rectangle();
Plugin shape_sphere();
Plugin texture_checkerboard();

namespace {

using test::error_in;
using test::expect_close;
using test::Given;
using test::make;
using testing::HasSubstr;

const Bounds bounds{{0.5, -0.25, 1}, 3};

/// Rotation by 70 degrees about (2, 3, 6) / 7.
const Matrix turned = {0.395732797,
                       -0.724881837,
                       0.563863338,
                       0,  //
                       0.886019759,
                       0.462873620,
                       -0.026776723,
                       0,  //
                       -0.241587463,
                       0.510190467,
                       0.825433887,
                       0,  //
                       0,
                       0,
                       0,
                       1};

/// 6 x 5 texels whose values are all different.
Image thirty_texels() {
  Image image(6, 5, 3);
  for (size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = static_cast<float>(i * 37 % 64) / 16;
  return image;
}

/// Black but for one texel, which lies at a pole if its row is 0.
Image one_bright_texel(int x, int y) {
  Image image(8, 5, 3);
  for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(1 + c);
  return image;
}

std::shared_ptr<Emitter> environment(const std::string& name, const Image& image, Given more = {}) {
  more["filename"] = test::temporary_image(name, image);
  auto light = make<Emitter>(emitter_envmap(), more);
  light->set_bounds(bounds);
  return light;
}

/// A light with whatever it sits on.
struct Light {
  std::string name;
  std::shared_ptr<Emitter> emitter;
  std::shared_ptr<Shape> shape;
};

Light area_light(const std::string& name, const Plugin& plugin, const Matrix& to_world,
                 const Value& radiance) {
  auto shape = make<Shape>(plugin, {{"to_world", to_world}});
  auto emitter = make<Emitter>(emitter_area(), {{"radiance", radiance}});
  shape->set_index(3);
  shape->set_emitter(emitter);
  if (auto mesh = std::dynamic_pointer_cast<Mesh>(shape)) mesh->prepare_sampling();
  emitter->set_shape(shape.get());
  return {name, emitter, shape};
}

/// The path of a file of 3 x 3 candelas, all around.
std::string photometric_file() {
  const std::string path = testing::TempDir() + "mlt_lamps.ies";
  write_file(path,
             "IESNA:LM-63-1995\nTILT=NONE\n1 -1 99 3 3 1 2 0 0 0 1 1 9\n0 70 180\n0 130 360\n"
             "7 9 2\n7 5 3\n7 9 2\n");
  return path;
}

/// Looks down from (0.2, 0, 2).
const Matrix downwards = {1, 0, 0, 0.2, 0, -1, 0, 0, 0, 0, -1, 2, 0, 0, 0, 1};

std::vector<Light> all_lights() {
  Matrix small = turned;
  for (size_t i = 0; i < 12; ++i) small[i] *= 0.4;
  const ObjectPtr board = make<Texture>(texture_checkerboard(), {{"color0", 0.9}, {"color1", 0.1}});
  const Triple rgb = {1, 2, 5};
  std::vector<Light> lights = {
      area_light("rectangle", shape_rectangle(), small, rgb),
      area_light("textured rectangle", shape_rectangle(), turned, board),
      area_light("cube", shape_cube(), small, rgb),
      area_light("sphere", shape_sphere(), small, rgb),
      {"point",
       make<Emitter>(emitter_point(), {{"intensity", rgb}, {"position", Triple{0, 0, 2}}}),
       {}},
      {"spot", make<Emitter>(emitter_spot(), {{"intensity", rgb}, {"to_world", downwards}}), {}},
      {"spot with a sharp edge",
       make<Emitter>(emitter_spot(), {{"intensity", rgb},
                                      {"to_world", downwards},
                                      {"cutoff_angle", 120.0},
                                      {"beam_width", 120.0}}),
       {}},
      {"projector",
       make<Emitter>(emitter_projector(), {{"irradiance", board}, {"to_world", downwards}}),
       {}},
      {"luminaire",
       make<Emitter>(emitter_ies(),
                     {{"filename", photometric_file()}, {"scale", rgb}, {"to_world", turned}}),
       {}},
      {"goniometric",
       make<Emitter>(emitter_goniometric(),
                     {{"filename", test::temporary_image("intensities.exr", thirty_texels())},
                      {"scale", 0.7},
                      {"to_world", turned}}),
       {}},
      {"sun",
       make<Emitter>(
           emitter_sun(),
           {{"sun_direction", Triple{1, 2, 3}}, {"to_world", turned}, {"sun_radius_scale", 20.0}}),
       {}},
      {"sun of no size",
       make<Emitter>(emitter_sun(),
                     {{"sun_direction", Triple{1, 2, 3}}, {"sun_radius_scale", 0.0}}),
       {}},
      {"sky",
       make<Emitter>(emitter_sky(), {{"resolution", int64_t{12}}, {"to_world", turned}}),
       {}},
      {"directional",
       make<Emitter>(emitter_directional(), {{"irradiance", rgb}, {"to_world", turned}}),
       {}},
      {"constant", make<Emitter>(emitter_constant(), {{"radiance", rgb}}), {}},
      {"envmap",
       environment("thirty.exr", thirty_texels(), {{"to_world", turned}, {"scale", 0.7}}),
       {}},
      {"envmap, one texel", environment("one.exr", one_bright_texel(7, 2)), {}},
      {"envmap, one pole", environment("pole.exr", one_bright_texel(1, 0)), {}}};
  for (const Light& light : lights) light.emitter->set_bounds(bounds);
  return lights;
}

TEST(Emitters, PositionsAreATriple) {
  for (const Light& light : all_lights()) {
    Rng rng(1, Purpose::test, 0);
    for (int i = 0; i < 500; ++i) {
      const Vec2 u(rng.next(), rng.next());
      const PositionSample sample = light.emitter->sample_position(u, 0);
      EXPECT_GT(sample.pdf, 0) << light.name;
      EXPECT_NEAR(sample.pdf, light.emitter->pdf_position(sample.at), 1e-9 * sample.pdf)
          << light.name;
      EXPECT_EQ(sample.at.infinite(), light.emitter->infinite()) << light.name;
      if (light.emitter->infinite()) {
        EXPECT_NEAR(length(sample.at.p), 1, 1e-14);
        EXPECT_EQ(sample.at.ng, -sample.at.p);
      }
      if (light.shape) {
        EXPECT_EQ(sample.at.shape, 3u);
      }
      if (!light.emitter->delta()) {
        EXPECT_LT(length(light.emitter->invert_position(sample.at) - u), 1e-6) << light.name;
      }
    }
  }
}

TEST(Emitters, ManyPositionsAreThoseOfSingleOnes) {
  constexpr int count = 150;
  for (const Light& light : all_lights()) {
    if (!light.emitter->infinite()) continue;
    Rng rng(5, Purpose::test, 0);
    std::vector<PositionSample> samples(count);
    std::vector<PositionRequest> requests;
    std::vector<std::optional<Spectrum>> radiances(count);
    for (int i = 0; i < count; ++i)
      requests.push_back({{rng.next(), rng.next()}, 0.3, 550, &samples[i], &radiances[i]});
    light.emitter->sample_positions(requests.data(), count);
    for (const PositionRequest& request : requests) {
      const PositionSample alone = light.emitter->sample_direct({0, 0, 0}, request.u, 0.3);
      EXPECT_EQ(request.sample->at.p, alone.at.p) << light.name;
      EXPECT_TRUE(request.sample->at.infinite()) << light.name;
      EXPECT_EQ(request.sample->pdf, alone.pdf) << light.name;
      EXPECT_EQ(request.sample->at.time, 0.3) << light.name;
      EXPECT_EQ(request.sample->at.wavelength, 550) << light.name;
      const Spectrum seen = light.emitter->eval(request.sample->at, -alone.at.p);
      const Spectrum& known = **request.radiance;
      EXPECT_LE(max_component(known - seen), 1e-6 * max_component(seen)) << light.name;
      EXPECT_LE(max_component(seen - known), 1e-6 * max_component(seen)) << light.name;
    }
  }
}

TEST(Emitters, DirectSamplesAreATriple) {
  const Vec3 from(1, 2.5, -2);
  for (const Light& light : all_lights()) {
    Rng rng(2, Purpose::test, 0);
    for (int i = 0; i < 500; ++i) {
      const Vec2 u(rng.next(), rng.next());
      const PositionSample sample = light.emitter->sample_direct(from, u, 0);
      EXPECT_NEAR(sample.pdf, light.emitter->pdf_direct(from, sample.at), 1e-9 * sample.pdf)
          << light.name;
      if (!light.emitter->delta()) {
        EXPECT_LT(length(light.emitter->invert_direct(from, sample.at) - u), 1e-4) << light.name;
      }
    }
  }
}

TEST(Emitters, RaysAreATriple) {
  for (const Light& light : all_lights()) {
    Rng rng(3, Purpose::test, 0);
    for (int i = 0; i < 500; ++i) {
      const SurfacePoint x0 = light.emitter->sample_position({rng.next(), rng.next()}, 0).at;
      const Vec2 u(rng.next(), rng.next());
      const RaySample ray = light.emitter->sample_ray(x0, u);
      EXPECT_GT(ray.pdf, 0);
      EXPECT_NEAR(ray.pdf, light.emitter->pdf_ray(x0, ray.direction), 1e-12 * ray.pdf)
          << light.name;
      EXPECT_NEAR(length(ray.direction), 1, 1e-14);
      const Vec3 x1 = ray.origin + ray.direction * 1.7;
      EXPECT_LT(length(light.emitter->invert_ray(x0, x1) - u), 1e-7) << light.name;
      if (light.emitter->infinite()) {
        const Vec3 to_center = bounds.center - ray.origin;
        EXPECT_NEAR(dot(to_center, ray.direction), bounds.radius, 1e-13);
        EXPECT_LE(length(cross(to_center, ray.direction)), bounds.radius * (1 + 1e-14));
      }
    }
  }
}

/// The definition that bdpt relies on: coefficient * G is the density, in area, of where the first
/// ray arrives. Counts rays through a small parallelogram against the integral of that density.
TEST(Emitters, CoefficientTimesGIsTheDensityOfTheNextVertex) {
  const Vec3 corner(0.1, -0.4, 0.3), a(0.9, 0.3, 0.1), b(-0.2, 0.5, 0.8);
  const double area = length(cross(a, b));
  SurfacePoint x1;
  x1.ng = cross(a, b) / area;
  std::vector<double> p_values;
  for (const Light& light : all_lights()) {
    const Emitter& emitter = *light.emitter;
    Rng rng(4, Purpose::test, 0);
    // A position from which the parallelogram can be seen, if the light has a front side.
    SurfacePoint x0;
    do x0 = emitter.sample_position({rng.next(), rng.next()}, 0).at;
    while (x0.kind == PointKind::surface && dot(x0.ng, corner + 0.5 * (a + b) - x0.p) < 0.3);
    double expected = 0;
    const int n = 200;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        x1.p = corner + a * ((i + 0.5) / n) + b * ((j + 0.5) / n);
        expected += emitter.pdf_ray(x0, direction(x0, x1)) * geometry(x0, x1) * area / (n * n);
      }
    ASSERT_GT(expected, 1e-3) << light.name;
    const int rays = 100'000;
    int hits = 0;
    for (int i = 0; i < rays; ++i) {
      const RaySample ray = emitter.sample_ray(x0, {rng.next(), rng.next()});
      const double t = dot(corner - ray.origin, x1.ng) / dot(ray.direction, x1.ng);
      const Vec3 p = ray.origin + ray.direction * t - corner;
      const double s = dot(cross(p, b), x1.ng) / area, r = dot(cross(a, p), x1.ng) / area;
      hits += t > 0 && s >= 0 && s < 1 && r >= 0 && r < 1;
    }
    const double sigma = std::sqrt(rays * expected * (1 - expected));
    p_values.push_back(2 * test::normal_cdf(-std::abs(hits - rays * expected) / sigma));
  }
  for (double p : test::holm_adjusted(p_values)) EXPECT_GT(p, 1e-4);
}

TEST(Emitters, PowerIsWhatTheirRaysCarry) {
  std::vector<double> p_values;
  for (const Light& light : all_lights()) {
    const Emitter& emitter = *light.emitter;
    Rng rng(5, Purpose::test, 0);
    test::Moments channels[3];
    for (int i = 0; i < 40'000; ++i) {
      const PositionSample x0 = emitter.sample_position({rng.next(), rng.next()}, 0);
      const RaySample ray = emitter.sample_ray(x0.at, {rng.next(), rng.next()});
      const Spectrum power = emitter.eval(x0.at, ray.direction) / (x0.pdf * ray.pdf);
      for (int c = 0; c < 3; ++c) channels[c].add(power[c]);
    }
    for (int c = 0; c < 3; ++c) {
      const double power = emitter.power()[c];
      if (channels[c].variance() < sqr(1e-9 * power)) {
        EXPECT_NEAR(channels[c].mean(), power, 1e-9 * power) << light.name;
      } else {
        p_values.push_back(test::one_sample_t_test(channels[c], power).p_value);
      }
    }
  }
  EXPECT_GT(p_values.size(), 10u);
  for (double p : test::holm_adjusted(p_values)) EXPECT_GT(p, 1e-4);
}

TEST(Area, ShinesOnItsFrontOnly) {
  const Light light =
      area_light("rectangle", shape_rectangle(), test::identity_rows, Triple{1, 2, 3});
  const SurfacePoint x0 = light.emitter->sample_position({0.3, 0.6}, 0).at;
  EXPECT_EQ(light.emitter->eval(x0, normalize(Vec3(1, 1, 0.1))).rgb(), Color(1, 2, 3));
  EXPECT_EQ(light.emitter->eval(x0, normalize(Vec3(1, 1, -0.1))), Spectrum(0));
  EXPECT_EQ(light.emitter->pdf_ray(x0, {0, 0, -1}), 0);
  expect_close(light.emitter->power(), Color(1, 2, 3) * (4 * pi), 1e-12);
  EXPECT_EQ(light.emitter->shape(), light.shape.get());
  EXPECT_FALSE(light.emitter->delta() || light.emitter->infinite());
}

TEST(Area, MayBeTextured) {
  const ObjectPtr board = make<Texture>(texture_checkerboard(), {{"color0", 1.0}, {"color1", 0.0}});
  const Light light = area_light("textured", shape_rectangle(), test::identity_rows, board);
  Rng rng(6, Purpose::test, 0);
  for (int i = 0; i < 100; ++i) {
    const SurfacePoint x0 = light.emitter->sample_position({rng.next(), rng.next()}, 0).at;
    const bool bright = (x0.uv.x > 0.5) == (x0.uv.y > 0.5);
    EXPECT_EQ(light.emitter->eval(x0, {0, 0, 1}), Spectrum(bright ? 1 : 0));
  }
}

TEST(Point, IsWhereItIsPut) {
  Matrix moved = test::identity_rows;
  moved[3] = 1;
  moved[7] = 2;
  moved[11] = 3;
  for (const Given& given : {Given{{"position", Triple{1, 2, 3}}}, Given{{"to_world", moved}}}) {
    const auto light = make<Emitter>(emitter_point(), given);
    const PositionSample x0 = light->sample_position({0.1, 0.2}, 0);
    EXPECT_EQ(x0.at.p, Vec3(1, 2, 3));
    EXPECT_EQ(x0.at.kind, PointKind::isolated);
    EXPECT_EQ(x0.pdf, 1);
    EXPECT_TRUE(light->delta());
  }
  EXPECT_THAT(error_in(emitter_point(), {{"position", Triple{1, 2, 3}}, {"to_world", moved}}),
              HasSubstr("exclude"));
}

TEST(Spot, FallsOffLinearlyWithTheAngle) {
  const auto light = make<Emitter>(
      emitter_spot(), {{"intensity", 2.0}, {"cutoff_angle", 40.0}, {"to_world", downwards}});
  const SurfacePoint x0 = light->sample_position({0.1, 0.2}, 0).at;
  EXPECT_EQ(x0.p, Vec3(0.2, 0, 2));
  const auto at = [&](double degrees) {
    const double angle = degrees * pi / 180;
    return light->eval(x0, {std::sin(angle), 0, -std::cos(angle)})[0];
  };
  EXPECT_EQ(at(0), 2);
  EXPECT_EQ(at(29.9), 2);
  EXPECT_NEAR(at(35), 1, 1e-12);
  EXPECT_EQ(at(40.1), 0);
  EXPECT_EQ(at(180), 0);
  EXPECT_TRUE(light->delta());
  EXPECT_THAT(error_in(emitter_spot(), {{"cutoff_angle", 20.0}, {"beam_width", 30.0}}),
              HasSubstr("beam_width"));
}

TEST(Directional, ShinesAsInMitsuba) {
  const auto towards = [](const Given& given) {
    return make<Emitter>(emitter_directional(), given)->sample_position({0.5, 0.5}, 0).at.p;
  };
  // Mitsuba 3.9.1: sample_direction(...).d.
  expect_close(towards({}), {0, 0, -1}, 1e-6);
  expect_close(towards({{"direction", Triple{1, 2, 3}}}), {-0.267261, -0.534523, -0.801784}, 1e-6);
  const double c = std::cos(pi / 6), s = 0.5;
  const Matrix about_x = {1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 0, 0, 1};
  expect_close(towards({{"to_world", about_x}}), {0, 0.5, -0.866025}, 1e-6);
  EXPECT_THAT(error_in(emitter_directional(), {{"direction", Triple{0, 0, 0}}}),
              HasSubstr("direction"));
  EXPECT_THAT(
      error_in(emitter_directional(), {{"direction", Triple{0, 0, 1}}, {"to_world", about_x}}),
      HasSubstr("exclude"));
}

Color radiance_from(const Emitter& light, const Vec3& towards) {
  SurfacePoint x0;
  x0.p = normalize(towards);
  x0.ng = -x0.p;
  x0.kind = PointKind::infinite;
  return light.eval(x0, -x0.p).rgb();
}

TEST(Environment, AgreesWithMitsuba) {
  // Mitsuba 3.9.1, scalar_rgb: envmap with scale 1.5; directions towards the light.
  struct {
    Vec3 towards;
    Color radiance;
  } const plain[] = {{{0.003, 0.7368, -0.6761}, {1.4908237, 4.796983, 2.4283237}},
                     {{-0.6324, -0.3229, -0.7042}, {3.7441764, 1.712126, 2.6692097}},
                     {{0.0421, 0.9379, -0.3444}, {1.6080205, 3.8127093, 2.5455205}},
                     {{-0.7154, 0.5648, 0.4115}, {2.7264237, 3.2000523, 3.6639237}},
                     {{0.1125, -0.9932, -0.0312}, {2.867797, 4.3544707, 3.1423423}},
                     {{0.4398, -0.8502, -0.2894}, {3.2028875, 3.8094528, 2.2587724}}},
          rotated[] = {{{-0.6457, -0.438, -0.6255}, {3.0849752, 0.5568032, 3.614308}},
                       {{-0.1785, -0.9622, 0.2059}, {3.2771626, 2.6255507, 4.2146635}},
                       {{0.062, -0.0739, -0.9953}, {2.7699876, 3.7743483, 2.450859}},
                       {{-0.9748, -0.0878, 0.205}, {1.5239242, 4.2719274, 2.1777697}},
                       {{-0.8147, -0.2544, -0.521}, {2.4051228, 1.466813, 3.3426225}},
                       {{-0.5187, 0.6803, -0.5178}, {3.3660243, 4.2027006, 4.303524}}};
  const auto a = environment("thirty.exr", thirty_texels(), {{"scale", 1.5}});
  const auto b = environment("thirty.exr", thirty_texels(), {{"scale", 1.5}, {"to_world", turned}});
  // Single precision of the peer: angles to 1e-6, slopes of up to 4 * 1.5 per texel of pi / 4.
  for (const auto& s : plain) expect_close(radiance_from(*a, s.towards), s.radiance, 3e-5);
  for (const auto& s : rotated) expect_close(radiance_from(*b, s.towards), s.radiance, 3e-5);
}

TEST(Environment, PutsEachTexelWhereMitsubaDoes) {
  // Column i at the azimuth 2 pi (i + 1/2) / width from -z towards +x, row j at the polar angle
  // pi j / (height - 1) from +y; half of its value half a texel away.
  const auto light = environment("one.exr", one_bright_texel(3, 1));
  const auto at = [&](double column, double row) {
    const double phi = 2 * pi * (column + 0.5) / 8, theta = pi * row / 4;
    return radiance_from(*light, {std::sin(theta) * std::sin(phi), std::cos(theta),
                                  -std::sin(theta) * std::cos(phi)})
        .x;
  };
  EXPECT_NEAR(at(3, 1), 1, 1e-12);
  EXPECT_NEAR(at(2.5, 1), 0.5, 1e-12);
  EXPECT_NEAR(at(3, 1.75), 0.25, 1e-12);
  EXPECT_NEAR(at(2, 1), 0, 1e-12);
  EXPECT_NEAR(at(3, 0), 0, 1e-12);
  EXPECT_NEAR(at(4.5, 1), 0, 1e-12);
}

TEST(Environment, MayBeMirrored) {
  Matrix mirrored = test::identity_rows;
  mirrored[0] = -2;
  const auto plain = environment("thirty.exr", thirty_texels());
  const auto other = environment("thirty.exr", thirty_texels(), {{"to_world", mirrored}});
  Rng rng(7, Purpose::test, 0);
  for (int i = 0; i < 200; ++i) {
    const PositionSample x0 = other->sample_position({rng.next(), rng.next()}, 0);
    const Vec3 reflected(-x0.at.p.x, x0.at.p.y, x0.at.p.z);
    expect_close(other->eval(x0.at, x0.at.ng).rgb(), radiance_from(*plain, reflected), 1e-12);
  }
}

TEST(Environment, SamplesFollowTheirDensity) {
  std::vector<double> p_values;
  for (const Image& image : {thirty_texels(), one_bright_texel(7, 2), one_bright_texel(1, 4)}) {
    const auto light = environment("sampled.exr", image);
    // Azimuth in turns and cosine against y, where 2 pi du dv is solid angle.
    test::ChiSquareOptions options;
    for (int i = 0; i < image.width; ++i) options.x_breaks.push_back((i + 0.5) / image.width);
    for (int j = 1; j + 1 < image.height; ++j)
      options.y_breaks.push_back(std::cos(pi * j / (image.height - 1)));
    const auto result = test::chi_square_rect(
        [&](Rng& rng) -> std::optional<Vec2> {
          const Vec3 w = light->sample_position({rng.next(), rng.next()}, 0).at.p;
          const double turn = std::atan2(w.x, -w.z) / (2 * pi);
          return Vec2(turn - std::floor(turn), w.y);
        },
        [&](const Vec2& p) {
          const double r = std::sqrt(1 - sqr(p.y));
          SurfacePoint x0;
          x0.p = {r * std::sin(2 * pi * p.x), p.y, -r * std::cos(2 * pi * p.x)};
          return 2 * pi * light->pdf_position(x0);
        },
        {0, -1}, {1, 1}, 100'000, 8, options);
    EXPECT_EQ(result.problem, "");
    EXPECT_NEAR(result.integral, 1, 1e-6);
    p_values.push_back(result.p_value);
  }
  for (double p : test::holm_adjusted(p_values)) EXPECT_GT(p, 1e-4);
}

TEST(Environment, CanSampleWhateverShines) {
  Rng rng(9, Purpose::test, 0);
  for (int row = 0; row < 5; ++row) {
    const auto light = environment("one.exr", one_bright_texel(0, row));
    int bright = 0;
    for (int i = 0; i < 20'000; ++i) {
      SurfacePoint x0;
      x0.kind = PointKind::infinite;
      const double z = 2 * rng.next() - 1, phi = 2 * pi * rng.next(), r = std::sqrt(1 - z * z);
      x0.p = {r * std::cos(phi), z, r * std::sin(phi)};
      const bool shines = light->eval(x0, -x0.p)[0] > 0;
      bright += shines;
      if (shines) {
        EXPECT_GT(light->pdf_position(x0), 0);
      }
    }
    EXPECT_GT(bright, 20);
  }
}

TEST(Environment, MayBeBlackOrGrey) {
  const auto black = environment("black.exr", Image(4, 4, 3));
  EXPECT_TRUE(is_black(black->power()));
  EXPECT_GT(black->sample_position({0.3, 0.4}, 0).pdf, 0);
  Image grey(4, 4, 1);
  for (float& v : grey.data) v = 2;
  const auto light = environment("grey.exr", grey);
  expect_close(light->power(), Color(2 * 4 * pi * pi * sqr(bounds.radius)), 1e-9);
  const PositionSample x0 = light->sample_position({0.3, 0.4}, 0);
  EXPECT_NEAR(x0.pdf, 1 / (4 * pi), 1e-7);
  EXPECT_EQ(light->eval(x0.at, x0.at.ng), Spectrum(2));
}

TEST(Environment, RefusesWhatItCannotUse) {
  const auto error = [](const Image& image, Given given) {
    given["filename"] = test::temporary_image("refused.exr", image);
    return error_in(emitter_envmap(), given);
  };
  EXPECT_THAT(error(Image(2, 2, 3), {}), HasSubstr("2 x 2"));
  EXPECT_THAT(error(Image(1, 3, 3), {}), HasSubstr("1 x 3"));
  EXPECT_THAT(error(Image(2, 3, 3), {{"scale", -1.0}}), HasSubstr("scale"));
  Matrix flat = test::identity_rows;
  flat[0] = 0;
  EXPECT_THAT(error(Image(2, 3, 3), {{"to_world", flat}}), HasSubstr("singular"));
  EXPECT_THAT(error_in(emitter_envmap(), {}), HasSubstr("needs 'filename'"));
}

TEST(Emitters, RefuseNegativeLight) {
  EXPECT_THAT(error_in(emitter_area(), {{"radiance", -1.0}}), HasSubstr("negative"));
  EXPECT_THAT(error_in(emitter_point(), {{"intensity", Triple{0, -1, 0}}}), HasSubstr("negative"));
  EXPECT_THAT(error_in(emitter_constant(), {{"radiance", -1.0}}), HasSubstr("negative"));
  EXPECT_THAT(error_in(emitter_directional(), {{"irradiance", -1.0}}), HasSubstr("negative"));
}

// ---- projector

TEST(Projector, ShowsItsImageOnAWhitePlaneAcrossItsAxis) {
  const ObjectPtr board = make<Texture>(texture_checkerboard(), {{"color0", 0.9}, {"color1", 0.3}});
  const auto light = make<Emitter>(
      emitter_projector(),
      {{"irradiance", board}, {"fov", 90.0}, {"scale", 2.0}, {"to_world", downwards}});
  const SurfacePoint x0 = light->sample_position({0.5, 0.5}, 0).at;
  // Camera space is x to the left, y up: here (x, -y) about (0.2, 0) at z = 1.
  const auto shown = [&](double x, double y, double distance) {
    const Vec3 to = Vec3(0.2, 0, 2) + distance * Vec3(x, -y, -1);
    const Vec3 w = normalize(to - x0.p);
    return light->eval(x0, w)[0] * inv_pi * -w.z / length_squared(to - x0.p);
  };
  for (const double distance : {1.0, 3.0}) {
    const double falloff = 1 / (distance * distance);
    EXPECT_NEAR(shown(0.75, 0.75, distance), 1.8 * falloff, 1e-12);    // upper left
    EXPECT_NEAR(shown(-0.75, 0.75, distance), 0.6 * falloff, 1e-12);   // upper right
    EXPECT_NEAR(shown(-0.25, -0.75, distance), 1.8 * falloff, 1e-12);  // lower right
    EXPECT_EQ(shown(1.01, 0, distance), 0);
  }
}

// ---- goniometric

/// Of a light at infinity, in the direction that looks up to it.
Color radiance(const Emitter& light, const Vec3& up) {
  SurfacePoint x0;
  x0.p = normalize(up);
  x0.kind = PointKind::infinite;
  return light.eval(x0, -x0.p).rgb();
}

TEST(Goniometric, ShinesIntoADirectionAsTheEnvironmentDoesFromThere) {
  const Given turn = {{"scale", 0.7}, {"to_world", turned}};
  const auto sky = environment("directions.exr", thirty_texels(), turn);
  Given given = turn;
  given["filename"] = test::temporary_image("directions.exr", thirty_texels());
  const auto lamp = make<Emitter>(emitter_goniometric(), given);
  const SurfacePoint x0 = lamp->sample_position({0.5, 0.5}, 0).at;
  Rng rng(8, Purpose::test, 0);
  for (int i = 0; i < 100; ++i) {
    const Vec3 w = sample_uniform_sphere({rng.next(), rng.next()});
    expect_close(lamp->eval(x0, w).rgb(), radiance(*sky, w), 1e-12);
  }
}

// ---- daylight

TEST(Sun, StandsWhereMitsubaHasIt) {
  const auto integer = [](int64_t x) { return Value(x); };
  // South, west and up, as Mitsuba 3.9.1 gives it for the same place and time.
  const std::vector<std::pair<Given, Vec3>> cases = {{{}, {0.0513854, 0.691748, 0.720308}},
                                                     {{{"latitude", 40.0},
                                                       {"longitude", -105.0},
                                                       {"timezone", -7.0},
                                                       {"month", integer(6)},
                                                       {"day", integer(21)},
                                                       {"hour", 12.0}},
                                                      {0.285061, -0.00726833, 0.958482}},
                                                     {{{"latitude", -33.9},
                                                       {"longitude", 151.2},
                                                       {"timezone", 10.0},
                                                       {"year", integer(2003)},
                                                       {"month", integer(12)},
                                                       {"day", integer(3)},
                                                       {"hour", 8.0},
                                                       {"minute", 30.0},
                                                       {"second", 15.0}},
                                                      {-0.0309198, -0.6955, 0.717861}}};
  for (auto [given, mitsuba] : cases) {
    given["sun_radius_scale"] = 0.0;
    const auto sun = make<Emitter>(emitter_sun(), given);
    expect_close(sun->sample_position({0.5, 0.5}, 0).at.p, {-mitsuba.y, mitsuba.z, mitsuba.x},
                 2e-4);
  }
}

/// Radiances of Mitsuba 0.6's sky, whose images have 16 bits.
TEST(Sky, IsThatOfMitsuba) {
  const std::array<Vec3, 3> up = {Vec3(1, 3, 2), Vec3(-2, 1, 0.5), Vec3(0.3, 0.4, -0.5)};
  struct Case {
    double turbidity, albedo;
    Triple sun;
    std::array<Color, 3> seen;
  };
  const std::vector<Case> cases = {{3,
                                    0.2,
                                    {1, 2, 3},
                                    {{{0.05789185, 0.07919312, 0.11514282},
                                      {0.03736115, 0.06646729, 0.11463928},
                                      {0.02801514, 0.05239868, 0.09576416}}}},
                                   {6.3,
                                    0.5,
                                    {0.3, 0.1, -0.8},
                                    {{{0.01664734, 0.02461243, 0.0322876},
                                      {0.03503418, 0.04570007, 0.05038452},
                                      {0.08779907, 0.07861328, 0.06214905}}}},
                                   {1.7,
                                    0.9,
                                    {-1, 5, 0.5},
                                    {{{0.0425415, 0.08331299, 0.16455078},
                                      {0.07818604, 0.14501953, 0.2541504},
                                      {0.0554657, 0.10693359, 0.19824219}}}}};
  for (const Case& c : cases) {
    const auto sky = make<Emitter>(emitter_sky(), {{"turbidity", c.turbidity},
                                                   {"albedo", c.albedo},
                                                   {"sun_direction", c.sun},
                                                   {"resolution", int64_t{2048}}});
    for (size_t i = 0; i < up.size(); ++i)
      for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(radiance(*sky, up[i])[channel] / c.seen[i][channel], 1, 2e-3) << i;
  }
}

TEST(Sky, EndsAtTheHorizonUnlessItIsStretchedOrGoesOn) {
  const Vec3 below(1, -0.5, 0);
  const auto sky = [](const Given& given) { return make<Emitter>(emitter_sky(), given); };
  EXPECT_EQ(radiance(*sky({}), below), Color(0));
  EXPECT_GT(radiance(*sky({{"extend", true}}), below).y, 0);
  EXPECT_GT(radiance(*sky({{"stretch", 2.0}}), below).y, 0);
  EXPECT_EQ(radiance(*sky({{"extend", true}}), {0, -1, 0}), Color(0));
}

/// What Mitsuba 0.6 shows of a white plane in the sun alone.
TEST(Sun, IsAsBrightAsMitsubas) {
  struct Case {
    double turbidity;
    Triple towards;
    Color shown;
  };
  for (const Case& c : {Case{3, {1, 2, 3}, {0.19848633, 0.15734863, 0.11773682}},
                        Case{6.3, {0.3, 0.1, -0.8}, {9.33170e-4, 2.63929e-4, 1.15633e-5}}}) {
    const auto sun = make<Emitter>(
        emitter_sun(),
        {{"turbidity", c.turbidity}, {"sun_direction", c.towards}, {"sun_radius_scale", 0.0}});
    const SurfacePoint x0 = sun->sample_position({0.5, 0.5}, 0).at;
    const Color shown = sun->eval(x0, {}).rgb() * (inv_pi * x0.p.y);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(shown[channel], c.shown[channel], 0.003 * c.shown.x) << channel;
  }
}

TEST(Sun, HasTheSameIrradianceWhateverItsSize) {
  const auto irradiance = [](double size) {
    const auto sun = make<Emitter>(
        emitter_sun(), {{"sun_direction", Triple{0, 1, 0}}, {"sun_radius_scale", size}});
    const PositionSample sample = sun->sample_position({0.5, 0.5}, 0);
    return sun->eval(sample.at, {})[1] / sample.pdf;
  };
  EXPECT_NEAR(irradiance(1) / irradiance(0), 1, 1e-12);
  EXPECT_NEAR(irradiance(20) / irradiance(0), 1, 1e-12);
}

TEST(Daylight, RefusesWhatTheModelDoesNotKnow) {
  EXPECT_THAT(error_in(emitter_sky(), {{"hour", 23.0}}), HasSubstr("below the horizon"));
  EXPECT_THAT(error_in(emitter_sun(), {{"sun_direction", Triple{0, -1, 0}}}),
              HasSubstr("below the horizon"));
  EXPECT_THAT(error_in(emitter_sky(), {{"turbidity", 11.0}}), HasSubstr("between 1"));
  EXPECT_THAT(error_in(emitter_sky(), {{"sun_direction", Triple{0, 0, 0}}}), HasSubstr("length"));
}

// ---- choosing among lights

TEST(Emitters, HaveAPositiveWeightForBeingSampled) {
  EXPECT_EQ(make<Emitter>(emitter_point(), {})->sampling_weight(), 1);
  EXPECT_EQ(make<Emitter>(emitter_sky(), {{"sampling_weight", 3.0}})->sampling_weight(), 3);
  EXPECT_THAT(error_in(emitter_constant(), {{"sampling_weight", -1.0}}), HasSubstr("between 0"));
}

}  // namespace
}  // namespace mlt
