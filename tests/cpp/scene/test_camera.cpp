#include "scene/camera/camera.h"

#include <gmock/gmock.h>

#include "base/rng.h"
#include "harness/chi_square.h"
#include "scene/mesh/mesh.h"
#include "scene/plugin_testing.h"

namespace mlt {

Plugin sensor_fisheye();
Plugin sensor_irradiancemeter();
Plugin sensor_orthographic();
Plugin sensor_perspective();
Plugin sensor_spherical();
Plugin sensor_thinlens();
Plugin shape_cube();
Plugin shape_disk();
Plugin shape_sphere();

namespace {

using test::error_in;
using test::expect_close;
using test::Given;
using test::make;
using testing::HasSubstr;

// lookat(origin 1 2 3, target -2 0.5 1, up 0.1 1 0.2), and the same with the x axis reversed.
const Matrix placed = {-0.508597069,
                       -0.388800159,
                       -0.768221280,
                       1,  //
                       -0.119669899,
                       0.915499213,
                       -0.384110640,
                       2,  //
                       0.852647838,
                       -0.103424896,
                       -0.512147520,
                       3,  //
                       0,
                       0,
                       0,
                       1};

Matrix with_scaled_axes(Matrix m, double x, double y, double z) {
  for (size_t row = 0; row < 3; ++row) {
    m[4 * row] *= x;
    m[4 * row + 1] *= y;
    m[4 * row + 2] *= z;
  }
  return m;
}

Raster whole(int width, int height, double border = 0) {
  return {{width, height}, {0, 0}, {width, height}, border};
}

CameraPtr camera(const Plugin& plugin, const Given& given, const Raster& raster) {
  CameraPtr made = make<Camera>(plugin, given);
  made->set_raster(raster);
  return made;
}

SurfacePoint lens_center(const Camera& camera) { return camera.sample_position({0.5, 0.5}, 0).at; }

std::vector<CameraPtr> all_cameras() {
  const Raster odd{{57, 83}, {11, 7}, {31, 23}, 1.5};
  return {
      camera(sensor_perspective(), {{"fov", 40.0}}, whole(64, 36)),
      camera(sensor_perspective(),
             {{"fov", 100.0}, {"to_world", placed}, {"principal_point_offset_x", 0.1}}, odd),
      camera(sensor_perspective(), {{"to_world", with_scaled_axes(placed, -1, 1, 1)}}, odd),
      camera(
          sensor_thinlens(),
          {{"fov", 60.0}, {"to_world", placed}, {"aperture_radius", 0.3}, {"focus_distance", 2.5}},
          odd),
      camera(sensor_thinlens(),
             {{"fov", 60.0},
              {"aperture_radius", 2.0},
              {"principal_point_offset_y", -0.2},
              {"to_world", with_scaled_axes(placed, 1, -1, 1)}},
             whole(20, 30, 2)),
      camera(sensor_orthographic(), {{"to_world", with_scaled_axes(placed, 3, -2, 1)}}, odd)};
}

/// Cameras whose image is no plane.
std::vector<CameraPtr> panoramic_cameras() {
  const Raster cropped{{80, 60}, {28, 20}, {31, 23}, 1.5};
  return {camera(sensor_spherical(), {{"to_world", placed}}, whole(64, 32, 2)),
          camera(sensor_spherical(), {}, cropped),
          camera(sensor_fisheye(), {{"to_world", placed}, {"fov", 250.0}}, cropped),
          camera(sensor_fisheye(), {{"fov", 100.0}}, cropped)};
}

/// The panoramic cameras and all_cameras().
std::vector<CameraPtr> cameras_of_all_kinds() {
  std::vector<CameraPtr> cameras = all_cameras();
  for (const CameraPtr& made : panoramic_cameras()) cameras.push_back(made);
  return cameras;
}

/// Meters on shapes, each of which keeps its shape.
std::vector<CameraPtr> meters() {
  std::vector<CameraPtr> meters;
  for (const Plugin& plugin : {shape_cube(), shape_disk(), shape_sphere()}) {
    const auto shape = make<Shape>(plugin, {{"to_world", placed}});
    if (const auto mesh = std::dynamic_pointer_cast<Mesh>(shape)) mesh->prepare_sampling();
    const CameraPtr meter = camera(sensor_irradiancemeter(), {}, whole(1, 1));
    meter->set_shape(shape.get());
    const auto both = std::make_shared<std::pair<ShapePtr, CameraPtr>>(shape, meter);
    meters.emplace_back(both, meter.get());
  }
  return meters;
}

std::vector<CameraPtr> all_cameras_and_meters() {
  std::vector<CameraPtr> all = cameras_of_all_kinds();
  for (const CameraPtr& meter : meters()) all.push_back(meter);
  return all;
}

/// Directions that are nearly parallel differ little from pixel to pixel, and linearly.
bool parallel(const Camera& camera, const SurfacePoint& xk) {
  return camera.entrance(xk, xk.ng) != xk.p;
}

struct Sight {
  Vec2 raster;
  Vec3 direction;
};

/// Directions of Mitsuba 3.9.1's sensors (scalar_rgb, sample_ray).
struct MitsubaCase {
  std::string name;
  Given given;
  Raster raster;
  std::vector<Sight> sights;
};

std::vector<MitsubaCase> mitsuba_cases() {
  const auto axis = [](const char* name) {
    return Given{{"fov", 40.0}, {"fov_axis", std::string(name)}};
  };
  return {{"fov along x",
           {{"fov", 40.0}},
           whole(64, 36),
           {{{0, 0}, {0.3358611, 0.18892185, 0.92277074}},
            {{57.6, 7.2}, {-0.2776415, 0.117130056, 0.9535175}},
            {{16.0, 27.0}, {0.17814326, -0.10020551, 0.97888917}}}},
          {"fov along y",
           axis("y"),
           whole(64, 36),
           {{{0, 0}, {0.5195355, 0.2922387, 0.8029194}},
            {{57.6, 7.2}, {-0.45129785, 0.19039133, 0.8718265}}}},
          {"fov along the diagonal",
           axis("diagonal"),
           whole(64, 36),
           {{{0, 0}, {0.2980964, 0.16767922, 0.9396926}},
            {{57.6, 7.2}, {-0.2446703, 0.10322033, 0.9640964}}}},
          {"smaller, tall",
           axis("smaller"),
           whole(36, 64),
           {{{32.4, 12.8}, {-0.26195857, 0.34927824, 0.8996569}}}},
          {"larger, tall",
           axis("larger"),
           whole(36, 64),
           {{{32.4, 12.8}, {-0.15800528, 0.21067378, 0.9647024}}}},
          {"smaller, wide",
           axis("smaller"),
           whole(64, 36),
           {{{57.6, 7.2}, {-0.45129785, 0.19039133, 0.8718265}}}},
          {"larger, wide",
           axis("larger"),
           whole(64, 36),
           {{{57.6, 7.2}, {-0.2776415, 0.117130056, 0.9535175}}}},
          {"focal length",
           {{"focal_length", std::string("35mm")}},
           whole(64, 36),
           {{{57.6, 7.2}, {-0.39037725, 0.16469045, 0.90580505}},
            {{16.0, 27.0}, {0.25734854, -0.14475846, 0.9554144}}}},
          {"no parameters",
           {},
           whole(64, 36),
           {{{57.6, 7.2}, {-0.28670344, 0.120953076, 0.9503534}},
            {{16.0, 27.0}, {0.18428762, -0.10366171, 0.9773906}}}},
          {"principal point, crop",
           {{"fov", 40.0}, {"principal_point_offset_x", 0.1}, {"principal_point_offset_y", 0.2}},
           {{64, 36}, {10, 5}, {20, 10}, 0},
           {{{0, 0}, {0.17433923, 0.06481843, 0.98254997}},
            {{18.0, 2.0}, {-0.027262134, 0.0431651, 0.9986959}},
            {{5.0, 7.5}, {0.11967628, -0.019193353, 0.9926274}}}},
          {"placed, crop",
           {{"fov", 70.0}, {"to_world", placed}},
           {{50, 50}, {5, 15}, {30, 20}, 0},
           {{{0, 0}, {-0.9848187, -0.16503532, -0.053808846}},
            {{27.0, 4.0}, {-0.7105376, -0.20023103, -0.67456937}},
            {{7.5, 15.0}, {-0.8344808, -0.5185736, -0.18634126}}}},
          {"mirrored",
           {{"fov", 70.0}, {"to_world", with_scaled_axes(placed, -1, 1, 1)}},
           whole(64, 36),
           {{{0, 0}, {-0.44064516, 0.04698354, -0.8964508}},
            {{57.6, 7.2}, {-0.97837144, -0.20062566, -0.050383583}},
            {{16.0, 27.0}, {-0.47657984, -0.4848514, -0.73334223}}}}};
}

TEST(Perspective, LooksWhereMitsubaLooks) {
  for (const MitsubaCase& c : mitsuba_cases()) {
    const CameraPtr made = camera(sensor_perspective(), c.given, c.raster);
    for (const Sight& s : c.sights)
      expect_close(made->direction(lens_center(*made), s.raster), s.direction, 1e-6, c.name);
  }
}

TEST(ThinLens, LooksWhereMitsubaLooks) {
  const CameraPtr made = camera(
      sensor_thinlens(),
      {{"fov", 50.0}, {"to_world", placed}, {"aperture_radius", 0.2}, {"focus_distance", 3.0}},
      whole(64, 36));
  struct {
    Vec2 raster;
    Vec3 p, w;
  } const sights[] = {
      {{0, 0}, {1.0256875, 2.0368726, 2.9338143}, {-0.97701484, -0.1856719, -0.10472717}},
      {{57.6, 7.2}, {0.9864465, 1.882884, 3.1081672}, {-0.5781894, -0.14232522, -0.8033932}},
      {{16.0, 27.0}, {0.93001616, 2.1647897, 2.9813836}, {-0.77789783, -0.5620207, -0.2810827}}};
  for (const auto& s : sights) {
    SurfacePoint xk = lens_center(*made);
    xk.p = s.p;
    expect_close(made->direction(xk, s.raster), s.w, 1e-6);
  }
}

TEST(Camera, ScalesOfItsTransformMeanNothing) {
  const CameraPtr plain = camera(sensor_perspective(), {{"to_world", placed}}, whole(64, 36));
  const CameraPtr scaled = camera(
      sensor_perspective(), {{"to_world", with_scaled_axes(placed, 2, 0.1, 30)}}, whole(64, 36));
  const SurfacePoint a = lens_center(*plain), b = lens_center(*scaled);
  expect_close(a.p, {1, 2, 3}, 1e-15);
  expect_close(b.p, {1, 2, 3}, 1e-15);
  expect_close(plain->direction(a, {3, 5}), scaled->direction(b, {3, 5}), 1e-8);
}

TEST(Camera, RasterPositionInvertsDirection) {
  Rng rng(1, Purpose::test, 0);
  for (const CameraPtr& made : all_cameras_and_meters())
    for (int i = 0; i < 1000; ++i) {
      const SurfacePoint xk = made->sample_position({rng.next(), rng.next()}, 0).at;
      const Vec2 raster = made->raster().sample({rng.next(), rng.next()});
      const Vec3 w = made->direction(xk, raster);
      EXPECT_NEAR(length(w), 1, 1e-14);
      const auto back = made->raster_position(xk, w);
      ASSERT_TRUE(back);
      EXPECT_LT(length(*back - raster), parallel(*made, xk) ? 1e-6 : 1e-10);
    }
}

TEST(Camera, SeesNothingOutsideOfTheSampledDomain) {
  for (const CameraPtr& made : all_cameras()) {
    const SurfacePoint xk = made->sample_position({0.3, 0.8}, 0).at;
    const Raster& r = made->raster();
    const Vec2 inside[] = {{-r.border + 1e-6, -r.border + 1e-6},
                           {r.size.x + r.border - 1e-6, r.size.y + r.border - 1e-6}};
    const Vec2 outside[] = {{-r.border - 1e-6, 1},
                            {1, -r.border - 1e-6},
                            {r.size.x + r.border + 1e-6, 1},
                            {1, r.size.y + r.border + 1e-6}};
    for (const Vec2& p : inside) EXPECT_TRUE(made->raster_position(xk, made->direction(xk, p)));
    for (const Vec2& p : outside) {
      const Vec3 w = made->direction(xk, p);
      EXPECT_FALSE(made->raster_position(xk, w));
      EXPECT_EQ(made->eval(xk, w), 0);
      EXPECT_EQ(made->pdf_direction(xk, w), 0);
    }
    const Vec3 behind = -made->direction(xk, Vec2(r.size) * 0.5);
    EXPECT_FALSE(made->raster_position(xk, behind));
    EXPECT_EQ(made->eval(xk, behind), 0);
  }
}

/// |d omega / d raster| of the map `direction`, by central differences.
double solid_angle_per_pixel(const Camera& camera, const SurfacePoint& xk, const Vec2& raster) {
  const double h = parallel(camera, xk) ? 1 : 1e-4;
  const Vec3 dx =
      camera.direction(xk, raster + Vec2(h, 0)) - camera.direction(xk, raster - Vec2(h, 0));
  const Vec3 dy =
      camera.direction(xk, raster + Vec2(0, h)) - camera.direction(xk, raster - Vec2(0, h));
  return length(cross(dx, dy)) / sqr(2 * h);
}

TEST(Camera, DirectionsHaveTheDensityThatItReports) {
  Rng rng(2, Purpose::test, 0);
  for (const CameraPtr& made : cameras_of_all_kinds())
    for (int i = 0; i < 200; ++i) {
      const SurfacePoint xk = made->sample_position({rng.next(), rng.next()}, 0).at;
      const Vec2 raster = made->raster().sample({rng.next(), rng.next()});
      const Vec3 w = made->direction(xk, raster);
      // Uniform in raster space: 1 / area = pdf * |cos| * |d omega / d raster|.
      const double density =
          made->pdf_direction(xk, w) * abs_cos(xk, w) * solid_angle_per_pixel(*made, xk, raster);
      EXPECT_NEAR(density * made->raster().sampled_area(), 1, 1e-6);
    }
}

TEST(Camera, ImportanceIntegratesToOneOverTheImage) {
  Rng rng(3, Purpose::test, 0);
  const int n = 64;
  for (const CameraPtr& made : cameras_of_all_kinds()) {
    const Raster& r = made->raster();
    double integral = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        // One stratum of the image each, with a random point on the lens.
        const PositionSample lens = made->sample_position({rng.next(), rng.next()}, 0);
        const Vec2 raster((i + rng.next()) * r.size.x / n, (j + rng.next()) * r.size.y / n);
        const Vec3 w = made->direction(lens.at, raster);
        integral += made->eval(lens.at, w) * abs_cos(lens.at, w) / lens.pdf *
                    solid_angle_per_pixel(*made, lens.at, raster) * r.pixels() / (n * n);
      }
    EXPECT_NEAR(integral, 1, 1e-6);
  }
}

TEST(Camera, PositionsAreATriple) {
  Rng rng(4, Purpose::test, 0);
  for (const CameraPtr& made : all_cameras_and_meters()) {
    for (int i = 0; i < 200; ++i) {
      const Vec2 u(rng.next(), rng.next());
      const PositionSample sample = made->sample_position(u, 0);
      EXPECT_EQ(sample.pdf, made->pdf_position(sample.at));
      if (made->delta_position()) {
        EXPECT_EQ(sample.pdf, 1);
      } else {
        EXPECT_LT(length(made->invert_position(sample.at) - u), 1e-9);
      }
    }
  }
}

TEST(IrradianceMeter, SeesTheHemisphereAboveItsShape) {
  Rng rng(8, Purpose::test, 0);
  for (const CameraPtr& meter : meters())
    for (int i = 0; i < 100; ++i) {
      const PositionSample lens = meter->sample_position({rng.next(), rng.next()}, 0);
      const Vec3 w = meter->direction(lens.at, {rng.next(), rng.next()});
      EXPECT_GE(dot(w, lens.at.ng), 0);
      EXPECT_NEAR(meter->eval(lens.at, w), lens.pdf / pi, 1e-12);
      EXPECT_FALSE(meter->project(lens.at, -w));
      EXPECT_FALSE(meter->can_be_hit());
    }
}

TEST(ThinLens, PositionsFillTheLensUniformly) {
  const double radius = 0.7;
  const CameraPtr made = camera(sensor_thinlens(), {{"aperture_radius", radius}}, whole(4, 4));
  const auto result = test::chi_square_rect(
      [&](Rng& rng) -> std::optional<Vec2> {
        const Vec3 p = made->sample_position({rng.next(), rng.next()}, 0).at.p;
        return Vec2(length(p), std::atan2(p.y, p.x));
      },
      [&](const Vec2& polar) { return made->pdf_position({}) * polar.x; }, {0, -pi}, {radius, pi},
      50'000, 5);
  EXPECT_GT(result.p_value, 1e-4) << result;
  EXPECT_NEAR(result.integral, 1, 1e-9);
}

TEST(ThinLens, IsSharpAtTheFocusDistance) {
  const CameraPtr made =
      camera(sensor_thinlens(), {{"fov", 50.0}, {"aperture_radius", 0.5}, {"focus_distance", 4.0}},
             whole(64, 36));
  const Vec3 target(0.4, -0.3, 4);
  Rng rng(6, Purpose::test, 0);
  const auto seen = [&](const Vec2& u) {
    const SurfacePoint xk = made->sample_position(u, 0).at;
    return *made->raster_position(xk, normalize(target - xk.p));
  };
  const Vec2 first = seen({0.5, 0.5});
  for (int i = 0; i < 100; ++i) EXPECT_LT(length(seen({rng.next(), rng.next()}) - first), 1e-11);
}

TEST(ThinLens, FindsTheRaysThatPassThroughIt) {
  const CameraPtr made =
      camera(sensor_thinlens(), {{"to_world", placed}, {"aperture_radius", 0.5}}, whole(64, 36));
  Rng rng(7, Purpose::test, 0);
  for (int i = 0; i < 200; ++i) {
    const SurfacePoint xk = made->sample_position({rng.next(), rng.next()}, 0).at;
    const Vec3 w = made->direction(xk, made->raster().sample({rng.next(), rng.next()}));
    Ray ray{xk.p + 3.0 * w, -w};
    const auto hit = made->hit_lens(ray);
    ASSERT_TRUE(hit);
    expect_close(hit->p, xk.p, 1e-14);
    EXPECT_EQ(hit->ng, xk.ng);
    ray.t_max = 2.9;
    EXPECT_FALSE(made->hit_lens(ray));
    EXPECT_FALSE(made->hit_lens({xk.p + 3.0 * w, w}));
    EXPECT_FALSE(made->hit_lens({xk.p + 3.0 * w + 1.01 * xk.shading.s, -w}));
  }
  const CameraPtr pinhole = camera(sensor_perspective(), {}, whole(64, 36));
  EXPECT_FALSE(pinhole->hit_lens({{0, 0, 1}, {0, 0, -1}}));
}

TEST(ThinLens, WithoutExtentIsAPinhole) {
  const Given shifted = {{"principal_point_offset_x", 0.2}, {"principal_point_offset_y", -0.1}};
  Given given = shifted;
  given["aperture_radius"] = 0.0;
  const CameraPtr made = camera(sensor_thinlens(), given, whole(64, 36));
  const CameraPtr pinhole = camera(sensor_perspective(), shifted, whole(64, 36));
  EXPECT_TRUE(made->delta_position());
  const Vec3 w = made->direction(lens_center(*made), {3, 4});
  EXPECT_EQ(w, pinhole->direction(lens_center(*pinhole), {3, 4}));
  EXPECT_EQ(made->eval(lens_center(*made), w), pinhole->eval(lens_center(*pinhole), w));
}

/// Where the rays of a raster position enter the scene, and where they go.
Ray ray_through(const Camera& camera, const Vec2& raster) {
  const SurfacePoint xk = lens_center(camera);
  const Vec3 w = camera.direction(xk, raster);
  return {camera.entrance(xk, w), w};
}

TEST(Orthographic, RaysAreParallelAndStartOnItsPlane) {
  const CameraPtr made =
      camera(sensor_orthographic(), {{"to_world", with_scaled_axes(placed, 3, 2, 7)}},
             {{40, 20}, {4, 2}, {30, 10}, 0});
  made->set_bounds({{1, 2, 3}, 5});
  const auto axis = [](size_t i) { return Vec3(placed[i], placed[4 + i], placed[8 + i]); };
  for (const Vec2& raster : {Vec2(0, 0), Vec2(30, 10), Vec2(3.25, 7.5)}) {
    const Vec2 s = (raster + Vec2(4, 2)) / Vec2(40, 20);
    const Ray ray = ray_through(*made, raster);
    // x runs from 1 to -1 over the image, y over half of that: it is twice as wide as high.
    const Vec3 expected =
        Vec3(1, 2, 3) + 3 * (1 - 2 * s.x) * axis(0) + 2 * 0.5 * (1 - 2 * s.y) * axis(1);
    expect_close(ray.o, expected, 1e-6);
    expect_close(ray.d, axis(2), 1e-6);
  }
  const auto seen = made->project(lens_center(*made), axis(2));
  ASSERT_TRUE(seen);
  // We G: 1 over the area of what the crop window shows.
  const Vec3 x = Vec3(1, 2, 3) + 4.0 * axis(2);
  const double G = 1 / length_squared(x - lens_center(*made).p);
  const double area = (6 * 30 / 40.0) * (2 * 10 / 20.0);
  EXPECT_NEAR(seen->importance * G * area, 1, 1e-6);
}

TEST(Spherical, LooksAllAroundByLongitudeAndLatitude) {
  const CameraPtr made = camera(sensor_spherical(), {}, whole(64, 32));
  const struct {
    Vec2 raster;
    Vec3 w;
  } sights[] = {{{32, 16}, {0, 0, 1}},   // the middle
                {{48, 16}, {-1, 0, 0}},  // to the right
                {{16, 16}, {1, 0, 0}},  {{0, 16}, {0, 0, -1}},
                {{20, 0}, {0, 1, 0}},  // up
                {{20, 32}, {0, -1, 0}}, {{32, 24}, {0, -std::sqrt(0.5), std::sqrt(0.5)}}};
  for (const auto& [raster, w] : sights)
    expect_close(made->direction(lens_center(*made), raster), w, 1e-15);
  const auto behind = made->raster_position(lens_center(*made), {-0.0, 0, -1});
  ASSERT_TRUE(behind);
  EXPECT_EQ(*behind, Vec2(0, 16));
}

TEST(Spherical, SeesNothingOutsideOfTheCropWindow) {
  const CameraPtr made = camera(sensor_spherical(), {}, {{80, 60}, {28, 20}, {31, 23}, 1.5});
  const SurfacePoint xk = lens_center(*made);
  EXPECT_EQ(made->raster().border, 0);
  for (const Vec2& outside : {Vec2(-0.1, 5), Vec2(31.1, 5), Vec2(5, -0.1), Vec2(5, 23.1)}) {
    const Vec3 w = made->direction(xk, outside);
    EXPECT_FALSE(made->project(xk, w));
    EXPECT_EQ(made->reach(xk, w), infinity);
  }
}

TEST(Fisheye, AnglesAreProportionalToDistancesFromTheMiddle) {
  const CameraPtr made = camera(sensor_fisheye(), {{"fov", 200.0}}, whole(80, 60));
  for (const double share : {0.0, 0.3, 0.5, 0.999}) {
    const double theta = share * 100 * degree;
    expect_close(made->direction(lens_center(*made), {40 + 30 * share, 30}),
                 {-std::sin(theta), 0, std::cos(theta)}, 1e-14);
    expect_close(made->direction(lens_center(*made), {40, 30 - 30 * share}),
                 {0, std::sin(theta), std::cos(theta)}, 1e-14);
  }
}

TEST(Fisheye, IsBlackOutsideOfTheCircle) {
  for (const double fov : {20.0, 180.0, 360.0}) {
    const CameraPtr made =
        camera(sensor_fisheye(), {{"to_world", placed}, {"fov", fov}}, whole(80, 60, 2));
    for (const Vec2& outside : {Vec2(0, 0), Vec2(9.9, 30), Vec2(40, -1), Vec2(79, 59)}) {
      const Ray ray = made->ray(outside, Vec2(0.5), 0);
      EXPECT_EQ(ray.t_max, 0) << fov;
      EXPECT_NEAR(length(ray.d), 1, 1e-14);
      EXPECT_FALSE(made->project(lens_center(*made), ray.d)) << fov;
    }
    const Ray inside = made->ray({10.1, 30}, Vec2(0.5), 0);
    EXPECT_EQ(inside.t_max, infinity);
    EXPECT_TRUE(made->project(lens_center(*made), inside.d));
  }
}

TEST(Camera, TimeRunsThroughAllExposures) {
  const CameraPtr camera = make<Camera>(sensor_perspective(), {{"shutter_open", 1.0},
                                                               {"shutter_close", 4.0},
                                                               {"exposures", int64_t{3}},
                                                               {"exposure_share", 0.5}});
  const Shutter& shutter = camera->shutter();
  for (const auto& [u, time, exposure] : {std::tuple{0.0, 1.0, 0},
                                          {0.25, 1.375, 0},
                                          {1. / 3, 2.0, 1},
                                          {0.5, 2.25, 1},
                                          {0.9, 3.35, 2}}) {
    EXPECT_NEAR(camera->time(u), time, 1e-12);
    EXPECT_NEAR(shutter.number(time), u, 1e-12);
    EXPECT_EQ(shutter.exposure(camera->time(u)), exposure) << u;
  }
  EXPECT_THAT(error_in(sensor_perspective(), {{"exposures", int64_t{0}}}), HasSubstr("exposures"));
}

TEST(Camera, TimeRunsWhileTheShutterIsOpen) {
  const auto made =
      make<Camera>(sensor_perspective(), {{"shutterOpen", 0.5}, {"shutterClose", 2.5}});
  EXPECT_EQ(made->time(0), 0.5);
  EXPECT_EQ(made->time(0.25), 1);
  EXPECT_EQ(make<Camera>(sensor_perspective())->time(0.7), 0);
  EXPECT_THAT(error_in(sensor_perspective(), {{"shutter_open", 1.0}}), HasSubstr("shutter_close"));
}

TEST(Camera, RefusesWhatMakesNoImage) {
  for (double fov : {0.0, -10.0, 180.0, 1e9})
    EXPECT_THAT(error_in(sensor_perspective(), {{"fov", fov}}), HasSubstr("fov")) << fov;
  for (const char* bad : {"", "mm", "-5mm", "0mm", "50 miles", "1e999mm", "nan"})
    EXPECT_THAT(error_in(sensor_perspective(), {{"focal_length", std::string(bad)}}),
                HasSubstr("focal_length"))
        << bad;
  EXPECT_EQ(error_in(sensor_perspective(), {{"focalLength", std::string("50")}}), "");
  EXPECT_THAT(
      error_in(sensor_perspective(), {{"fov", 40.0}, {"focal_length", std::string("50mm")}}),
      HasSubstr("exclude"));
  Matrix singular = test::identity_rows, shear = test::identity_rows;
  singular[5] = 0;
  shear[1] = 0.1;
  EXPECT_THAT(error_in(sensor_perspective(), {{"to_world", singular}}), HasSubstr("singular"));
  EXPECT_THAT(error_in(sensor_perspective(), {{"to_world", shear}}), HasSubstr("shear"));
  for (double fov : {0.0, -10.0, 360.1})
    EXPECT_THAT(error_in(sensor_fisheye(), {{"fov", fov}}), HasSubstr("fov")) << fov;
  for (const Plugin& all_around : {sensor_spherical(), sensor_fisheye()})
    EXPECT_THAT(error_in(all_around, {{"near_clip", 1.0}}), HasSubstr("near_clip"));
  EXPECT_THAT(error_in(sensor_thinlens(), {}), HasSubstr("aperture_radius"));
  EXPECT_THAT(error_in(sensor_thinlens(), {{"aperture_radius", -1.0}}), HasSubstr("negative"));
  EXPECT_THAT(error_in(sensor_thinlens(), {{"aperture_radius", 1.0}, {"focus_distance", 0.0}}),
              HasSubstr("focus_distance"));
}

}  // namespace
}  // namespace mlt
