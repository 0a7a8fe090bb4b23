// A hit is found by Embree in single precision and refined here in double precision, so that the
// direction of a ray and the position that it leads to agree to rounding. Barycentrics follow
// Moeller & Trumbore 1997, "Fast, minimum storage ray/triangle intersection", with the normal kept.
#include "scene/mesh.h"

#include "math/warp.h"

namespace mlt {

Mesh::Mesh(MeshData data, const Mat4& to_world, bool face_normals, bool flip_normals,
           const Location& location)
    : data_(std::move(data)), side_(flip_normals ? -1 : 1) {
  where = location;
  if (face_normals) data_.normals = {};
  check_mesh(data_, where);
  transform_mesh(data_, to_world, where);
  if (to_world != Mat4(1)) check_mesh(data_, where);
  repair_normals(data_);
  data_.positions.reserve(data_.positions.size() + 1);  // See data().
  for (uint32_t i = 0; i < data_.triangles.size(); ++i) area_ += 0.5 * length(triangle(i).normal);
}

size_t Mesh::bytes() const {
  const auto size = [](const auto& buffer) { return buffer.size() * sizeof(buffer[0]); };
  return size(data_.positions) + size(data_.normals) + size(data_.uvs) + size(data_.triangles) +
         (triangle_areas_.size() + 1) * sizeof(double);
}

inline Mesh::Triangle Mesh::triangle(uint32_t index) const {
  return data_.triangle(data_.triangles[index]);
}

/// The largest coordinate of a vertex, without its sign.
inline float Mesh::reach(uint32_t vertex) const {
  const Vec3f& p = data_.positions[vertex];
  return std::max(std::max(std::fabs(p.x), std::fabs(p.y)), std::fabs(p.z));
}

void Mesh::surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const {
  // p0 + b1 e1 + b2 e2 = o + t d, solved by triple products of s = o - p0.
  const Triangle tri = triangle(hit.primitive);
  const Vec3 s = ray.o - tri.p0;
  const Vec3 moment = cross(s, ray.d);
  const double scale = -1 / dot(ray.d, tri.normal);
  double b1 = dot(tri.e2, moment) * scale;
  double b2 = -dot(tri.e1, moment) * scale;
  const double u = hit.u, v = hit.v;
  if (std::abs(b1 - u) < 0.1 && std::abs(b2 - v) < 0.1) {
    at.p = ray.o + ray.d * (dot(s, tri.normal) * scale);
  } else {  // The ray is too nearly parallel to the triangle.
    b1 = u;
    b2 = v;
    at.p = tri.p0 + tri.e1 * b1 + tri.e2 * b2;
  }
  fill(tri, hit.primitive, b1, b2, at);
}

inline void Mesh::fill(const Triangle& tri, uint32_t index, double b1, double b2,
                       SurfacePoint& at) const {
  const auto& corners = data_.triangles[index];
  const double l2 = length_squared(tri.normal);
  const Vec3 ng = l2 > 0 ? tri.normal * (side_ / std::sqrt(l2)) : Vec3(0, 0, side_);
  at.ng = ng;
  Vec3 n = ng, m = tri.normal * side_;  // The shading normal, and a multiple of it.
  if (!data_.normals.empty()) {
    const Vec3 sum = Vec3(data_.normals[corners[0]]) * (1 - b1 - b2) +
                     Vec3(data_.normals[corners[1]]) * b1 + Vec3(data_.normals[corners[2]]) * b2;
    const double sum2 = length_squared(sum);
    if (sum2 > 1e-12) {
      n = sum * (side_ / std::sqrt(sum2));
      m = sum * side_;
    }
    at.ng = ng * std::copysign(1.0, dot(ng, n));
  }
  if (data_.uvs.empty()) {
    at.uv = {b1, b2};
    at.shading = Frame::around(n);
  } else {
    const Vec2 uv0(data_.uvs[corners[0]]);
    const Vec2 d1 = Vec2(data_.uvs[corners[1]]) - uv0;
    const Vec2 d2 = Vec2(data_.uvs[corners[2]]) - uv0;
    at.uv = uv0 + d1 * b1 + d2 * b2;
    // Solves e1 = d1.x dp/du + d1.y dp/dv and e2 likewise, up to a positive factor.
    const Vec3 dp_du =
        (tri.e1 * d2.y - tri.e2 * d1.y) * std::copysign(1.0, d1.x * d2.y - d1.y * d2.x);
    at.shading = Frame::around(n, m, dp_du);
  }
  at.extent = std::max({reach(corners[0]), reach(corners[1]), reach(corners[2])});
  at.shape = index_;
  at.primitive = index;
  at.kind = PointKind::surface;
}

void Mesh::prepare_sampling() {
  if (!(area_ > 0)) throw SceneError(at(where, "a mesh without area cannot emit light"));
  std::vector<double> areas(data_.triangles.size());
  for (uint32_t i = 0; i < areas.size(); ++i) areas[i] = length(triangle(i).normal);
  triangle_areas_ = Discrete(areas);
}

PositionSample Mesh::sample_position(const Vec2& u) const {
  const Discrete::Sample chosen = triangle_areas_.sample_reuse(u.x);
  const auto index = static_cast<uint32_t>(chosen.index);
  const Vec2 b = sample_triangle({chosen.remainder, u.y});
  const Triangle tri = triangle(index);
  PositionSample sample;
  sample.at.p = tri.p0 + tri.e1 * b.x + tri.e2 * b.y;
  fill(tri, index, b.x, b.y, sample.at);
  sample.pdf = 1 / area_;
  return sample;
}

Vec2 Mesh::invert_position(const SurfacePoint& at) const {
  const Triangle tri = triangle(at.primitive);
  const Vec3 q = at.p - tri.p0;
  const double scale = 1 / length_squared(tri.normal);
  const Vec2 b(dot(cross(q, tri.e2), tri.normal) * scale,
               dot(cross(tri.e1, q), tri.normal) * scale);
  const Vec2 u = invert_triangle(b);
  const auto clamp = [](double x) { return std::min(std::max(x, 0.0), 1 - 0x1p-53); };
  return {triangle_areas_.invert(at.primitive, clamp(u.x)), clamp(u.y)};
}

void Mesh::bounds(Vec3& low, Vec3& high) const {
  Vec3f least = data_.positions[0], most = least;
  for (const Vec3f& p : data_.positions) {
    least = glm::min(least, p);
    most = glm::max(most, p);
  }
  low = Vec3(least);
  high = Vec3(most);
}

}  // namespace mlt
