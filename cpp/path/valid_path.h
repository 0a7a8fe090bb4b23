// A test of paths from a file, whose indices may be out of bounds.
#pragma once

#include "path/path.h"

namespace mlt {

/// Whether a path leads from a light over surfaces to the camera, all of which exist in the scene.
/// The positions of the vertices are not checked.
bool is_valid_path(const Scene& scene, const Path& path);

}  // namespace mlt
