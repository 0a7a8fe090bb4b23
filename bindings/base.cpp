// The list of plug-ins, their schemas as dicts, and the table of command-line flags.
#include "bindings.h"
#include "scene_dict.h"
#include "text.h"

#include "app/flags.h"
#include "job/plugins.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

py::dict parameter_dict(const Parameter& parameter) {
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
  for (const Parameter& parameter : schema.parameters) parameters.append(parameter_dict(parameter));
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
  m.def(
      "suggestion",
      [](const Text& word, const std::vector<std::string>& candidates) {
        return to_str(suggestion(word, candidates));
      },
      py::arg("word"), py::arg("candidates"),
      "\"; did you mean 'b'?\", or a list of what is valid.");

  py::class_<Flag>(m, "Flag", "A flag of `pymlt render` and mlt-render.")
      .def_readonly("name", &Flag::name)
      .def_readonly("spelling", &Flag::spelling, "Such as -o,--output; or a name without a dash.")
      .def_readonly("metavar", &Flag::metavar)
      .def_readonly("help", &Flag::help)
      .def_property_readonly("has_value", [](const Flag& flag) { return flag.type != nullptr; })
      .def_property_readonly("required", [](const Flag& flag) { return flag.is(Flag::required); })
      .def_property_readonly("is_file", [](const Flag& flag) { return flag.is(Flag::file); })
      .def_property_readonly("repeatable",
                             [](const Flag& flag) { return flag.is(Flag::repeatable); })
      .def(
          "read",
          [](const Flag& flag, const Text& text) -> py::object {
            const FlagValue value = read_flag(flag, text);
            if (const auto* read = std::get_if<std::string>(&value)) return to_str(*read);
            return py::cast(value);
          },
          py::arg("text"), "What a text means as its value.");
  m.def("render_flags", &render_flags, "In the order of --help.");
  m.def(
      "check_files",
      [](const std::map<std::string, std::vector<Text>>& given) {
        std::map<std::string, std::vector<std::string>> files;
        for (const auto& [flag, texts] : given) files[flag].assign(texts.begin(), texts.end());
        check_files(files);
      },
      py::arg("given"), "Raises UsageError if two flags name one file.");
  m.def("check_flags", &check_flags, py::arg("given"),
        "Raises UsageError if the flags with these names make no sense together.");
}

}  // namespace mlt::python
