#include "bindings.h"

#include "mlt_version.h"

namespace mlt::python {
namespace {

/// pybind11 makes the value of an object without one when it is first used, from uninitialised
/// memory: such objects come from `cls.__new__(cls)`.
void* refuse_empty_object(size_t) {
  throw py::type_error("the object is empty: it was made by __new__ alone, without __init__");
}

void refuse_empty_objects(const py::module_& m) {
  for (const auto& named : m.attr("__dict__").cast<py::dict>())
    if (py::isinstance<py::type>(named.second))
      if (auto* info =
              py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(named.second.ptr())))
        info->operator_new = refuse_empty_object;
}

}  // namespace
}  // namespace mlt::python

PYBIND11_MODULE(_core, m) {
  using namespace mlt::python;
  m.doc() = "The C++ side of pymlt; use it through the package.";
  m.attr("__version__") = MLT_VERSION;
  for (const auto bind :
       {bind_errors, bind_base, bind_image, bind_scene, bind_light_path, bind_mutations,
        bind_integrators, bind_render, bind_checkpoint, bind_executor, bind_lab, bind_path_target})
    bind(m);
  refuse_empty_objects(m);
}
