// The table of command-line flags.
#include "bindings.h"

#include "app/flags.h"

#include <pybind11/stl.h>

namespace mlt::python {

void bind_flags(py::module_& m) {
  py::class_<Flag>(m, "Flag", "A flag of `pymlt render` and mlt-render.")
      .def_readonly("name", &Flag::name)
      .def_readonly("spelling", &Flag::spelling, "Such as -o,--output; or a name without a dash.")
      .def_readonly("metavar", &Flag::metavar)
      .def_readonly("help", &Flag::help)
      .def_property_readonly("has_value", [](const Flag& flag) { return flag.type != nullptr; })
      .def_property_readonly("required", [](const Flag& flag) { return flag.is(Flag::required); })
      .def_property_readonly("repeatable",
                             [](const Flag& flag) { return flag.is(Flag::repeatable); })
      .def("read", &read_flag, py::arg("text"), "What a text means as its value.");
  m.def("render_flags", &render_flags, "In the order of --help.");
  m.def("check_flags", &check_flags, py::arg("given"),
        "Raises UsageError if the flags with these names make no sense together.");
}

}  // namespace mlt::python
