#pragma once

#include "scene/emitter.h"

#include <string>
#include <vector>

namespace mlt {

/// A warning for each emissive shape that coincides with another one: which of them a ray hits
/// depends on rounding, so that next-event estimation and walks that hit a light have different
/// images.
std::vector<std::string> warnings_of_coincident_lights(const std::vector<EmitterPtr>& emitters);

}  // namespace mlt
