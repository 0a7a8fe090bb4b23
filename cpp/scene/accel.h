// The ray accelerator. accel.cpp is the only file that uses Embree.
#pragma once

#include "scene/ray.h"
#include "scene/shape.h"

#include <memory>
#include <vector>

namespace mlt {

class Accel {
 public:
  /// Builds the hierarchy; the result does not depend on `build_threads`.
  explicit Accel(const std::vector<ShapePtr>& shapes, const Shutter& shutter = {},
                 int build_threads = 1);
  ~Accel();

  bool intersect(const Ray& ray, Hit& hit) const;
  bool occluded(const Ray& ray) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mlt
