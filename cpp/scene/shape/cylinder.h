// The side of a circular cylinder, open at both ends. u is the azimuth, v runs from 0 to 1 along
// the axis.
#pragma once

#include "scene/shape/analytic_shape.h"

namespace mlt {

class Cylinder : public AnalyticShape {
 public:
  /// A cylinder from `base` along frame.n; azimuths are counted from frame.s towards frame.t (the
  /// frame may be left-handed). Normals point outward, or inward with `flip_normals`.
  Cylinder(const Vec3& base, const Frame& frame, double radius, double length, bool flip_normals);

  const Vec3& base() const { return base_; }
  const Vec3& axis() const { return frame_.n; }
  double radius() const { return radius_; }
  double length() const { return length_; }

  ObjectPtr copy() const override { return std::make_shared<Cylinder>(*this); }

  std::optional<double> intersect(const Vec3& o, const Vec3& d, double t_min,
                                  double t_max) const override;
  void surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const override;
  double area() const override { return 2 * pi * radius_ * length_; }
  PositionSample sample_position(const Vec2& u) const override;
  Vec2 invert_position(const SurfacePoint& at) const override;
  UvTangents uv_tangents(const SurfacePoint& at) const override;
  void bounds(Vec3& low, Vec3& high) const override;

 private:
  std::optional<Roots> roots(const Vec3& o, const Vec3& d) const;
  /// The point at the height z and in the direction (x, y) from the axis, a unit vector.
  SurfacePoint point(const Vec2& outward, double z) const;

  Vec3 base_;
  Frame frame_;
  double radius_, length_;
  double side_;  ///< 1 if the normals point outward, else -1.
};

}  // namespace mlt
