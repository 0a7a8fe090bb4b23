#pragma once

#include "bindings.h"

namespace mlt::python {

void bind_scene_parts(py::class_<LoadedScene, LoadedPtr>& scene);

}  // namespace mlt::python
