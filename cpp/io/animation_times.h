// When the animations of a scene begin and end.
#pragma once

#include "io/node.h"

#include <utility>
#include <vector>

namespace mlt {

/// The times of the first and the last key of each animation in the tree, of transforms and of
/// colours.
std::vector<std::pair<double, double>> animation_times(const Node& tree);

}  // namespace mlt
