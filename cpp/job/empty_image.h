#pragma once

#include "scene/scene.h"

#include <string>

namespace mlt {

/// What rays from the lens say about an image without light: nothing is in view, the lens is inside
/// a shape, or no light was found.
std::string cause_of_darkness(const Scene& scene);

}  // namespace mlt
