// The media of a scene, and where they are: on the two sides of the surfaces that bound them.
#pragma once

#include "scene/medium/medium.h"
#include "scene/shape/shape.h"

#include <vector>

namespace mlt {

class Media {
 public:
  /// Finds the media at shapes, in the order of the shapes.
  void add(const std::vector<ShapePtr>& shapes);
  /// The place of a medium; it is added if it is new. Throws SceneError if there are too many.
  MediumIndex add(const MediumPtr& medium);

  bool empty() const { return all_.empty(); }
  size_t size() const { return all_.size(); }
  /// Whether any scatters light, and is not grey.
  bool any_coloured() const;
  const Medium& operator[](MediumIndex index) const { return *all_[index]; }

  bool is_boundary(uint32_t shape) const { return boundaries_[shape].exists; }
  /// The medium next to a point on a shape, on the side of w: of a boundary the one that its shape
  /// names, of other surfaces the one around them.
  MediumIndex beside(const SurfacePoint& at, const Vec3& w) const {
    const Boundary& boundary = boundaries_[at.shape];
    if (!boundary.exists) return at.medium;
    return dot(at.ng, w) > 0 ? boundary.exterior : boundary.interior;
  }

 private:
  struct Boundary {
    MediumIndex exterior = no_medium, interior = no_medium;
    bool exists = false;
  };

  std::vector<MediumPtr> all_;
  std::vector<Boundary> boundaries_;  ///< One for each shape.
};

}  // namespace mlt
