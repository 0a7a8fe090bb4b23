#include "bindings.h"

#include "mlt_version.h"

PYBIND11_MODULE(_core, m) {
  m.doc() = "The C++ side of pymlt; use it through the package.";
  m.attr("__version__") = MLT_VERSION;
  mlt::python::bind_errors(m);
  mlt::python::bind_base(m);
  mlt::python::bind_image(m);
  mlt::python::bind_scene(m);
  mlt::python::bind_light_path(m);
  mlt::python::bind_mutations(m);
  mlt::python::bind_integrators(m);
  mlt::python::bind_flags(m);
  mlt::python::bind_render(m);
  mlt::python::bind_checkpoint(m);
  mlt::python::bind_executor(m);
  mlt::python::bind_metropolis(m);
}
