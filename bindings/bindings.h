// The Python extension pymlt._core: one small file for each group of functions, without algorithms.
#pragma once

#include "gil.h"

#include "image/image.h"
#include "io/load.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>

namespace mlt::python {

namespace py = pybind11;

using LoadedPtr = std::shared_ptr<LoadedScene>;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using NoGil = py::call_guard<ReleasedGil>;

void bind_errors(py::module_& m);
void bind_base(py::module_& m);
void bind_image(py::module_& m);
void bind_scene(py::module_& m);
void bind_light_path(py::module_& m);
void bind_mutations(py::module_& m);
void bind_integrators(py::module_& m);
void bind_render(py::module_& m);
void bind_checkpoint(py::module_& m);
void bind_executor(py::module_& m);
void bind_lab(py::module_& m);
void bind_path_target(py::module_& m);

/// A numpy array (height, width, channels) that owns the image's buffer.
py::array_t<float> to_array(Image image);

/// Calls `function` without the interpreter's lock, and returns its result.
template <class Function>
auto without_gil(const Function& function) {
  const ReleasedGil release;
  return function();
}

/// Python objects that may be dropped without the interpreter's lock.
template <class Objects>
std::shared_ptr<Objects> hold(Objects objects) {
  return {new Objects(std::move(objects)), [](const Objects* held) {
            const AcquiredGil gil;
            delete held;
          }};
}

}  // namespace mlt::python
