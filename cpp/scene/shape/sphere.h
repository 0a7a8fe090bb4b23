// A sphere. u is the azimuth about its z axis from +x, v the polar angle from +z.
#pragma once

#include "base/params.h"
#include "scene/shape/analytic_shape.h"

namespace mlt {

class Sphere : public AnalyticShape {
 public:
  /// Throws SceneError if `to_world` scales unevenly or is singular, or the radius is not positive.
  /// A `to_world` that mirrors turns the normals around.
  Sphere(const Vec3& center, double radius, const Mat4& to_world, bool flip_normals,
         const Location& where);

  explicit Sphere(Params& params);

  const Vec3& center() const { return center_; }
  double radius() const { return radius_; }

  ObjectPtr copy() const override { return std::make_shared<Sphere>(*this); }

  std::optional<double> intersect(const Vec3& o, const Vec3& d, double t_min,
                                  double t_max) const override;
  void surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const override;
  double area() const override;
  PositionSample sample_position(const Vec2& u) const override;
  Vec2 invert_position(const SurfacePoint& at) const override;
  /// Samples, from outside, uniformly in the cone of directions that hit the sphere.
  PositionSample sample_direct(const Vec3& from, const Vec2& u) const override;
  double pdf_direct(const Vec3& from, const SurfacePoint& at) const override;
  Vec2 invert_direct(const Vec3& from, const SurfacePoint& at) const override;
  UvTangents uv_tangents(const SurfacePoint& at) const override;
  void bounds(Vec3& low, Vec3& high) const override;

 private:
  std::optional<Roots> roots(const Vec3& o, const Vec3& d) const;

  struct Cone;
  /// The cone of directions from `from` that hit the sphere; nullopt from inside.
  std::optional<Cone> cone(const Vec3& from) const;
  /// pdf_direct() for `from`, whose cone this is.
  double pdf_in(const Cone& cone, const Vec3& from, const SurfacePoint& at) const;
  SurfacePoint point(const Vec3& outward) const;

  Vec3 center_;
  double radius_;
  Mat3 to_object_;  ///< Orthogonal: turns world directions into the sphere's own, for uv.
  double side_;     ///< 1 if the normals point outward, else -1.
};

/// Makes a sphere that its transform turns into an ellipsoid an instance of a sphere: `to_world` is
/// replaced by an animation without motion.
void place_ellipsoid(Params& params);

}  // namespace mlt
