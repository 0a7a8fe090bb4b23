// Scenes far from the origin, such as those in survey coordinates: single precision, in which rays
// are traced, is too coarse there. So the points below become the origins when a scene is built.
#pragma once

#include "base/params.h"
#include "io/node.h"
#include "scene/emitter/emitter.h"

#include <map>

namespace mlt {

struct Origins {
  Vec3 scene{0};                       ///< In the coordinates of the scene's description.
  std::map<const Node*, Vec3> groups;  ///< In those of each group that has another one than 0.

  bool any() const { return scene != Vec3(0) || !groups.empty(); }
};

/// The middle of the bounds if it is far from 0, as seen from their size; else 0.
Vec3 origin_of(const Bounds& bounds);

/// Changes the place that the parameters of an object give it (`to_world`, or `position`): `before`
/// is a point of the object's own space that becomes its origin, `after` one of the space around.
/// Objects that have directions alone, such as skies, stay as they are.
void move_place(Params& params, const Vec3& before, const Vec3& after);

}  // namespace mlt
