#pragma once

#include "bindings.h"

namespace mlt::python {

/// The shapes of a scene as triangles, to be drawn: a list of dicts.
py::list shape_triangles(const LoadedScene& loaded);

}  // namespace mlt::python
