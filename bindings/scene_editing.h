// The parameters of a scene that can be changed, and the scene with other values.
#pragma once

#include "bindings.h"

namespace mlt::python {

/// Names and current values.
py::dict scene_parameters(const LoadedScene& loaded);

/// The names and values of one plug-in, and of what is nested in it, without its own name.
py::dict parameters_of(const LoadedScene& loaded, const std::string& part);

/// Throws UsageError for a name that the scene does not have, SceneError for a value.
LoadedScene updated_scene(const LoadedScene& loaded, const py::dict& values);

/// The scene seen by a sensor that is not in it. Throws SceneError for one that is wrong.
LoadedScene seen_by(const LoadedScene& loaded, const py::dict& sensor);

}  // namespace mlt::python
