#include "scene/shape/disk.h"

#include "math/warp.h"
#include "scene/mesh/mesh_data.h"
#include "scene/shape/common.h"
#include "scene/texture/texture.h"
#include "scene/transform/transform_params.h"

namespace mlt {

Disk::Disk(const Mat4& to_world, bool flip_normals, const Location& location)
    : center_(to_world[3]), x_(to_world[0]), y_(to_world[1]) {
  where = location;
  if (is_singular(to_world) || !is_affine(to_world))
    throw SceneError(at(where, "'to_world' is singular: it flattens the disk or is not affine"));
  const Vec3 area_vector = cross(x_, y_);
  const double unit_area = length(area_vector);
  const Vec3 n = area_vector / unit_area;
  dual_x_ = cross(y_, n) / unit_area;
  dual_y_ = cross(n, x_) / unit_area;
  const bool z_is_behind = dot(n, Vec3(to_world[2])) < 0;
  normal_ = z_is_behind != flip_normals ? -n : n;
  area_ = pi * unit_area;
  set_extent();
}

Disk::Disk(Params& params)
    : Disk(matrix_param(params, "to_world"), params.boolean("flip_normals"), params.where()) {}

double Disk::plane_distance(const Vec3& o, const Vec3& d) const {
  return dot(center_ - o, normal_) / dot(d, normal_);
}

Vec2 Disk::to_disk(const Vec3& p) const {
  const Vec3 q = p - center_;
  return {dot(q, dual_x_), dot(q, dual_y_)};
}

std::optional<double> Disk::intersect(const Vec3& o, const Vec3& d, double t_min,
                                      double t_max) const {
  const double t = plane_distance(o, d);
  if (!(t >= t_min && t <= t_max)) return std::nullopt;
  const Vec2 q = to_disk(o + d * t);
  return q.x * q.x + q.y * q.y <= 1 ? std::optional<double>(t) : std::nullopt;
}

void Disk::surface_point(const Ray& ray, const Hit&, SurfacePoint& at) const {
  const Vec3 p = ray.o + ray.d * plane_distance(ray.o, ray.d);
  at = point(p, to_disk(p));
}

SurfacePoint Disk::point(const Vec3& p, const Vec2& q) const {
  const double r = std::sqrt(q.x * q.x + q.y * q.y);
  return point_at(p, normal_, Frame::around(normal_, r > 0 ? x_ * q.x + y_ * q.y : x_),
                  {r, turns(q.x, q.y)});
}

Shape::UvTangents Disk::uv_tangents(const SurfacePoint& at) const {
  const Vec2 q = to_disk(at.p);
  const double r = std::sqrt(q.x * q.x + q.y * q.y);
  const Vec2 outward = r > 0 ? q / r : Vec2(1, 0);
  return {x_ * outward.x + y_ * outward.y, (y_ * q.x - x_ * q.y) * (2 * pi)};
}

PositionSample Disk::sample_position(const Vec2& u) const {
  const Vec2 q = sample_disk(u);
  return {point(center_ + x_ * q.x + y_ * q.y, q), 1 / area_};
}

Vec2 Disk::invert_position(const SurfacePoint& at) const {
  const Vec2 u = invert_disk(to_disk(at.p));
  return {std::min(u.x, 1 - 0x1p-53), std::min(u.y, 1 - 0x1p-53)};
}

void Disk::bounds(Vec3& low, Vec3& high) const {
  const Vec3 reach = glm::sqrt(x_ * x_ + y_ * y_);
  low = center_ - reach;
  high = center_ + reach;
}

Plugin shape_disk() {
  return make_plugin<Disk>(
      shape_schema("disk", "A disk of radius 1 in the xy plane that faces +z.", {}));
}

}  // namespace mlt
