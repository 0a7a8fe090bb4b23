// Copies of shapes: a group is held once, in a space of its own, and each instance of it is one
// transform, or a motion. Rays are moved into the group's space, and the points that they hit back.
// A shape that moves is an instance too, of a group of its own.
#pragma once

#include "scene/shape/shape.h"
#include "scene/transform/motion.h"

#include <vector>

namespace mlt {

class Params;

/// Shapes in a space of their own. They are in the scene only by way of instances.
class ShapeGroup : public Object {
 public:
  /// A group of shapes. Throws SceneError if there are none, or if one emits or is an instance.
  explicit ShapeGroup(Params& params);
  /// A group of one shape, which may emit.
  explicit ShapeGroup(const ShapePtr& shape) { add(shape); }

  const std::vector<ShapePtr>& shapes() const { return shapes_; }
  /// Axis-aligned bounding box, in the group's space.
  const Vec3& low() const { return low_; }
  const Vec3& high() const { return high_; }

 private:
  void add(const ShapePtr& shape);

  std::vector<ShapePtr> shapes_;
  Vec3 low_{infinity}, high_{-infinity};
};

using ShapeGroupPtr = std::shared_ptr<const ShapeGroup>;

/// A map from a group's space to the world, and its inverse.
struct AffineMap {
  Mat3 linear, inverse;
  Vec3 offset;

  explicit AffineMap(const Mat4& to_world)
      : linear(to_world), inverse(glm::inverse(linear)), offset(to_world[3]) {}

  Vec3 point(const Vec3& p) const { return linear * p + offset; }
  Vec3 point_back(const Vec3& p) const { return inverse * (p - offset); }
  /// Bounds of the factors by which lengths grow.
  double least_scale() const { return 1 / largest(inverse); }
  double greatest_scale() const { return largest(linear); }

 private:
  static double largest(const Mat3& m) { return length(m[0]) + length(m[1]) + length(m[2]); }
};

class Instance final : public Shape {
 public:
  /// Throws SceneError unless there is one group, and `to_world` is affine and not singular.
  explicit Instance(Params& params);
  /// An instance of a moving shape.
  Instance(const ShapePtr& shape, const Motion& motion);

  const ShapeGroup& group() const { return *group_; }
  const Motion& motion() const { return motion_; }
  AffineMap map_at(double time) const {
    return motion_.moves() ? AffineMap(motion_.at(time)) : at_rest_;
  }
  /// Transforms a point of surface_point back to the group's space: all members that
  /// Shape::uv_tangents and the densities and inverses of samples use.
  SurfacePoint in_group(SurfacePoint at) const;
  /// Transforms a point of a shape of the group to the world at this time.
  void move_to_world(const Shape& shape, double time, SurfacePoint& at) const {
    place(map_at(time), shape, time, at);
  }

  /// `at.shape` becomes the shape of the group that was hit, which has the material, and
  /// `at.instance` this.
  void surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const override;
  void bounds(Vec3& low, Vec3& high) const override;
  const Instance* as_instance() const override { return this; }

  // An instance does not emit, so no position on it is ever sampled.
  double area() const override { return 0; }
  PositionSample sample_position(const Vec2&) const override { return {{}, 0}; }
  Vec2 invert_position(const SurfacePoint&) const override { return Vec2(0.5); }

 private:
  Instance(ShapeGroupPtr group, const Motion& motion);

  void surface_point(const AffineMap& map, const Ray& ray, const Hit& hit, SurfacePoint& at) const;
  void place(const AffineMap& map, const Shape& shape, double time, SurfacePoint& at) const;
  double rounding_scale() const;

  ShapeGroupPtr group_;
  Motion motion_;
  AffineMap at_rest_;  ///< The map when the shutter opens.
  bool keeps_angles_;
  double extent_;
};

}  // namespace mlt
