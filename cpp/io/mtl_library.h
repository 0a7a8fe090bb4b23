// The materials of a Wavefront MTL file (Alias|Wavefront, "Advanced Visualizer" manual), as BSDFs:
// those that Mitsuba 0.6 makes of them.
#pragma once

#include "io/node.h"

#include <map>
#include <string>
#include <vector>

namespace mlt {

/// BSDFs by the names of their materials. A warning for each texture that is not there.
std::map<std::string, Node> read_mtl_library(const std::string& path,
                                             std::vector<std::string>& warnings);

}  // namespace mlt
