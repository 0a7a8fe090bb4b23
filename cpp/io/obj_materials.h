// Materials of Wavefront OBJ files, as Mitsuba 0.x reads them: a shape becomes one for each
// material that its file names (`usemtl`). A BSDF of that name inside of the shape is its material,
// else a BSDF without a name, else what the file's library (`mtllib`) says.
#pragma once

#include "io/node.h"

#include <functional>
#include <string>
#include <vector>

namespace mlt {

/// Appends the shapes of a node of type `obj` to `shapes`. `family_of` tells the family of a child,
/// or of what it refers to. A warning for a material or a library that is not there.
void split_by_material(Node& shape, std::vector<Node>& shapes, std::vector<std::string>& warnings,
                       const std::function<std::string(const Node&)>& family_of);

}  // namespace mlt
