#include "scene/mesh/mesh_data.h"

#include <algorithm>
#include <string>
#include <utility>

namespace mlt {
namespace {

bool is_finite(const Vec2f& v) { return std::isfinite(v.x) && std::isfinite(v.y); }

/// The angle between two vectors of the given lengths.
double angle(const Vec3& a, double length_a, const Vec3& b, double length_b) {
  return std::acos(std::clamp(dot(a, b) / (length_a * length_b), -1.0, 1.0));
}

bool is_usable(const Vec3& normal) {
  const double l2 = length_squared(normal);
  return l2 > 0 && std::isfinite(l2);
}

void check_attributes(const MeshData& data, const Location& where) {
  for (const MeshAttribute& attribute : data.attributes) {
    const size_t count = attribute.on_faces ? data.triangles.size() : data.positions.size();
    if (attribute.values.size() != count * attribute.channels)
      throw SceneError(at(where, "the attribute '{}' has {} values, but needs {}", attribute.name,
                          attribute.values.size(), count * attribute.channels));
    for (const float value : attribute.values)
      if (!std::isfinite(value))
        throw SceneError(at(where, "the attribute '{}' is not finite", attribute.name));
  }
}

}  // namespace

void check_mesh(const MeshData& data, const Location& where) {
  const size_t count = data.positions.size();
  if (data.triangles.empty()) throw SceneError(at(where, "the mesh has no triangles"));
  if (count == 0) throw SceneError(at(where, "the mesh has triangles, but no vertices"));
  if ((!data.normals.empty() && data.normals.size() != count) ||
      (!data.uvs.empty() && data.uvs.size() != count))
    throw SceneError(at(where, "the mesh needs as many normals and uvs as vertices"));
  for (size_t i = 0; i < data.triangles.size(); ++i)
    for (const uint32_t index : data.triangles[i])
      if (index >= count)
        throw SceneError(
            at(where, "triangle {} uses vertex {}, but there are only {}", i, index, count));
  for (size_t i = 0; i < count; ++i)
    if (!is_finite(Vec3(data.positions[i])))
      throw SceneError(
          at(where, "the position of vertex {} is not finite (in single precision)", i));
  for (size_t i = 0; i < data.uvs.size(); ++i)
    if (!is_finite(data.uvs[i]))
      throw SceneError(at(where, "the texture coordinates of vertex {} are not finite", i));
  check_attributes(data, where);
}

bool is_singular(const Mat4& m) {
  const Mat3 linear(m);
  const double scale = length(linear[0]) * length(linear[1]) * length(linear[2]);
  return !(std::abs(glm::determinant(linear)) > 1e-12 * scale) ||
         !(std::abs(glm::determinant(m)) > 0);
}

void transform_mesh(MeshData& data, const Mat4& to_world, const Location& where) {
  if (is_singular(to_world))
    throw SceneError(at(where, "'to_world' is singular: it flattens the shape or is not finite"));
  const Vec3 origin = std::exchange(data.origin, Vec3(0));
  if (to_world == Mat4(1) && origin == Vec3(0)) return;
  const bool affine = is_affine(to_world);
  const Mat3 linear(to_world);
  const Vec3 offset = linear * origin + Vec3(to_world[3]);
  for (Vec3f& p : data.positions)
    p = affine ? linear * Vec3(p) + offset : transform_point(to_world, origin + Vec3(p));
  const Mat4 inverse = glm::inverse(to_world);
  for (Vec3f& n : data.normals) {
    const Vec3 moved = transform_normal(inverse, Vec3(n));
    n = is_usable(moved) ? normalize(moved) : moved;
  }
}

void add_smooth_normals(MeshData& data) {
  std::vector<Vec3> sums(data.positions.size(), Vec3(0));
  for (const auto& corners : data.triangles) {
    const auto [p0, a, b, normal] = data.triangle(corners);
    const double l = length(normal);
    if (!(l > 0)) continue;
    const double length_a = length(a), length_b = length(b);
    const double angle0 = angle(a, length_a, b, length_b);
    const double angle1 = angle(-a, length_a, b - a, length(b - a));
    sums[corners[0]] += normal * (angle0 / l);
    sums[corners[1]] += normal * (angle1 / l);
    sums[corners[2]] += normal * ((pi - angle0 - angle1) / l);
  }
  data.normals.resize(sums.size());
  std::transform(sums.begin(), sums.end(), data.normals.begin(),
                 [](const Vec3& sum) { return is_usable(sum) ? Vec3f(normalize(sum)) : Vec3f(0); });
}

void repair_normals(MeshData& data) {
  bool all_usable = true;
  for (Vec3f& n : data.normals) {
    const bool usable = is_usable(Vec3(n));
    n = usable ? Vec3f(normalize(Vec3(n))) : Vec3f(0);
    all_usable = all_usable && usable;
  }
  if (all_usable) return;
  for (const auto& corners : data.triangles)
    for (const uint32_t corner : corners) {
      if (data.normals[corner] != Vec3f(0)) continue;
      const Vec3 normal = data.triangle(corners).normal;
      if (is_usable(normal)) data.normals[corner] = normalize(normal);
    }
}

}  // namespace mlt
