// The base of textures and materials that read the shape that they lie on, beyond a SurfacePoint.
// The shapes are known when the whole scene has been made.
#pragma once

#include "scene/accel/instance.h"
#include "scene/mesh/mesh.h"

#include <vector>

namespace mlt {

class ShapeReader {
 public:
  virtual ~ShapeReader() = default;

  /// Sets the shapes of the scene, which outlive this.
  virtual void read_shapes(const std::vector<ShapePtr>& shapes) { shapes_ = &shapes; }

 protected:
  /// Derivatives of the position by the texture coordinates; the frame's axes outside of any scene.
  Shape::UvTangents uv_tangents(const SurfacePoint& at) const {
    const Shape* shape = find(at.shape);
    if (!shape) return {at.shading.s, at.shading.t};
    const Instance* instance = instance_of(at);
    if (!instance) return shape->uv_tangents(at);
    const auto [du, dv] = shape->uv_tangents(instance->in_group(at));
    const Mat3 linear = instance->map_at(at.time).linear;
    return {linear * du, linear * dv};
  }
  /// Barycentrics of the corners of a mesh after the first one.
  Vec2 barycentrics(const Mesh& mesh, const SurfacePoint& at) const {
    const Instance* instance = instance_of(at);
    return mesh.barycentrics(instance ? instance->in_group(at) : at);
  }

 private:
  const Shape* find(uint32_t index) const {
    return shapes_ && index < shapes_->size() ? (*shapes_)[index].get() : nullptr;
  }
  const Instance* instance_of(const SurfacePoint& at) const {
    const Shape* shape = find(at.instance);
    return shape ? shape->as_instance() : nullptr;
  }

  const std::vector<ShapePtr>* shapes_ = nullptr;
};

}  // namespace mlt
