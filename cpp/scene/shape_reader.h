// What a texture or a material asks of the shape itself that it lies on, beyond a SurfacePoint. The
// shapes are known when the whole scene has been made.
#pragma once

#include "scene/shape.h"

#include <vector>

namespace mlt {

class ShapeReader {
 public:
  virtual ~ShapeReader() = default;

  /// Those of the scene, which outlive this.
  virtual void read_shapes(const std::vector<ShapePtr>& shapes) { shapes_ = &shapes; }

 protected:
  /// nullptr for a point outside of any scene.
  const Shape* shape_of(const SurfacePoint& at) const {
    return shapes_ && at.shape < shapes_->size() ? (*shapes_)[at.shape].get() : nullptr;
  }

 private:
  const std::vector<ShapePtr>* shapes_ = nullptr;
};

}  // namespace mlt
