#include "bindings.h"

#include "mlt_version.h"

PYBIND11_MODULE(_core, m) {
  using namespace mlt::python;
  m.doc() = "The C++ side of pymlt; use it through the package.";
  m.attr("__version__") = MLT_VERSION;
  for (const auto bind : {bind_errors, bind_base, bind_image, bind_scene, bind_light_path,
                          bind_mutations, bind_integrators, bind_render, bind_checkpoint,
                          bind_executor, bind_metropolis, bind_path_target})
    bind(m);
}
