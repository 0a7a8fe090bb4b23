// Values and trees between Python and C++: a parameter's value, and the Mitsuba dict.
#pragma once

#include "bindings.h"

#include "base/registry.h"
#include "io/node.h"

#include <string>

namespace mlt::python {

py::object to_python(const Value& value);
/// A number, string, boolean or array as the value of a parameter. Throws SceneError for others.
Value to_value(const py::object& object, const std::string& parameter, const Location& where);
/// Family, name, doc, parameters (name, type, default, doc, choices) and ignored names.
py::dict to_dict(const Schema& schema);

/// The tree of a nested dict. `path` is the caller's name of the dict, such as "scene", with which
/// errors name its parts ("scene['sensor']['film']").
Node to_node(const py::dict& dict, const std::string& family, const std::string& path,
             const Registry& registry);

}  // namespace mlt::python
