#include "scene/transform/motion.h"

#include <glm/gtc/matrix_transform.hpp>

#include "harness/chi_square.h"
#include "scene/emitter/moving.h"
#include "scene/same_points.h"
#include "scene/transform/matrix_rows.h"

namespace mlt {
namespace {

using namespace test;
using shape_testing::expect_near;
using testing::HasSubstr;

Keyframe key(double time, const Mat4& m) { return {time, to_rows(m)}; }
Mat4 moved(double x, double y, double z) { return glm::translate(Mat4(1), {x, y, z}); }
Mat4 turned(double degrees, const Vec3& axis) {
  return glm::rotate(Mat4(1), glm::radians(degrees), normalize(axis));
}
Mat4 stretched(double x, double y, double z) { return glm::scale(Mat4(1), {x, y, z}); }

double distance(const Mat4& a, const Mat4& b) {
  double largest = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) largest = std::max(largest, std::abs(a[i][j] - b[i][j]));
  return largest;
}

TEST(Motion, TurnsAtAConstantSpeedAndGoesStraight) {
  const Vec3 axis(1, 2, -1);
  const Motion motion({key(2, moved(1, 0, 0)), key(4, moved(3, 5, 0) * turned(120, axis))});
  for (const double b : {0.0, 0.1, 0.33, 0.5, 0.77, 1.0})
    EXPECT_LE(distance(motion.at(2 + 2 * b), moved(1 + 2 * b, 5 * b, 0) * turned(120 * b, axis)),
              2e-4)
        << b;
  EXPECT_EQ(motion.at(2), moved(1, 0, 0));
  EXPECT_EQ(motion.at(1), motion.at(2));
  EXPECT_EQ(motion.at(9), motion.at(4));
}

TEST(Motion, StretchesAlongTheAxesOfTheObject) {
  const Mat4 turn = turned(60, {0, 1, 1});
  const Motion motion({key(0, stretched(1, 2, 3)), key(1, turn * stretched(3, 2, 1))});
  EXPECT_LE(distance(motion.at(0.5), turned(30, {0, 1, 1}) * stretched(2, 2, 2)), 1e-3);
}

TEST(Motion, MayMirror) {
  const Motion motion(
      {key(0, stretched(-1, 1, 1)), key(1, turned(90, {0, 0, 1}) * stretched(-2, 2, 2))});
  for (const Mat4& step : motion.steps()) EXPECT_LT(glm::determinant(Mat3(step)), -0.9);
}

TEST(Motion, HasOneStepWhereItIsLinear) {
  EXPECT_EQ(Motion({key(0, Mat4(1)), key(1, moved(1, 2, 3))}).steps().size(), 2u);
  EXPECT_EQ(Motion({key(0, Mat4(1)), key(3, stretched(1, 2, 3))}).steps().size(), 2u);
  EXPECT_EQ(
      Motion({key(0, Mat4(1)), key(1, moved(1, 0, 0)), key(2, moved(0, 2, 0))}).steps().size(), 3u);
  EXPECT_LE(Motion({key(0, Mat4(1)), key(1, turned(170, {1, 1, 1}))}).steps().size(), 129u);
}

TEST(Animation, IsSeenWhileTheShutterIsOpen) {
  const Animation keys = {key(0, Mat4(1)), key(1, moved(4, 0, 0)), key(2, moved(4, 4, 0))};
  const auto seen = std::get<Animation>(during(keys, {0.5, 1.5}));
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_EQ(seen[0].time, 0.5);
  EXPECT_EQ(from_rows(seen[0].transform), moved(2, 0, 0));
  EXPECT_EQ(seen[1].transform, keys[1].transform);
  EXPECT_EQ(seen[2].time, 1.5);
  EXPECT_EQ(from_rows(seen[2].transform), moved(4, 2, 0));
  // Nothing moves while it is closed, before the first key, or between equal ones.
  EXPECT_EQ(from_rows(std::get<Matrix>(during(keys, {0.25, 0.25}))), moved(1, 0, 0));
  EXPECT_EQ(from_rows(std::get<Matrix>(during(keys, {-3, 0}))), Mat4(1));
  EXPECT_EQ(std::get<Matrix>(during(keys, {2, 5})), keys[2].transform);
}

TEST(Animation, IsRefusedInOneLine) {
  const Mat4 one(1), flat = stretched(1, 1, 0), mirrored = stretched(1, -1, 1);
  EXPECT_EQ(animation_problem({key(0, one), key(1, mirrored * mirrored)}), "");
  EXPECT_THAT(animation_problem({}), HasSubstr("0 transforms"));
  EXPECT_THAT(animation_problem({key(0, one)}), HasSubstr("1 transform,"));
  EXPECT_THAT(animation_problem({key(0, one), key(0, one)}), HasSubstr("must increase"));
  EXPECT_THAT(animation_problem({key(1, one), key(0, one)}),
              HasSubstr("time 0 after one at time 1"));
  EXPECT_THAT(animation_problem({key(0, one), key(1, flat)}), HasSubstr("singular"));
  EXPECT_THAT(animation_problem({key(0, one), key(1, mirrored)}), HasSubstr("mirrors"));
  EXPECT_THAT(animation_problem({key(0, one), key(1, moved(0, 2e9, 0))}), HasSubstr("1e+09"));
  EXPECT_THAT(animation_problem({key(0, one), key(1, stretched(1e-10, 1, 1))}),
              HasSubstr("moves or scales"));
}

// ---- what rays meet

const std::string light =
    "<emitter type='point'><point name='position' x='0' y='3' z='3'/></emitter>";
const std::string lens = camera("0, 0, 6", "0, 0, 0", 40, film(32, 24), "perspective",
                                "<float name='shutter_close' value='1'/>");

std::string matrix_text(const Mat4& m) {
  std::string text;
  for (const double x : to_rows(m)) text += fmt::format("{} ", x);
  return "<matrix value='" + text + "'/>";
}
std::string animated(const Animation& keys) {
  std::string text = "<animation name='to_world'>";
  for (const Keyframe& k : keys)
    text += fmt::format("<transform time='{}'>{}</transform>", k.time,
                        matrix_text(from_rows(k.transform)));
  return text + "</animation>";
}

const Animation spin = {
    key(0, moved(-0.3, 0, 0.2) * stretched(0.7, 0.7, 0.7)),
    key(0.6, moved(0.3, 0.1, 0) * turned(100, {1, 1, 0}) * stretched(0.5, 0.5, 0.5)),
    key(1, moved(0, -0.4, 0) * turned(200, {1, 2, 0}) * stretched(0.6, 0.6, 0.6))};

/// A shape of a scene that moves, against the same shape where it is at several times.
void expect_moves(const std::string& type, const std::string& nested, const Animation& keys) {
  const auto made = [&](const std::string& transform) {
    return load_scene(lens + light + "<shape type='" + type + "'>" + transform + nested +
                      "<bsdf type='roughconductor'/></shape>\n");
  };
  const ScenePtr moving = made(animated(keys));
  const Motion motion(keys);
  for (const double time : {0.0, 0.17, 0.5, 0.93, 1.0}) {
    SCOPED_TRACE(type + " at " + std::to_string(time));
    expect_same_points(moving, made(to_world(matrix_text(motion.at(time)))), time);
  }
}

Animation mirrored(Animation keys) {
  for (Keyframe& k : keys) k = key(k.time, from_rows(k.transform) * stretched(1, -1, 1));
  return keys;
}

TEST(MovingShape, IsMetWhereItIs) {
  expect_moves("cube", "", spin);
  expect_moves(
      "cube", "",
      {key(0, stretched(0.3, 0.9, 0.5)), key(1, turned(70, {0, 1, 0}) * stretched(0.9, 0.4, 0.5))});
}

/// A sphere that moves in a straight line stays one between the steps too.
TEST(MovingShape, OfAnEquationIsMetWhereItIs) {
  const Animation straight = {key(0, moved(-0.5, 0, 0) * turned(40, {1, 2, 3})),
                              key(1, moved(0.5, 0.3, 0.4) * turned(40, {1, 2, 3}))};
  const std::string small = "<float name='radius' value='0.6'/>";
  expect_moves("sphere", small, straight);
  expect_moves("sphere", small, mirrored(straight));
  expect_moves("cylinder", small, straight);
  expect_moves("disk", "", straight);
  expect_moves("disk", "", spin);
  expect_moves("cube", "", mirrored(spin));
}

TEST(MovingShape, IsWithinTheBoundsOfItsScene) {
  const ScenePtr scene = load_scene(
      lens + light + "<shape type='sphere'><float name='radius' value='0.1'/>" +
      animated({key(0, moved(5, 0, 0)), key(1, turned(179, {0, 0, 1}) * moved(5, 0, 0))}) +
      "</shape>");
  // Q turns the object, and T goes straight: from x = 5 to x = -5.
  for (const double x : {-5.0, 0.0, 5.0})
    EXPECT_LT(length(Vec3(x, 0, 0) - scene->bounds().center), scene->bounds().radius) << x;
  const ScenePtr turning =
      load_scene(lens + light + "<shape type='sphere'><point name='center' x='5' y='0' z='0'/>" +
                 animated({key(0, Mat4(1)), key(1, turned(179, {0, 0, 1}))}) + "</shape>");
  for (const double angle : {0.0, 45.0, 90.0, 179.0})
    EXPECT_LT(length(Vec3(turned(angle, {0, 0, 1}) * Vec4(6, 0, 0, 1)) - turning->bounds().center),
              turning->bounds().radius)
        << angle;
}

TEST(SurfacePoint, HasTheTimeOfItsRay) {
  for (const std::string type : {"sphere", "cylinder", "disk", "cube"}) {
    const ScenePtr scene = load_scene(lens + light + "<shape type='" + type + "'>" +
                                      to_world(rotate("y", 60)) + "</shape>");
    SurfacePoint at;
    ASSERT_TRUE(scene->intersect({{0.1, 0.1, 4}, {0, 0, -1}, 0.3}, at)) << type;
    EXPECT_EQ(at.time, 0.3) << type;
  }
}

// ---- a light that moves

/// The emitter of a scene with one shape, which shines and moves.
struct MovingLight {
  ScenePtr scene;
  const Emitter* emitter;

  MovingLight(const std::string& type, const Animation& keys)
      : scene(load_scene(lens + "<shape type='" + type + "'>" + animated(keys) +
                         area_light("1 2 3") + "</shape>")),
        emitter(scene->emitters()[0].get()) {}
};

const Animation uneven = {key(0, moved(0, 0, 1) * stretched(0.5, 1, 2)),
                          key(1, moved(1, 0, 0) * turned(80, {1, 0, 2}) * stretched(2, 1.5, 0.7))};

std::vector<MovingLight> moving_lights() {
  return {{"rectangle", spin},         {"sphere", spin},     {"cube", uneven},
          {"sphere", uneven},          {"cylinder", uneven}, {"disk", uneven},
          {"sphere", mirrored(uneven)}};
}

TEST(MovingLight, SamplesAreATriple) {
  const Vec3 from(1, 2.5, -4);
  for (const MovingLight& light : moving_lights()) {
    const Emitter& emitter = *light.emitter;
    Rng rng(1, Purpose::test, 0);
    for (int i = 0; i < 500; ++i) {
      const Vec2 u(rng.next(), rng.next());
      const double time = rng.next();
      const PositionSample x0 = emitter.sample_position(u, time);
      EXPECT_EQ(x0.at.time, time);
      EXPECT_NEAR(x0.pdf, emitter.pdf_position(x0.at), 1e-9 * x0.pdf);
      EXPECT_LT(length(emitter.invert_position(x0.at) - u), 1e-6);
      const PositionSample seen = emitter.sample_direct(from, u, time);
      EXPECT_NEAR(seen.pdf, emitter.pdf_direct(from, seen.at), 1e-8 * seen.pdf);
      EXPECT_LT(length(emitter.invert_direct(from, seen.at) - u), 1e-4);
      EXPECT_EQ(light.scene->emitter(x0.at), &emitter);
    }
  }
}

/// The integral of the density over the surface, found by uniform lines through a sphere of radius
/// R: they cross an area dA with the probability dA / (2 pi R^2), however it is turned (Crofton).
TEST(MovingLight, DensitiesIntegrateToOne) {
  std::vector<double> p_values;
  for (const MovingLight& light : moving_lights())
    for (const double time : {0.1, 0.8}) {
      Rng rng(2, Purpose::test, 0);
      Moments positions, seen;
      const Vec3 center = light.scene->bounds().center, from(1, 2.5, -4);
      const double R = light.scene->bounds().radius;
      for (int i = 0; i < 200'000; ++i) {
        const Frame disk = Frame::around(shape_testing::random_direction(rng));
        const double r = R * std::sqrt(rng.next()), phi = 2 * pi * rng.next();
        Ray ray{center + disk.to_world({r * std::cos(phi), r * std::sin(phi), 2 * R}), -disk.n,
                time};
        double sum = 0, sum_seen = 0;
        SurfacePoint at;
        while (light.scene->intersect(ray, at)) {
          sum += 2 * pi * sqr(R) * light.emitter->pdf_position(at);
          sum_seen += 2 * pi * sqr(R) * light.emitter->pdf_direct(from, at);
          ray = light.scene->spawn(at, ray.d, time);
        }
        positions.add(sum);
        seen.add(sum_seen);
      }
      p_values.push_back(one_sample_t_test(positions, 1).p_value);
      p_values.push_back(one_sample_t_test(seen, 1).p_value);
    }
  for (const double p : holm_adjusted(p_values)) EXPECT_GT(p, 1e-4);
}

/// A light of no size that moves, against the same light where it is at several times.
void expect_shines_as_a_still_light(const std::string& type) {
  const auto made = [&](const std::string& transform) {
    return load_scene(lens + "<emitter type='" + type + "'>" + transform + "</emitter>");
  };
  const ScenePtr moving = made(animated(spin));
  const Emitter& light = *moving->emitters()[0];
  Rng rng(3, Purpose::test, 0);
  for (const double time : {0.0, 0.17, 0.6, 0.93, 1.0}) {
    SCOPED_TRACE(type + " at " + std::to_string(time));
    const ScenePtr scene = made(to_world(matrix_text(Motion(spin).at(time))));
    const Emitter& still = *scene->emitters()[0];
    const Vec2 u(rng.next(), rng.next());
    const SurfacePoint x0 = light.sample_position(u, time).at;
    const SurfacePoint at_rest = still.sample_position(u, 0).at;
    EXPECT_EQ(x0.time, time);
    expect_near(x0.p, at_rest.p, 1e-9);
    const RaySample ray = light.sample_ray(x0, u), expected = still.sample_ray(at_rest, u);
    expect_near(ray.origin, expected.origin, 1e-9);
    expect_near(ray.direction, expected.direction, 1e-9);
    EXPECT_NEAR(ray.pdf, expected.pdf, 1e-9 * expected.pdf);
    EXPECT_NEAR(light.pdf_ray(x0, ray.direction), ray.pdf, 1e-9 * ray.pdf);
    EXPECT_LT(length(light.invert_ray(x0, x0.p + 2.0 * ray.direction) - u), 1e-6);
    EXPECT_LT(length((light.eval(x0, ray.direction) - still.eval(at_rest, ray.direction)).rgb()),
              1e-6);
  }
}

TEST(MovingLight, OfNoSizeShinesFromWhereItIs) {
  for (const char* type : {"point", "spot", "projector"}) expect_shines_as_a_still_light(type);
}

}  // namespace
}  // namespace mlt
