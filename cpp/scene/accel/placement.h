// The input of a hierarchy of the accelerator: forms and their transforms, without lights and,
// but for what light passes, without materials. Scenes in which these are equal share a hierarchy.
#pragma once

#include "scene/shape/shape.h"

#include <memory>
#include <vector>

namespace mlt {

/// A shape without material and light, of which the scene's shapes are copies.
using FormPtr = std::shared_ptr<const Shape>;

/// A form, and whether light goes straight through its surface.
struct PlacedForm {
  FormPtr shape;
  bool has_passage = false;

  bool operator==(const PlacedForm& other) const {
    return shape == other.shape && has_passage == other.has_passage;
  }
};

/// A form in the world, or an instance of a group of forms.
struct Placement {
  PlacedForm form;          ///< Form of a shape; without one of an instance.
  size_t group = 0;         ///< Group of an instance.
  std::vector<Mat4> steps;  ///< Transforms of an instance.

  bool operator==(const Placement& other) const {
    return form == other.form && group == other.group && steps == other.steps;
  }
};

struct Placements {
  std::vector<Placement> all;                   ///< One for each shape of the scene.
  std::vector<std::vector<PlacedForm>> groups;  ///< In the order of their first instances.

  Placements() = default;
  explicit Placements(const std::vector<ShapePtr>& shapes);

  bool moves() const;
  bool operator==(const Placements& other) const {
    return all == other.all && groups == other.groups;
  }
};

}  // namespace mlt
