// A test of paths from a file: a wrong index would be followed out of an array.
#pragma once

#include "path/path.h"

namespace mlt {

/// Whether it leads from a light over surfaces to the camera, all of which the scene has. Where the
/// vertices lie is not looked at.
bool possible(const Scene& scene, const Path& path);

}  // namespace mlt
