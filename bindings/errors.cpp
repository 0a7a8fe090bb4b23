// The C++ exceptions as Python classes. Each is also the built-in error that a Python programmer
// would expect, so `except ValueError` catches a mistake in a scene.
#include "bindings.h"

#include "base/error.h"
#include "text.h"

#include <exception>

namespace mlt::python {
namespace {

template <class Exception>
py::object add_class(py::module_& m, const char* name, const char* doc, const py::handle& bases) {
  static PyObject* type = nullptr;
  py::object made = py::exception<Exception>(m, name, bases);
  type = made.inc_ref().ptr();
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const Exception& error) {
      PyErr_SetObject(type, to_str(error.what()).ptr());
    }
  });
  made.attr("__module__") = "pymlt";
  made.attr("__doc__") = doc;
  return made;
}

}  // namespace

void bind_errors(py::module_& m) {
  const py::object error =
      add_class<Error>(m, "Error", "The base of all errors that pymlt raises.", PyExc_Exception);
  const auto also = [&](PyObject* builtin) { return py::make_tuple(error, py::handle(builtin)); };
  add_class<SceneError>(m, "SceneError",
                        "A mistake in a scene, in a file that it names, or in a parameter.",
                        also(PyExc_ValueError));
  add_class<UsageError>(m, "UsageError", "A mistake in how a function or program was called.",
                        also(PyExc_ValueError));
  add_class<FileError>(m, "FileError", "A file that cannot be read or written.",
                       also(PyExc_OSError));
  add_class<RenderError>(m, "RenderError", "The render itself failed.", also(PyExc_RuntimeError));
}

}  // namespace mlt::python
