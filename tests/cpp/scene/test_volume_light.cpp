#include "scene/emitter/volume_light.h"

#include <gtest/gtest.h>

#include "base/rng.h"
#include "scene/medium/medium.h"
#include "scene/plugin_testing.h"
#include "scene/volume/grid_volume.h"

namespace mlt {

Plugin medium_heterogeneous();
Plugin medium_homogeneous();
Plugin shape_cube();
Plugin shape_sphere();

namespace {

using test::make;

MediumPtr flame() {
  return make<Medium>(medium_homogeneous(),
                      {{"sigma_t", 2.0}, {"albedo", 0.25}, {"emission", Triple{1, 2, 4}}});
}

ShapePtr sphere(const Triple& center, const MediumPtr& inside) {
  const ShapePtr shape = make<Shape>(shape_sphere(), {{"center", center}, {"radius", 0.5}});
  shape->set_media({inside, nullptr});
  return shape;
}

/// A medium that is bright in a corner of the unit cube, dim elsewhere in it, and dark around it.
MediumPtr flame_on_a_grid() {
  const GridData data{{2, 2, 2}, 1, {10, 1, 1, 1, 1, 1, 1, 1}};
  const ObjectPtr grid = std::make_shared<GridVolume>(Grid(data, false, "test"), Mat4(1));
  return make<Medium>(medium_heterogeneous(),
                      {{"sigma_t", 2.0}, {"albedo", 0.25}, {"emission", grid}});
}

/// The light of two spheres whose boxes overlap, and of a cube apart from them.
EmitterPtr light_of_three_shapes(const MediumPtr& medium = flame()) {
  const ShapePtr cube = make<Shape>(
      shape_cube(), {{"to_world", Matrix{1, 0, 0, 9, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
  cube->set_media({medium, nullptr});
  const auto lights =
      volume_lights({sphere({0, 0, 0}, medium), sphere({0.7, 0.75, 0}, medium), cube});
  EXPECT_EQ(lights.size(), 1u);
  return lights[0];
}

TEST(VolumeLight, EmitsWhatIsAbsorbedTimesItsRadiance) {
  const Spectrum found = light_of_three_shapes()->eval({}, {0, 0, 1});
  EXPECT_EQ(found.rgb(), Color(1.5, 3, 6));
  const auto none = [](const test::Given& given) {
    return !make<Medium>(medium_homogeneous(), given)->emits();
  };
  EXPECT_TRUE(none({{"sigma_t", 2.0}}));
  EXPECT_TRUE(none({{"sigma_t", 0.0}, {"emission", 1.0}}));
  EXPECT_TRUE(none({{"albedo", 1.0}, {"emission", 1.0}}));
}

/// Checks samples, and returns how many failed.
int check_positions(const EmitterPtr& light) {
  Rng rng(1, Purpose::test, 0);
  int failed = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec2 u(rng.next(), rng.next());
    const double third = rng.next();
    const PositionSample x0 = light->sample_volume(u, third, 0.3);
    EXPECT_EQ(x0.at.kind, PointKind::medium);
    EXPECT_EQ(x0.at.time, 0.3);
    if (!(x0.pdf > 0)) {
      ++failed;
      continue;
    }
    EXPECT_EQ(x0.pdf, light->pdf_position(x0.at));
    EXPECT_LT(length(light->invert_position(x0.at) - u), 1e-12);
    EXPECT_NEAR(light->invert_third(x0.at), third, 1e-12);
  }
  return failed;
}

/// Samples that fail are those in the part of a box that an earlier one has.
TEST(VolumeLight, PositionsAreATriple) {
  const int failed = check_positions(light_of_three_shapes());
  const double overlap = 0.3 * 0.25 * 1 / (1 + 1 + 16);
  EXPECT_NEAR(failed, 5000 * overlap, 5 * std::sqrt(5000 * overlap));
  check_positions(light_of_three_shapes(flame_on_a_grid()));
}

/// Counts samples in 4 x 4 x 4 parts of a box. In a cell of the light the emission varies by less
/// than a half, in the box by a factor of ten.
TEST(VolumeLight, PositionsOnAGridFollowTheEmission) {
  const MediumPtr medium = flame_on_a_grid();
  const EmitterPtr light = volume_lights({sphere({0.5, 0.5, 0.5}, medium)})[0];
  constexpr int n = 4, samples = 200'000, steps = 32;
  std::vector<double> found(n * n * n), expected(n * n * n);
  const auto cell_of = [](const Vec3& p) {
    const Vec3 i = glm::floor(p * double{n});
    return static_cast<size_t>((i.z * n + i.y) * n + i.x);
  };
  Rng rng(3, Purpose::test, 0);
  double least = infinity, most = 0;  // of emission over density
  for (int i = 0; i < samples; ++i) {
    const Vec2 u(rng.next(), rng.next());
    const auto [at, pdf] = light->sample_volume(u, rng.next(), 0);
    ++found.at(cell_of(at.p));
    const double ratio = luminance(light->eval(at, {0, 0, 1})) / pdf;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  EXPECT_LT(most / least, 2);
  for (int i = 0; i < steps * steps * steps; ++i) {
    SurfacePoint at;
    at.p = (Vec3(i % steps, i / steps % steps, i / (steps * steps)) + 0.5) / double{steps};
    expected[cell_of(at.p)] += samples * light->pdf_position(at) / (steps * steps * steps);
  }
  double all = 0;
  for (size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 4.5 * std::sqrt(expected[i])) << i;
    all += expected[i];
  }
  EXPECT_NEAR(all, samples, 1e-6 * samples);
}

TEST(VolumeLight, AGridOfOneValueIsAsIfItWereHomogeneous) {
  const GridData data{{1, 1, 1}, 1, {3}};
  const ObjectPtr grid = std::make_shared<GridVolume>(Grid(data, false, "test"), Mat4(1));
  const MediumPtr varying =
      make<Medium>(medium_heterogeneous(),
                   {{"sigma_t", 1.0}, {"scale", 2.0}, {"albedo", 0.25}, {"emission", grid}});
  const MediumPtr even =
      make<Medium>(medium_homogeneous(), {{"sigma_t", 2.0}, {"albedo", 0.25}, {"emission", 3.0}});
  for (const double wavelength : {rgb_lanes, 0.2, 600.0}) {
    const Spectrum found = varying->emission(Vec3(0.3), wavelength);
    const Spectrum expected = even->emission(Vec3(0.3), wavelength);
    for (int i = 0; i < Spectrum::lanes; ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-9 * expected[i]) << wavelength;
  }
  const auto power = [](const MediumPtr& inside) {
    return volume_lights({sphere({0.5, 0.5, 0.5}, inside)})[0]->power();
  };
  test::expect_close(power(varying) / power(even), Color(1), 1e-9);
}

/// Counts samples in a box that lies in two boxes of the light: there, too, is one density.
TEST(VolumeLight, DensityIsThatOfItsSamples) {
  const EmitterPtr light = light_of_three_shapes();
  const Vec3 low(0.1, 0.2, -0.3), high(0.8, 0.45, 0.2);
  const Vec3 side = high - low;
  constexpr int samples = 200'000;
  Rng rng(2, Purpose::test, 0);
  int inside = 0;
  for (int i = 0; i < samples; ++i) {
    const Vec2 u(rng.next(), rng.next());
    const auto [at, pdf] = light->sample_volume(u, rng.next(), 0);
    inside += pdf > 0 && glm::all(glm::lessThan(low, at.p)) && glm::all(glm::lessThan(at.p, high));
  }
  // What of the box lies in neither: beyond x = 0.5 below y = 0.25.
  const double volume = side.x * side.y * side.z - 0.3 * 0.05 * side.z;
  const double expected = samples * volume * light->pdf_position({});
  EXPECT_NEAR(inside, expected, 4 * std::sqrt(expected));
}

TEST(VolumeLight, PowerIsThatOfTheVolumeOfItsShapes) {
  const double volume = 2 * (4 * pi / 3 * 0.125) + 16;
  const Color expected = 4 * pi * volume * Color(1.5, 3, 6);
  test::expect_close(light_of_three_shapes()->power() / expected, Color(1), 1e-9);
}

}  // namespace
}  // namespace mlt
