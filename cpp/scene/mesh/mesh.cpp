// A hit is found by Embree in single precision and refined here in double precision, so that the
// direction of a ray and the position that it leads to agree to rounding. Barycentrics follow
// Moeller & Trumbore 1997, "Fast, minimum storage ray/triangle intersection", with the normal kept.
#include "scene/mesh/mesh.h"

namespace mlt {
namespace {

float reach(const Vec3f& p) {
  return std::max(std::max(std::fabs(p.x), std::fabs(p.y)), std::fabs(p.z));
}

TriangleRecord record_of(const MeshData& data, const std::array<uint32_t, 3>& corners,
                         double side) {
  TriangleRecord record;
  record.p0 = data.positions[corners[0]];
  record.p1 = data.positions[corners[1]];
  record.p2 = data.positions[corners[2]];
  record.extent = std::max({reach(record.p0), reach(record.p1), reach(record.p2)});
  const Vec3 normal = data.triangle(corners).normal;
  const double l2 = length_squared(normal);
  record.ng = l2 > 0 ? normal * (side / std::sqrt(l2)) : Vec3(0, 0, side);
  return record;
}

void bound(const std::vector<Vec3f>& positions, Vec3& low, Vec3& high) {
  Vec3f least = positions[0], most = least;
  for (const Vec3f& p : positions) {
    least = glm::min(least, p);
    most = glm::max(most, p);
  }
  low = Vec3(least);
  high = Vec3(most);
}

}  // namespace

Mesh::Mesh(MeshData data, const Mat4& to_world, bool face_normals, bool flip_normals,
           const Location& location)
    : side_(flip_normals ? -1 : 1) {
  where = location;
  if (face_normals) data.normals = {};
  check_mesh(data, where);
  transform_mesh(data, to_world, where);
  if (to_world != Mat4(1)) check_mesh(data, where);
  repair_normals(data);
  data.positions.reserve(data.positions.size() + 1);  // See data().
  std::vector<TriangleRecord> records;
  records.reserve(data.triangles.size());
  for (const auto& corners : data.triangles) {
    records.push_back(record_of(data, corners, side_));
    area_ += 0.5 * length(data.triangle(corners).normal);
  }
  records_ = std::move(records);
  bound(data.positions, low_, high_);
  data_ = std::make_shared<const MeshData>(std::move(data));
  triangles_ = data_->triangles.data();
  normals_ = has_smooth_normals() ? data_->normals.data() : nullptr;
  uvs_ = data_->uvs.empty() ? nullptr : data_->uvs.data();
}

bool Mesh::has_smooth_normals() const {
  if (data_->normals.empty()) return false;
  for (size_t i = 0; i < records_.size(); ++i) {
    const Vec3f flat(records_[i].ng * side_);
    for (const uint32_t corner : data_->triangles[i]) {
      const Vec3f difference = glm::abs(data_->normals[corner] - flat);
      if (!(std::max({difference.x, difference.y, difference.z}) < 1e-6f)) return true;
    }
  }
  return false;
}

size_t Mesh::bytes() const {
  const auto size = [](const auto& buffer) { return buffer.size() * sizeof(buffer[0]); };
  size_t attributes = 0;
  for (const MeshAttribute& attribute : data_->attributes) attributes += size(attribute.values);
  return attributes + size(data_->positions) + size(data_->normals) + size(data_->uvs) +
         size(data_->triangles) + size(records_) + (triangle_areas_.size() + 1) * sizeof(double);
}

void Mesh::surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const {
  // p0 + b1 e1 + b2 e2 = o + t d, solved by triple products of s = o - p0.
  const Edges tri = records_[hit.primitive].edges();
  const Vec3 normal = cross(tri.e1, tri.e2);
  const Vec3 s = ray.o - tri.p0;
  const Vec3 moment = cross(s, ray.d);
  const double scale = -1 / dot(ray.d, normal);
  double b1 = dot(tri.e2, moment) * scale;
  double b2 = -dot(tri.e1, moment) * scale;
  const double u = hit.u, v = hit.v;
  if (std::abs(b1 - u) < 0.1 && std::abs(b2 - v) < 0.1) {
    at.p = ray.o + ray.d * (dot(s, normal) * scale);
  } else {  // The ray is too nearly parallel to the triangle.
    b1 = u;
    b2 = v;
    at.p = tri.p0 + tri.e1 * b1 + tri.e2 * b2;
  }
  fill(tri, hit.primitive, b1, b2, at);
}

void Mesh::fill(const Edges& tri, uint32_t index, double b1, double b2, SurfacePoint& at) const {
  const TriangleRecord& record = records_[index];
  at.ng = record.ng;
  at.extent = record.extent;
  at.shape = index_;
  at.primitive = index;
  at.kind = PointKind::surface;
  if (!normals_ && !uvs_) {
    at.uv = {b1, b2};
    at.shading = Frame::around(record.ng);
    return;
  }
  const auto& corners = triangles_[index];
  Vec3 n = record.ng, m = n;  // The shading normal, and a multiple of it.
  if (normals_) {
    const Vec3 sum = Vec3(normals_[corners[0]]) * (1 - b1 - b2) + Vec3(normals_[corners[1]]) * b1 +
                     Vec3(normals_[corners[2]]) * b2;
    const double sum2 = length_squared(sum);
    if (sum2 > 1e-12) {
      n = sum * (side_ / std::sqrt(sum2));
      m = sum * side_;
    }
    at.ng = record.ng * std::copysign(1.0, dot(record.ng, n));
  }
  at.uv = {b1, b2};
  at.shading = Frame::around(n);
  if (!uvs_) return;
  const Vec2 uv0(uvs_[corners[0]]);
  const Vec2 d1 = Vec2(uvs_[corners[1]]) - uv0;
  const Vec2 d2 = Vec2(uvs_[corners[2]]) - uv0;
  at.uv = uv0 + d1 * b1 + d2 * b2;
  if (bsdf_ && bsdf_->lambertian().known()) return;  // its scattering is the same in any frame
  at.shading = Frame::around(n, m, multiple_of_dp_du(tri.e1, tri.e2, d1, d2));
}

void Mesh::textured_point(uint32_t triangle, const Vec2& b, SurfacePoint& at) const {
  const TriangleRecord& record = records_[triangle];
  const double b0 = 1 - b.x - b.y;
  at.p = Vec3(record.p0) * b0 + Vec3(record.p1) * b.x + Vec3(record.p2) * b.y;
  at.uv = b;
  at.shape = index_;
  at.primitive = triangle;
  if (!uvs_) return;
  const auto& corners = triangles_[triangle];
  at.uv = Vec2(uvs_[corners[0]]) * b0 + Vec2(uvs_[corners[1]]) * b.x + Vec2(uvs_[corners[2]]) * b.y;
}

std::optional<Vec3> Mesh::moved_normal(const SurfacePoint& at, const Mat3& inverse) const {
  if (!normals_) return std::nullopt;
  const auto& corners = triangles_[at.primitive];
  const Vec2 b = barycentrics(at);
  const double weights[3] = {1 - b.x - b.y, b.x, b.y};
  Vec3 sum(0);
  for (int i = 0; i < 3; ++i) sum += normalize(Vec3(normals_[corners[i]]) * inverse) * weights[i];
  if (!(length_squared(sum) > 1e-12)) return std::nullopt;
  return normalize(sum) * side_;
}

Shape::UvTangents Mesh::uv_tangents(const SurfacePoint& at) const {
  const Edges tri = records_[at.primitive].edges();
  if (!uvs_) return {tri.e1, tri.e2};  // uv are the barycentrics.
  const auto& corners = triangles_[at.primitive];
  const Vec2 uv0(uvs_[corners[0]]);
  const Vec2 d1 = Vec2(uvs_[corners[1]]) - uv0, d2 = Vec2(uvs_[corners[2]]) - uv0;
  const double det = d1.x * d2.y - d1.y * d2.x;
  if (det == 0) return {at.shading.s, at.shading.t};
  return {(tri.e1 * d2.y - tri.e2 * d1.y) / det, (tri.e2 * d1.x - tri.e1 * d2.x) / det};
}

}  // namespace mlt
