// An ellipse filled: the unit disk under an affine map. u is the distance from the centre, v the
// azimuth from +x.
#pragma once

#include "base/params.h"
#include "scene/shape/analytic_shape.h"

namespace mlt {

class Disk : public AnalyticShape {
 public:
  /// The disk of radius 1 in the xy plane under `to_world`. The normal stays on the side of the
  /// image of +z. Throws SceneError if `to_world` is singular or no affine map.
  Disk(const Mat4& to_world, bool flip_normals, const Location& where);

  explicit Disk(Params& params);

  ObjectPtr copy() const override { return std::make_shared<Disk>(*this); }

  std::optional<double> intersect(const Vec3& o, const Vec3& d, double t_min,
                                  double t_max) const override;
  void surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const override;
  double area() const override { return area_; }
  PositionSample sample_position(const Vec2& u) const override;
  Vec2 invert_position(const SurfacePoint& at) const override;
  UvTangents uv_tangents(const SurfacePoint& at) const override;
  void bounds(Vec3& low, Vec3& high) const override;

 private:
  /// Distance along the line to the plane; not finite if they are parallel.
  double plane_distance(const Vec3& o, const Vec3& d) const;
  /// The point of the unit disk that is mapped to p.
  Vec2 to_disk(const Vec3& p) const;
  SurfacePoint point(const Vec3& p, const Vec2& q) const;

  Vec3 center_, x_, y_;   ///< The images of the origin and of the two axes.
  Vec3 dual_x_, dual_y_;  ///< In the plane, with dot(dual_i, axis_j) = 1 if i = j, else 0.
  Vec3 normal_;           ///< Unit normal, on the front side.
  double area_;
};

}  // namespace mlt
