// Scenes whose image is known in closed form, with every integrator that can see them.
#include <gtest/gtest.h>

#include "integrator_testing.h"

namespace mlt {
namespace {

using namespace test;

/// Samples per pixel of a first attempt. The pixels are few, and a chain's steps are to cost more
/// than its bootstrap.
double first_spp(const std::string& integrator) {
  if (integrator == "pssmlt" || integrator == "mlt" || integrator == "erpt") return 1024;
  return integrator == "ptracer" ? 64 : 8;
}

/// Differences of 1 % would be seen; of 2 % where that takes too long for a short test, and by mlt.
SameImageSettings settings_of(const std::string& integrator, bool is_long) {
  SameImageSettings settings;
  settings.max_effort = 5000;
  if (integrator == "erpt" || first_spp(integrator) == 8) return settings;
  if (integrator != "mlt" && is_long) return settings;
  settings.whole = 0.02;
  settings.block = 0.1;
  return settings;
}

void expect_image(const ScenePtr& scene, const std::string& name, const Assignments& assignments,
                  const Image& image, bool is_long = false) {
  const SameImage found = same_image(side(scene, name, assignments, first_spp(name)),
                                     known("closed form", image), settings_of(name, is_long));
  EXPECT_TRUE(found) << found.text;
}

Image constant_image(const Scene& scene, const Color& color) {
  const Vec2i size = scene.camera().raster().size;
  Image image(size.x, size.y, 3);
  for (size_t i = 0; i < image.data.size(); ++i)
    image.data[i] = static_cast<float>(color[static_cast<int>(i % 3)]);
  return image;
}

// ---- a closed furnace of albedo a and emission e: radiance e (1 + a + a^2 + ...) everywhere

const Color emission(1, 0.5, 0.25), albedo(0.5, 0.6, 0.2);

ScenePtr furnace(const std::string& shape) {
  return load_scene(camera("0.2, 0.1, 0.3", "0, 0, -1", 90, film(8, 6)) + "<shape type='" + shape +
                    "'><boolean name='flip_normals' value='true'/>" + diffuse("0.5 0.6 0.2") +
                    area_light("1 0.5 0.25") + "</shape>");
}

/// Partial sums are paths of at most max_depth edges; -1: all of them.
Color furnace_radiance(int max_depth) {
  Color sum(0), term = emission;
  if (max_depth < 0) return emission / (Color(1) - albedo);
  for (int k = 1; k <= max_depth; ++k, term *= albedo) sum += term;
  return sum;
}

void expect_furnace(const std::string& integrator, const std::string& shape, int max_depth,
                    bool is_long = false) {
  SCOPED_TRACE(shape + " with max_depth " + std::to_string(max_depth));
  const ScenePtr scene = furnace(shape);
  expect_image(scene, integrator, {{"max_depth", std::to_string(max_depth)}},
               constant_image(*scene, furnace_radiance(max_depth)), is_long);
}

const auto integrators = testing::Values("path", "ptracer", "bdpt", "pssmlt");

class Furnace : public testing::TestWithParam<std::string> {};

TEST_P(Furnace, HasTheRadianceOfTheGeometricSeries) { expect_furnace(GetParam(), "cube", -1); }

TEST_P(Furnace, HasThePartialSumsOfTheGeometricSeries) {
  if (GetParam() == "pssmlt") GTEST_SKIP() << "the long suite has them";
  expect_furnace(GetParam(), "cube", 1);
  expect_furnace(GetParam(), "sphere", 3);
}

TEST_P(Furnace, HasTheReflectedPartAloneWhenLightsAreHidden) {
  const ScenePtr scene = furnace("cube");
  expect_image(scene, GetParam(), {{"max_depth", "3"}, {"hide_emitters", "true"}},
               constant_image(*scene, furnace_radiance(3) - furnace_radiance(1)));
}

INSTANTIATE_TEST_SUITE_P(Integrators, Furnace, integrators,
                         [](const auto& info) { return info.param; });

class LongFurnace : public testing::TestWithParam<std::string> {};

TEST_P(LongFurnace, HasTheRadianceOfTheGeometricSeries) {
  for (const std::string shape : {"cube", "sphere"}) {
    if (shape == "cube" && GetParam() == "mlt") continue;  // Chains stay in its corners for long.
    for (const int depth : {1, 2, 4, -1}) expect_furnace(GetParam(), shape, depth, true);
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, LongFurnace,
                         testing::Values("path", "ptracer", "bdpt", "pssmlt", "mlt"),
                         [](const auto& info) { return info.param; });

TEST(FurnaceByDirectLight, HasTheFirstTwoTermsOfTheSeries) {
  for (const std::string shape : {"cube", "sphere"}) {
    const ScenePtr scene = furnace(shape);
    expect_image(scene, "direct", {}, constant_image(*scene, furnace_radiance(2)));
  }
}

// ---- lights over a plane: radiance = albedo / pi * irradiance

constexpr double plane_albedo = 0.6;

/// A camera that looks down on the plane z = 0 from the side of the light.
ScenePtr plane_below(const std::string& light) {
  return load_scene(
      camera("0, -2.5, 2.5", "0, 0, 0", 25, film(8, 6), "perspective", "", "0, 0, 1") + light +
      rectangle(scale(2), diffuse("0.6 0.6 0.6")));
}

/// The image of the plane with this irradiance, by a fine rule over each pixel.
template <class Irradiance>
Image image_of_plane(const Scene& scene, Irradiance&& irradiance) {
  const Camera& camera = scene.camera();
  const SurfacePoint lens = camera.sample_position({0.5, 0.5}, 0).at;
  const Vec2i size = camera.raster().size;
  Image image(size.x, size.y, 3);
  constexpr int n = 16;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      Color sum(0);
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const Vec3 w = camera.direction(lens, {x + (i + 0.5) / n, y + (j + 0.5) / n});
          sum += irradiance(lens.p - w * (lens.p.z / w.z));
        }
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) = static_cast<float>(sum[c] * plane_albedo * inv_pi / (n * n));
    }
  return image;
}

struct Light {
  std::string name, xml;
  std::function<Color(const Vec3&)> irradiance;
};

std::vector<Light> lights() {
  const Vec3 center(0.3, 0.4, 1.5);
  const double radius = 0.3;
  const Vec3 towards_sun = normalize(Vec3(0.3, -0.2, 1));
  return {
      // pi L (r / d)^2 cos(theta), for a sphere above the horizon (Martinez & Howell's C-120).
      {"sphere",
       sphere(center.x, center.y, center.z, radius, diffuse("0 0 0") + area_light("8 4 2")),
       [=](const Vec3& p) {
         const Vec3 d = center - p;
         return Color(8, 4, 2) * (pi * sqr(radius) * d.z / (length_squared(d) * length(d)));
       }},
      {"point",
       "<emitter type='point'><point name='position' x='0.3' y='0.4' z='1.5'/>"
       "<rgb name='intensity' value='3 2 1'/></emitter>",
       [=](const Vec3& p) {
         const Vec3 d = center - p;
         return Color(3, 2, 1) * (d.z / (length_squared(d) * length(d)));
       }},
      {"sun",
       "<emitter type='directional'><vector name='direction' x='-0.3' y='0.2' z='-1'/>"
       "<rgb name='irradiance' value='3 2 1'/></emitter>",
       [=](const Vec3&) { return Color(3, 2, 1) * towards_sun.z; }},
      {"sky", sky, [](const Vec3&) { return Color(0.5, 0.7, 1) * pi; }},
  };
}

void expect_lights_over_plane(const std::string& integrator) {
  for (const Light& light : lights()) {
    SCOPED_TRACE(light.name);
    const ScenePtr scene = plane_below(light.xml);
    expect_image(scene, integrator,
                 integrator == "direct" ? Assignments() : Assignments{{"max_depth", "2"}},
                 image_of_plane(*scene, light.irradiance));
  }
}

class LightOverPlane : public testing::TestWithParam<std::string> {};

TEST_P(LightOverPlane, HasItsIrradiance) { expect_lights_over_plane(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Integrators, LightOverPlane, testing::Values("path", "direct", "bdpt"),
                         [](const auto& info) { return info.param; });

class LongLightOverPlane : public testing::TestWithParam<std::string> {};

TEST_P(LongLightOverPlane, HasItsIrradiance) { expect_lights_over_plane(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Integrators, LongLightOverPlane,
                         testing::Values("ptracer", "pssmlt", "mlt"),
                         [](const auto& info) { return info.param; });

// ---- lights that shine along their normals alone

std::string beam(const std::string& power_per_area) {
  return "<emitter type='directionalarea'><rgb name='radiance' value='" + power_per_area +
         "'/></emitter>";
}

std::vector<Light> beams() {
  const Vec3 center(0.3, 0.4, 1.5);
  return {
      {"square", rectangle(scale(4) + rotate("x", 150) + translate(0, 0, 5), beam("3 2 1")),
       [](const Vec3&) { return Color(3, 2, 1) * std::cos(pi / 6); }},
      // It shines like a point whose intensity is the power per area times the squared radius.
      {"sphere", sphere(center.x, center.y, center.z, 0.3, diffuse("0 0 0") + beam("30 20 10")),
       [=](const Vec3& p) {
         const Vec3 d = center - p;
         return Color(30, 20, 10) * (sqr(0.3) * d.z / (length_squared(d) * length(d)));
       }},
  };
}

void expect_beams_over_plane(const std::string& integrator) {
  for (const Light& light : beams()) {
    SCOPED_TRACE(light.name);
    const ScenePtr scene = plane_below(light.xml);
    expect_image(scene, integrator, {{"max_depth", "2"}}, image_of_plane(*scene, light.irradiance));
  }
}

class BeamOverPlane : public testing::TestWithParam<std::string> {};

TEST_P(BeamOverPlane, HasItsIrradiance) { expect_beams_over_plane(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Integrators, BeamOverPlane, testing::Values("ptracer", "bdpt"),
                         [](const auto& info) { return info.param; });

class LongBeamOverPlane : public testing::TestWithParam<std::string> {};

TEST_P(LongBeamOverPlane, HasItsIrradiance) { expect_beams_over_plane(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Integrators, LongBeamOverPlane,
                         testing::Values("pssmlt_bdpt", "mmlt", "rjmlt", "erpt", "mlt"),
                         [](const auto& info) { return info.param; });

TEST(Beams, AreDarkForWalksFromTheCameraAloneWhichSaySo) {
  const ScenePtr scene = plane_below(beams()[0].xml);
  Stats stats;
  const auto rendering = rendered(scene, integrator("path"), 1, 4);
  rendering->add_stats(stats);
  EXPECT_TRUE(rendering->image() == constant_image(*scene, Color(0)));
  ASSERT_EQ(stats.warnings.size(), 1u);
  EXPECT_NE(stats.warnings[0].find("along its normals alone"), std::string::npos);
}

TEST(Beams, AreNotLeftToDirectSamples) {
  const ScenePtr scene = plane_below(beams()[0].xml);
  EXPECT_THROW(integrator("mlt", {{"direct_samples", "4"}})->start(scene, 1), UsageError);
}

// ---- the camera's lens and the film's filter do not change a constant

TEST(FurnaceInAPicture, IsTheSameThroughAnyLensAndFilter) {
  for (const std::string filter : {"gaussian", "tent", "mitchell", "lanczos"})
    for (const std::string name : {"path", "bdpt"}) {
      SCOPED_TRACE(filter + " " + name);
      const std::string lens = camera(
          "0.2, 0.1, 0.3", "0, 0, -1", 60, film(12, 9, "<rfilter type='" + filter + "'/>"),
          "thinlens",
          "<float name='aperture_radius' value='0.3'/><float name='focus_distance' value='1'/>");
      const ScenePtr scene =
          load_scene(lens + "<shape type='cube'><boolean name='flip_normals' value='true'/>" +
                     diffuse("0.5 0.6 0.2") + area_light("1 0.5 0.25") + "</shape>");
      expect_image(scene, name, {{"max_depth", "3"}}, constant_image(*scene, furnace_radiance(3)));
    }
}

}  // namespace
}  // namespace mlt
