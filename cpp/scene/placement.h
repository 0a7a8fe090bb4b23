// What a hierarchy of the accelerator is built from: forms and where they are, without materials
// and lights. Scenes in which these are the same share one.
#pragma once

#include "scene/shape.h"

#include <memory>
#include <vector>

namespace mlt {

/// A shape without material and light, of which the scene's shapes are copies.
using FormPtr = std::shared_ptr<const Shape>;

/// A form in the world, or a group of them that is there by way of an instance.
struct Placement {
  FormPtr form;             ///< nullptr of an instance,
  size_t group = 0;         ///< which is one of this group
  std::vector<Mat4> steps;  ///< under these transforms.

  bool operator==(const Placement& other) const {
    return form == other.form && group == other.group && steps == other.steps;
  }
};

struct Placements {
  std::vector<Placement> all;                ///< One for each shape of the scene.
  std::vector<std::vector<FormPtr>> groups;  ///< In the order in which they are met.

  Placements() = default;
  explicit Placements(const std::vector<ShapePtr>& shapes);

  bool moves() const;
  bool operator==(const Placements& other) const {
    return all == other.all && groups == other.groups;
  }
};

}  // namespace mlt
