// The C++ exceptions as Python classes. Each is also the built-in error that a Python programmer
// would expect, so `except ValueError` catches a mistake in a scene.
#include "bindings.h"

#include "base/error.h"

namespace mlt::python {
namespace {

struct ErrorClasses {
  py::object error, scene, usage, file, render;
};

PYBIND11_CONSTINIT py::gil_safe_call_once_and_store<ErrorClasses> storage;

py::object make_class(py::module_& m, const char* name, const char* doc, const py::tuple& bases) {
  const std::string full_name = std::string("pymlt.") + name;
  PyObject* made = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, bases.ptr(), nullptr);
  if (!made) throw py::error_already_set();
  auto object = py::reinterpret_steal<py::object>(made);
  m.attr(name) = object;
  return object;
}

void translate(std::exception_ptr pointer) {
  const ErrorClasses& classes = storage.get_stored();
  const auto raise = [](const py::object& type, const std::exception& error) {
    PyErr_SetObject(type.ptr(), py::str(error.what()).ptr());
  };
  try {
    if (pointer) std::rethrow_exception(pointer);
  } catch (const SceneError& error) {
    raise(classes.scene, error);
  } catch (const UsageError& error) {
    raise(classes.usage, error);
  } catch (const FileError& error) {
    raise(classes.file, error);
  } catch (const RenderError& error) {
    raise(classes.render, error);
  } catch (const Error& error) {
    raise(classes.error, error);
  }
}

}  // namespace

void bind_errors(py::module_& m) {
  storage.call_once_and_store_result([&m] {
    const auto builtin = [](PyObject* type) { return py::reinterpret_borrow<py::object>(type); };
    ErrorClasses made;
    made.error = make_class(m, "Error", "The base of all errors that pymlt raises.",
                            py::make_tuple(builtin(PyExc_Exception)));
    made.scene = make_class(m, "SceneError",
                            "A mistake in a scene, in a file that it names, or in a parameter.",
                            py::make_tuple(made.error, builtin(PyExc_ValueError)));
    made.usage = make_class(m, "UsageError", "A mistake in how a function or program was called.",
                            py::make_tuple(made.error, builtin(PyExc_ValueError)));
    made.file = make_class(m, "FileError", "A file that cannot be read or written.",
                           py::make_tuple(made.error, builtin(PyExc_OSError)));
    made.render = make_class(m, "RenderError", "The render itself failed.",
                             py::make_tuple(made.error, builtin(PyExc_RuntimeError)));
    return made;
  });
  py::register_exception_translator(&translate);
}

}  // namespace mlt::python
