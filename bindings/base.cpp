// What plug-ins there are, and their schemas as dicts.
#include "bindings.h"
#include "scene_dict.h"

#include "render/plugins.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

py::dict to_dict(const Parameter& parameter) {
  py::dict dict;
  dict["name"] = parameter.name;
  dict["type"] = to_string(parameter.type);
  dict["default"] = to_python(parameter.default_value);
  dict["doc"] = parameter.doc;
  dict["choices"] = parameter.choices;
  return dict;
}

}  // namespace

py::dict to_dict(const Schema& schema) {
  py::list parameters;
  for (const Parameter& parameter : schema.parameters) parameters.append(to_dict(parameter));
  py::dict dict;
  dict["family"] = schema.family;
  dict["name"] = schema.name;
  dict["doc"] = schema.doc;
  dict["parameters"] = parameters;
  dict["ignored"] = schema.ignored;
  return dict;
}

void bind_base(py::module_& m) {
  m.def("families", [] { return plugins().families(); });
  m.def(
      "names", [](const std::string& family) { return plugins().names(family); },
      py::arg("family"));
  m.def(
      "schema",
      [](const std::string& family, const std::string& name) {
        return to_dict(plugins().find(family, name, {}).schema);
      },
      py::arg("family"), py::arg("name"));
  m.def("suggestion", &suggestion, py::arg("word"), py::arg("candidates"),
        "\"; did you mean 'b'?\", or a list of what is valid.");
}

}  // namespace mlt::python
