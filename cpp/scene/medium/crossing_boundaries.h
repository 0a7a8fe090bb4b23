#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace mlt {

/// A warning, with a count, if boundaries of media cross or touch each other: along rays through
/// them, the medium behind one surface should be the medium before the next.
std::vector<std::string> warnings_of_crossing_boundaries(const Scene& scene);

}  // namespace mlt
