// The stretches of a leg that lie in media.
#pragma once

#include "scene/medium/medium.h"

#include <optional>

namespace mlt {

/// The first stretch of a leg through a medium where light is scattered.
struct Stretch {
  Ray ray;                     ///< Distances count from its start.
  double length = 0;           ///< May be infinite; 0: there is no such stretch.
  Passage before;              ///< What the leg has passed up to there.
  std::optional<double> stop;  ///< The distance at which the walk stops in it.
};

/// Flies along the ray of a walk as `fly` of medium.h does, and finds that stretch.
inline std::optional<double> fly(const Medium& medium, const Ray& ray, double distance,
                                 double& u_leg, Passage& passed, Stretch& first) {
  const bool is_first = !(first.length > 0) && medium.scatters();
  if (is_first) first = {ray, distance, passed, {}};
  const auto stop = fly(medium, ray, distance, u_leg, passed);
  if (is_first) first.stop = stop;
  return stop;
}

}  // namespace mlt
