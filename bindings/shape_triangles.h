#pragma once

#include "bindings.h"

#include <unordered_set>

namespace mlt::python {

/// The shapes of which only instances are in the scene.
std::unordered_set<const Shape*> shapes_in_groups(const Scene& scene);

/// The shapes of a scene as triangles, to be drawn: a list of dicts.
py::list shape_triangles(const LoadedScene& loaded);

}  // namespace mlt::python
