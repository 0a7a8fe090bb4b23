// A sphere, intersected in double precision.
#pragma once

#include "scene/shape.h"

#include <optional>

namespace mlt {

class Sphere : public Shape {
 public:
  /// Throws SceneError if `to_world` scales unevenly or is singular, or the radius is not positive.
  Sphere(const Vec3& center, double radius, const Mat4& to_world, bool flip_normals,
         const Location& where);

  /// The nearest intersection with t_min <= t <= t_max.
  std::optional<double> intersect(const Vec3& o, const Vec3& d, double t_min, double t_max) const;

  void surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const override;
  double area() const override;
  PositionSample sample_position(const Vec2& u) const override;
  Vec2 invert_position(const SurfacePoint& at) const override;
  /// From outside: uniform in the cone of directions that see the sphere.
  PositionSample sample_direct(const Vec3& from, const Vec2& u) const override;
  double pdf_direct(const Vec3& from, const SurfacePoint& at) const override;
  Vec2 invert_direct(const Vec3& from, const SurfacePoint& at) const override;
  void bounds(Vec3& low, Vec3& high) const override;
  const Sphere* as_sphere() const override { return this; }

 private:
  void fill(const Vec3& normal, SurfacePoint& at) const;

  Vec3 center_;
  double radius_;
  Mat3 to_object_;  ///< Rotation that turns world directions into the sphere's own, for uv.
  bool flip_normals_;
};

}  // namespace mlt
