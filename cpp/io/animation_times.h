// When anything in a scene moves or changes.
#pragma once

#include "io/node.h"

#include <utility>
#include <vector>

namespace mlt {

/// The times of each two keys of an animation in the tree that follow each other and differ, of
/// transforms and of colours.
std::vector<std::pair<double, double>> animation_times(const Node& tree);

}  // namespace mlt
