// The media of a scene, and where they are: on the two sides of the surfaces that bound them.
#pragma once

#include "scene/medium/medium.h"
#include "scene/shape/shape.h"

#include <vector>

namespace mlt {

class Media {
 public:
  /// Finds the media at shapes, in the order of the shapes; these of them are `solids`.
  void add(const std::vector<ShapePtr>& shapes, const std::vector<uint32_t>& solids);
  /// The place of a medium; it is added if it is new. Throws SceneError if there are too many.
  MediumIndex add(const MediumPtr& medium);

  bool empty() const { return all_.empty(); }
  size_t size() const { return all_.size(); }
  /// Whether walks stop in any that is not grey.
  bool any_coloured() const;
  const Medium& operator[](MediumIndex index) const { return *all_[index]; }

  bool is_boundary(uint32_t shape) const { return boundaries_[shape].exists; }
  bool is_boundary(const SurfacePoint& at) const {
    return is_boundary(at.shape) && at.around != hidden_surface;
  }
  /// The medium next to a point on a shape, on the side of w: of a boundary the one that its shape
  /// names, of a solid that of the one around it, of other surfaces the one around them.
  MediumIndex beside(const SurfacePoint& at, const Vec3& w) const {
    const Boundary& boundary = boundaries_[at.shape];
    if (!boundary.exists || at.around == hidden_surface) return at.medium;
    if (!(dot(at.ng, w) > 0)) return boundary.interior;
    return at.around == no_solid ? boundary.exterior : boundaries_[solids_[at.around]].interior;
  }

 private:
  struct Boundary {
    MediumIndex exterior = no_medium, interior = no_medium;
    bool exists = false;
  };

  std::vector<MediumPtr> all_;
  std::vector<Boundary> boundaries_;  ///< One for each shape.
  std::vector<uint32_t> solids_;      ///< The shape of each solid.
};

}  // namespace mlt
