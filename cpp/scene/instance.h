// Copies of shapes: a group is held once, in a space of its own, and each instance of it is one
// transform. Rays are moved into the group's space, and the points that they hit back.
#pragma once

#include "scene/shape.h"

#include <vector>

namespace mlt {

class Params;

/// Shapes in a space of their own. They are in the scene only by way of instances.
class ShapeGroup : public Object {
 public:
  /// Throws SceneError if there are none, or if one emits or is an instance.
  explicit ShapeGroup(Params& params);

  const std::vector<ShapePtr>& shapes() const { return shapes_; }
  /// Axis-aligned bounding box, in the group's space.
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }

 private:
  std::vector<ShapePtr> shapes_;
  Vec3 low_{infinity}, high_{-infinity};
};

using ShapeGroupPtr = std::shared_ptr<const ShapeGroup>;

class Instance final : public Shape {
 public:
  /// Throws SceneError if there is not one group, or if `to_world` is singular or not affine.
  explicit Instance(Params& params);

  const ShapeGroup& group() const { return *group_; }
  const Mat4& to_world() const { return to_world_; }
  const Mat3& linear() const { return linear_; }
  /// A point that surface_point has found, back in the group's space, as far as Shape::uv_tangents
  /// and Mesh::barycentrics look at it.
  SurfacePoint in_group(SurfacePoint at) const;

  /// `at.shape` becomes the shape of the group that was hit, which has the material, and
  /// `at.instance` this.
  void surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const override;
  void bounds(Vec3& low, Vec3& high) const override;
  const Instance* as_instance() const override { return this; }

  // It emits nothing, so no position on it is ever sampled.
  double area() const override { return 0; }
  PositionSample sample_position(const Vec2&) const override { return {{}, 0}; }
  Vec2 invert_position(const SurfacePoint&) const override { return Vec2(0.5); }

 private:
  void move_to_world(const Shape& shape, SurfacePoint& at) const;
  double rounding_scale() const;

  ShapeGroupPtr group_;
  Mat4 to_world_;
  Mat3 linear_, inverse_;  ///< Of to_world, without its translation.
  Vec3 offset_;            ///< Its translation.
  bool keeps_angles_;
  double extent_;
};

}  // namespace mlt
