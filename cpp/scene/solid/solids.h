// Solids that overlap or touch, such as a glass and what is in it: where several are, the one of
// the highest priority is. Which one a point is in is a function of the point alone (how often a
// ray from it crosses each surface), not of the walk that has come there: so light walks, camera
// walks and all densities agree.
//
// A surface inside of a solid of higher priority is not there: light goes straight through it. Any
// other is the interface between its own solid and the highest of those around it.
#pragma once

#include "scene/accel/accel.h"

#include <memory>
#include <vector>

namespace mlt {

class Solids {
 public:
  Solids() = default;
  /// If any of the shapes has a priority, the solids are all that have one, and those of a
  /// dielectric that are closed, which have 0; unless their boxes are apart from all others. Of
  /// solids of one priority the smaller one wins. Their materials become those of SolidSurface.
  /// Throws SceneError for priorities of shapes that are not closed, or are `grouped`.
  Solids(const std::vector<ShapePtr>& shapes, const std::vector<ShapePtr>& grouped,
         const Shutter& shutter);

  bool empty() const { return all_.empty(); }
  /// The place of a shape among them, or no_solid.
  SolidIndex index(uint32_t shape) const { return empty() ? no_solid : of_shape_[shape]; }
  /// The shapes, from the highest priority to the lowest.
  std::vector<uint32_t> shapes() const;
  /// What is around a point on the surface of the solid `own`.
  SolidIndex around(const SurfacePoint& at, SolidIndex own) const;

 private:
  struct Solid {
    uint32_t shape;
    Vec3 low, high;
    std::unique_ptr<const Accel> surface;
  };
  bool contains(const Solid& solid, const Vec3& p, double time) const;

  std::vector<Solid> all_;
  std::vector<SolidIndex> of_shape_;
};

}  // namespace mlt
