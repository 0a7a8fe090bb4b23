// Polygons of mesh files as triangles.
#pragma once

#include "scene/mesh/mesh_data.h"

namespace mlt {

/// A face of more than three corners, which lies in a mesh as triangles from its first corner.
struct Fan {
  size_t first;      ///< The first triangle.
  size_t triangles;  ///< How many there are.
};

/// Gives each polygon that its fan does not cover, as that of a concave one may not, as many other
/// triangles in the same places, which do; the others keep theirs. A polygon that crosses itself or
/// has no area still becomes triangles of its corners.
void triangulate(MeshData& mesh, const std::vector<Fan>& fans);

/// Adds a warning if `count`, of faces that no triangle can be made of, is not 0.
void warn_of_short_faces(MeshData& mesh, size_t count);

}  // namespace mlt
