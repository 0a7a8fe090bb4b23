#pragma once

#include "scene/emitter.h"

#include <string>
#include <vector>

namespace mlt {

/// A warning for each glowing shape that lies where another one does: which of them a ray meets is
/// left to rounding, so that methods which choose a light and methods which hit one see different
/// images.
std::vector<std::string> warnings_of_coincident_lights(const std::vector<EmitterPtr>& emitters);

}  // namespace mlt
