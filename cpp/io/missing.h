// Plug-ins, elements and parameters of a scene that this renderer does not have.
#pragma once

#include "base/registry.h"
#include "io/node.h"

namespace mlt {

/// Throws a SceneError that names every plug-in, element and parameter of the tree that is not
/// known here: the first one in full, then all others, each kind once.
void refuse_missing(const Node& tree, const Registry& registry);

}  // namespace mlt
