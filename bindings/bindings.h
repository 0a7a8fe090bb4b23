// The Python extension pymlt._core: one small file per floor of the house, and no algorithm here.
#pragma once

#include "image/image.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace mlt::python {

namespace py = pybind11;

void bind_errors(py::module_& m);
void bind_base(py::module_& m);
void bind_image(py::module_& m);
void bind_scene(py::module_& m);
void bind_light_path(py::module_& m);
void bind_mutations(py::module_& m);
void bind_integrators(py::module_& m);
void bind_flags(py::module_& m);
void bind_render(py::module_& m);
void bind_checkpoint(py::module_& m);
void bind_executor(py::module_& m);
void bind_metropolis(py::module_& m);

/// A numpy array (height, width, channels) that owns the image's buffer.
py::array_t<float> to_array(Image image);

}  // namespace mlt::python
