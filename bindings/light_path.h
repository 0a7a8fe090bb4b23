// A light path as a Python object.
#pragma once

#include "bindings.h"

#include "mutation/path_state.h"
#include "path/inspect.h"

#include <optional>

namespace mlt::python {

struct PyLightPath {
  LoadedPtr scene;
  Path path;
  Vec2 raster{0};
  bool strict_normals = false;
  std::optional<std::pair<int, int>> technique;
  std::optional<Color> estimate;
  std::optional<double> acceptance;
};

PyLightPath light_path(LoadedPtr scene, FoundPath found, bool strict_normals = false);
PyLightPath light_path(LoadedPtr scene, const PathState& x, bool strict_normals);

py::array_t<double> to_array(const Color& color);

/// A vertex of a scene whose description has its origin of coordinates at `origin`.
struct PyVertex : Vertex {
  PyVertex(const Vertex& x, const LoadedScene& scene) : Vertex(x), origin(scene.scene->origin()) {}
  Vec3 origin;

  /// The position in the coordinates of the description; at infinity, the direction towards it.
  Vec3 position() const { return at.infinite() ? at.p : at.p + origin; }
};

/// "light", "surface", "medium" or "camera".
const char* kind_of(const Vertex& x);
const char* name_of(Lobe lobe);
/// Index of the shape that a vertex is on; -1: none.
int64_t shape_of(const Vertex& x);

/// `Vertex`, and the methods of `Scene` that find vertices.
void bind_vertex(py::module_& m);

}  // namespace mlt::python
