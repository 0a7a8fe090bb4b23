#include "scene/mesh/mesh.h"

#include "scene/shape_testing.h"

namespace mlt {
namespace {

using namespace shape_testing;

using testing::HasSubstr;

const Location here{"scene.xml", 3};

MeshData one_triangle() {
  MeshData data;
  data.positions = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  data.triangles = {{0, 1, 2}};
  return data;
}

/// `count` triangles of sizes from 1e-3 to 1, somewhere in a cube.
MeshData random_triangles(int count, uint64_t seed) {
  Rng rng(seed, Purpose::test, 0);
  MeshData data;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = random_point(rng);
    const double size = std::pow(10.0, -3 * rng.next());
    const auto first = static_cast<uint32_t>(data.positions.size());
    for (int k = 0; k < 3; ++k) data.positions.push_back(p + random_point(rng, size));
    data.triangles.push_back({first, first + 1, first + 2});
  }
  return data;
}

/// Eight corners, six quads.
MeshData closed_cube() {
  MeshData data;
  for (int i = 0; i < 8; ++i)
    data.positions.push_back(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  for (const auto& q : {std::array<uint32_t, 4>{0, 2, 3, 1},
                        {4, 5, 7, 6},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5}}) {
    data.triangles.push_back({q[0], q[1], q[2]});
    data.triangles.push_back({q[0], q[2], q[3]});
  }
  return data;
}

TEST(Mesh, CreasesStayWhereNeighboursDifferByMoreThanTheAngle) {
  MeshData sharp = closed_cube(), smooth = closed_cube(), expected = closed_cube();
  sharp.attributes = {{"vertex_i", false, 1, {0, 1, 2, 3, 4, 5, 6, 7}}};
  add_creased_normals(sharp, 80);
  ASSERT_EQ(sharp.positions.size(), 24u);
  ASSERT_EQ(sharp.normals.size(), 24u);
  for (const auto& corners : sharp.triangles) {
    const Vec3 n = normalize(sharp.triangle(corners).normal);
    for (const uint32_t i : corners) {
      expect_near(Vec3(sharp.normals[i]), n, 1e-6);
      EXPECT_EQ(sharp.positions[i],
                smooth.positions[static_cast<size_t>(sharp.attributes[0].values[i])]);
    }
  }
  add_creased_normals(smooth, 100);
  add_smooth_normals(expected);
  ASSERT_EQ(smooth.positions.size(), 8u);
  for (size_t t = 0; t < expected.triangles.size(); ++t)
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = smooth.triangles[t][k], b = expected.triangles[t][k];
      EXPECT_EQ(smooth.positions[a], expected.positions[b]);
      expect_near(Vec3(smooth.normals[a]), Vec3(expected.normals[b]), 1e-6);
    }
}

SurfacePoint hit_from_above(const Mesh& mesh, double x, double y) {
  const auto at = trace(mesh, {{x, y, 5}, {0, 0, -1}});
  EXPECT_TRUE(at.has_value());
  return at.value_or(SurfacePoint{});
}

TEST(Mesh, RefinesTheHitUntilDirectionAndPositionAgree) {
  const Mesh mesh(random_triangles(200, 1), Mat4(1), false, false, here);
  Rng rng(2, Purpose::test, 0);
  for (uint32_t i = 0; i < 200; ++i) {
    const auto& c = mesh.data().triangles[i];
    const Vec3 p0(mesh.data().positions[c[0]]), p1(mesh.data().positions[c[1]]),
        p2(mesh.data().positions[c[2]]);
    const Vec3 n = normalize(cross(p1 - p0, p2 - p0));
    for (const double distance : {1.0, 1e3, 1e5}) {
      const double b1 = 0.3, b2 = 0.5;
      Ray ray;
      ray.o = p0 + (p1 - p0) * b1 + (p2 - p0) * b2 + random_direction(rng) * distance;
      ray.d = normalize(p0 + (p1 - p0) * b1 + (p2 - p0) * b2 - ray.o);
      if (std::abs(dot(ray.d, n)) < 0.05) continue;
      const float noise = 1e-3f * static_cast<float>(2 * rng.next() - 1);
      SurfacePoint at;
      mesh.surface_point(ray, {distance, 0, i, 0.3f + noise, 0.5f - noise}, at);
      expect_near(normalize(at.p - ray.o), ray.d, 4e-16 * (1 + length(ray.o) / distance));
      EXPECT_LT(std::abs(dot(at.p - p0, n)), 1e-14 * (1 + length(ray.o)));
      EXPECT_EQ(at.primitive, i);
    }
  }
}

TEST(Mesh, UsesTheAcceleratorsBarycentricsWhereTheRayIsParallel) {
  const Mesh mesh(one_triangle(), Mat4(1), false, false, here);
  SurfacePoint at;
  mesh.surface_point({{-1, 0.25, 0}, {1, 0, 0}}, {1.5, 0, 0, 0.25f, 0.25f}, at);
  expect_near(at.p, {0.5, 0.25, 0}, 1e-15);
  mesh.surface_point({{-1, 0.25, 1e-9}, {1, 0, 0}}, {1.5, 0, 0, 0.25f, 0.25f}, at);
  expect_near(at.p, {0.5, 0.25, 0}, 1e-15);
}

TEST(Mesh, WithoutNormalsIsFlatAndFacesByWinding) {
  const Mesh mesh(one_triangle(), Mat4(1), false, false, here);
  const SurfacePoint at = hit_from_above(mesh, 0.5, 0.25);
  expect_near(at.ng, {0, 0, 1}, 0);
  expect_near(at.shading.n, {0, 0, 1}, 0);
  expect_near(at.shading.s, {1, 0, 0}, 1e-15);
  expect_near({at.uv.x, at.uv.y, 0}, {0.25, 0.25, 0}, 1e-15);  // Barycentrics.
  EXPECT_EQ(at.kind, PointKind::surface);
  EXPECT_EQ(at.extent, 2);
}

TEST(Mesh, FlipNormalsTurnsBothNormals) {
  MeshData data = one_triangle();
  data.normals = {{0, 0.6f, 0.8f}, {0, 0.6f, 0.8f}, {0, 0.6f, 0.8f}};
  const SurfacePoint plain = hit_from_above(Mesh(data, Mat4(1), false, false, here), 0.5, 0.25);
  const SurfacePoint turned = hit_from_above(Mesh(data, Mat4(1), false, true, here), 0.5, 0.25);
  expect_near(plain.ng, {0, 0, 1}, 0);
  expect_near(plain.shading.n, {0, 0.6, 0.8}, 1e-7);
  expect_near(turned.ng, -plain.ng, 0);
  expect_near(turned.shading.n, -plain.shading.n, 0);
  expect_near(turned.shading.s, plain.shading.s, 1e-15);
}

TEST(Mesh, GeometricNormalIsOnTheSideOfTheShadingNormal) {
  MeshData data = one_triangle();
  data.normals = {{0, 0.6f, -0.8f}, {0, 0, -1}, {0, 0, -1}};
  const SurfacePoint at = hit_from_above(Mesh(data, Mat4(1), false, false, here), 0.5, 0.25);
  expect_near(at.ng, {0, 0, -1}, 0);
  EXPECT_GT(dot(at.ng, at.shading.n), 0);
}

TEST(Mesh, FaceNormalsDropsTheNormals) {
  MeshData data = one_triangle();
  data.normals = {{0, 0.6f, 0.8f}, {0, 0.6f, 0.8f}, {0, 0.6f, 0.8f}};
  const Mesh mesh(data, Mat4(1), true, false, here);
  EXPECT_TRUE(mesh.data().normals.empty());
  expect_near(hit_from_above(mesh, 0.5, 0.25).shading.n, {0, 0, 1}, 0);
}

TEST(Mesh, FrameFollowsTheTextureCoordinates) {
  MeshData data = one_triangle();
  data.uvs = {{0, 0}, {0, 2}, {1, 0}};  // u grows along y.
  SurfacePoint at = hit_from_above(Mesh(data, Mat4(1), false, false, here), 0.5, 0.25);
  expect_near(at.shading.s, {0, 1, 0}, 1e-15);
  expect_near({at.uv.x, at.uv.y, 0}, {0.25, 0.5, 0}, 1e-15);
  data.uvs = {{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}};  // Degenerate: any frame.
  at = hit_from_above(Mesh(data, Mat4(1), false, false, here), 0.5, 0.25);
  EXPECT_NEAR(length(at.shading.s), 1, 1e-15);
  EXPECT_NEAR(dot(at.shading.s, at.shading.n), 0, 1e-15);
}

TEST(Mesh, NormalsMoveWithTheInverseTranspose) {
  MeshData data = one_triangle();
  const Vec3f tilted(Vec3(1, 0, 1) / std::sqrt(2.0));
  data.normals = {tilted, tilted, tilted};
  const Mesh mesh(data, scaling(4, 1, 1), false, false, here);
  expect_near(hit_from_above(mesh, 1, 0.25).shading.n, normalize(Vec3(0.25, 0, 1)), 1e-7);
}

TEST(Mesh, UnusableNormalsBecomeTheFaceNormal) {
  MeshData data = one_triangle();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  data.normals = {{0, 0, 0}, {nan, 0, 1}, {0, 0, 7}};
  const Mesh mesh(data, Mat4(1), false, false, here);
  for (const Vec3f& n : mesh.data().normals) expect_near(Vec3(n), {0, 0, 1}, 0);
}

TEST(Mesh, NormalsThatCancelBecomeTheFaceNormal) {
  MeshData data = one_triangle();
  data.normals = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};
  const Mesh mesh(data, Mat4(1), false, false, here);
  SurfacePoint at;
  mesh.surface_point({{1, 0, 5}, {0, 0, -1}}, {5, 0, 0, 0.5f, 0}, at);
  expect_near(at.shading.n, {0, 0, 1}, 1e-12);
}

TEST(Mesh, TinyAndHugeTrianglesKeepTheirNormal) {
  for (const double size : {1e-30, 1e-12, 1e15, 1e30}) {
    const Mesh mesh(one_triangle(), scaling(size, size, size), false, false, here);
    SurfacePoint at;
    mesh.surface_point({{0.5 * size, 0.25 * size, size}, {0, 0, -1}}, {size, 0, 0, 0.25f, 0.25f},
                       at);
    expect_near(at.ng, {0, 0, 1}, 1e-15);
    EXPECT_NEAR(mesh.area() / (size * size), 1, 1e-6);
  }
}

TEST(Mesh, SmoothNormalsAreWeightedByAngle) {
  // Three faces of a cube meet at the origin; one is split in two, which must not matter.
  MeshData data;
  data.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.5f, 0}};
  data.triangles = {{0, 4, 1}, {0, 2, 4}, {0, 3, 2}, {0, 1, 3}};
  add_smooth_normals(data);
  expect_near(Vec3(data.normals[0]), Vec3(-1, -1, -1) / std::sqrt(3.0), 1e-7);
  expect_near(Vec3(data.normals[4]), {0, 0, -1}, 1e-7);
}

TEST(Mesh, RefusesWhatIsBroken) {
  const auto error = [](const MeshData& data, const Mat4& to_world = Mat4(1)) {
    return error_of([&] { Mesh(data, to_world, false, false, here); });
  };
  MeshData bad = one_triangle();
  bad.triangles[0][1] = 3;
  EXPECT_EQ(error(bad), "scene.xml:3: triangle 0 uses vertex 3, but there are only 3");
  bad = one_triangle();
  bad.positions[2].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(error(bad), HasSubstr("vertex 2 is not finite"));
  bad.positions[2].y = std::numeric_limits<float>::infinity();
  EXPECT_THAT(error(bad), HasSubstr("vertex 2 is not finite"));
  bad = one_triangle();
  bad.uvs = {{0, 0}, {0, 0}, {std::numeric_limits<float>::infinity(), 0}};
  EXPECT_THAT(error(bad), HasSubstr("texture coordinates of vertex 2"));
  bad = one_triangle();
  bad.normals.resize(2);
  EXPECT_THAT(error(bad), HasSubstr("as many normals"));
  EXPECT_THAT(error({}), HasSubstr("no triangles"));
  EXPECT_THAT(error(one_triangle(), scaling(1, 1, 0)), HasSubstr("singular"));
  EXPECT_THAT(error(one_triangle(), rows({1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0, 0, 0, 0, 1})),
              HasSubstr("singular"));
  EXPECT_THAT(error(one_triangle(), scaling(1e39, 1, 1)), HasSubstr("not finite"));
  EXPECT_EQ(error(one_triangle(), scaling(1e-6, 1e-6, 1e-6)), "");
}

TEST(Mesh, SamplesItsAreaUniformly) {
  Mesh mesh(random_triangles(6, 4), scaling(1, -2, 1), false, false, here);
  mesh.prepare_sampling();
  mesh.set_index(5);
  constexpr int samples = 60000, cells = 4;
  std::vector<int> count(6 * cells);
  Rng rng(5, Purpose::test, 0);
  for (int i = 0; i < samples; ++i) {
    const PositionSample sample = mesh.sample_position({rng.next(), rng.next()});
    EXPECT_EQ(sample.pdf, 1 / mesh.area());
    EXPECT_EQ(sample.at.shape, 5u);
    // The medial triangles: four parts of equal area. uv are the barycentrics here.
    const Vec2 b = sample.at.uv;
    const int cell = b.x > 0.5 ? 1 : b.y > 0.5 ? 2 : b.x + b.y < 0.5 ? 3 : 0;
    ++count[sample.at.primitive * cells + static_cast<uint32_t>(cell)];
  }
  double chi2 = 0, total = 0;
  int bins = 0;
  for (uint32_t i = 0; i < 6; ++i) {
    const auto& c = mesh.data().triangles[i];
    const Vec3 p0(mesh.data().positions[c[0]]);
    const double area = 0.5 * length(cross(Vec3(mesh.data().positions[c[1]]) - p0,
                                           Vec3(mesh.data().positions[c[2]]) - p0));
    total += area;
    const double expected = samples * area / mesh.area() / cells;
    for (int cell = 0; expected >= 5 && cell < cells; ++cell, ++bins)
      chi2 += sqr(count[i * cells + static_cast<uint32_t>(cell)] - expected) / expected;
  }
  EXPECT_NEAR(mesh.area(), total, 1e-14);
  ASSERT_GT(bins, 8);
  // Wilson & Hilferty 1931: (chi2 / k)^(1/3) is nearly normal; 3.72 is the 1e-4 quantile.
  const double k = bins - 1;
  EXPECT_LT((std::cbrt(chi2 / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k)), 3.72);
}

TEST(Mesh, InvertsItsSamples) {
  Mesh mesh(random_triangles(50, 6), Mat4(1), false, true, here);
  mesh.prepare_sampling();
  Rng rng(7, Purpose::test, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 u(rng.next(), rng.next());
    const PositionSample sample = mesh.sample_position(u);
    const Vec2 inverse = mesh.invert_position(sample.at);
    EXPECT_NEAR(inverse.x, u.x, 1e-9);
    EXPECT_NEAR(inverse.y, u.y, 1e-6);
  }
}

TEST(Mesh, NeverSamplesDegenerateTriangles) {
  MeshData data = one_triangle();
  data.triangles = {{0, 0, 1}, {0, 1, 2}, {2, 2, 2}};
  Mesh mesh(data, Mat4(1), false, false, here);
  mesh.prepare_sampling();
  EXPECT_EQ(mesh.data().triangles.size(), 3u);
  for (const double u : {0.0, 1e-300, 0.5, 1 - 0x1p-53})
    EXPECT_EQ(mesh.sample_position({u, 0.5}).at.primitive, 1u);
  data.triangles = {{0, 0, 1}};
  Mesh flat(data, Mat4(1), false, false, here);
  EXPECT_EQ(flat.area(), 0);
  EXPECT_THROW(flat.prepare_sampling(), SceneError);
}

TEST(Mesh, KnowsItsBoundsAndSize) {
  const Mesh mesh(one_triangle(), scaling(-1, 2, 3), false, false, here);
  Vec3 low, high;
  mesh.bounds(low, high);
  expect_near(low, {-2, 0, 0}, 0);
  expect_near(high, {0, 2, 0}, 0);
  EXPECT_GE(mesh.bytes(), 48u);
}

}  // namespace
}  // namespace mlt
