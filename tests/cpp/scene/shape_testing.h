// What the tests of shapes share.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/registry.h"
#include "base/rng.h"
#include "scene/mesh/mesh.h"
#include "scene/shape/analytic_shape.h"
#include "scene/shape/shape.h"

namespace mlt::shape_testing {

inline Vec3 random_direction(Rng& rng) {
  const double z = 2 * rng.next() - 1, phi = 2 * pi * rng.next(), r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

inline Vec3 random_point(Rng& rng, double size = 1) {
  return size * Vec3(2 * rng.next() - 1, 2 * rng.next() - 1, 2 * rng.next() - 1);
}

inline Mat4 rows(const Matrix& m) {
  Mat4 result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) result[column][row] = m[4 * row + column];
  return result;
}

inline Mat4 scaling(double x, double y, double z) {
  return rows({x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1});
}

/// The nearest hit with a triangle of the mesh, rounded to single precision as an accelerator
/// would.
inline std::optional<Hit> nearest_hit(const Mesh& mesh, const Ray& ray) {
  std::optional<Hit> nearest;
  const MeshData& data = mesh.data();
  for (uint32_t i = 0; i < data.triangles.size(); ++i) {
    const auto& c = data.triangles[i];
    const Vec3 p0(data.positions[c[0]]);
    const Vec3 e1 = Vec3(data.positions[c[1]]) - p0, e2 = Vec3(data.positions[c[2]]) - p0;
    const Vec3 n = cross(e1, e2);
    const double t = dot(p0 - ray.o, n) / dot(ray.d, n);
    const Vec3 q = ray.o + ray.d * t - p0;
    const double u = dot(cross(q, e2), n) / dot(n, n), v = dot(cross(e1, q), n) / dot(n, n);
    if (!(t > 0 && u >= 0 && v >= 0 && u + v <= 1) || (nearest && nearest->t <= t)) continue;
    nearest = Hit{static_cast<float>(t), 0, i, static_cast<float>(u), static_cast<float>(v)};
  }
  return nearest;
}

inline std::optional<Hit> nearest_hit(const AnalyticShape& shape, const Ray& ray) {
  const std::optional<double> t = shape.intersect(ray.o, ray.d, 0, infinity);
  if (!t) return std::nullopt;
  return Hit{static_cast<float>(*t), 0, 0, 0, 0};
}

inline std::optional<SurfacePoint> trace(const Shape& shape, const Ray& ray) {
  std::optional<Hit> hit;
  if (const Mesh* mesh = shape.as_mesh())
    hit = nearest_hit(*mesh, ray);
  else if (const AnalyticShape* analytic = shape.as_analytic())
    hit = nearest_hit(*analytic, ray);
  if (!hit) return std::nullopt;
  SurfacePoint at;
  shape.surface_point(ray, *hit, at);
  return at;
}

/// Makes a shape as the scene loader does.
inline std::shared_ptr<Shape> make_shape(const Plugin& plugin,
                                         const std::map<std::string, Value>& given) {
  Params params(plugin.schema, {"scene.xml", 7});
  for (const auto& [name, value] : given) params.set(name, value, {"scene.xml", 8});
  auto shape = std::dynamic_pointer_cast<Shape>(make_object(plugin, params));
  params.expect_all_read();
  return shape;
}

/// The message of the Error that `action` throws; "" if it throws none.
template <class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Runs `read` on every truncation of `bytes` (each in a buffer of its own, so that a sanitizer
/// sees any read past its end); all must throw a typed error or succeed.
template <class Read>
void expect_truncations_are_safe(const std::string& bytes, Read read) {
  for (size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<char> cut(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(size));
    try {
      read(std::string_view(cut.data(), cut.size()));
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("mesh.file")) << "cut to " << size;
    }
  }
}

inline void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LE(length(a - b), tolerance) << "(" << a.x << ", " << a.y << ", " << a.z << ") and ("
                                      << b.x << ", " << b.y << ", " << b.z << ")";
}

}  // namespace mlt::shape_testing
