#include "metropolis_python.h"

#include "base/error.h"

namespace mlt::python {
namespace {

std::string text_of(const py::object& object) {
  const std::string text = py::repr(object);
  return text.size() > 80 ? text.substr(0, 77) + "..." : text;
}

[[noreturn]] void not_a_state(const py::object& object, const std::string& wanted) {
  PyErr_Clear();
  throw UsageError("a move proposed " + text_of(object) + "; as x0 is one, it must be " + wanted);
}

}  // namespace

std::string describe(const Object& x) { return "x = " + text_of(x.value); }

double to_number(const py::object& returned, const std::string& what, const std::string& x) {
  const double value = PyFloat_AsDouble(returned.ptr());
  if (value != -1 || !PyErr_Occurred()) return value;
  PyErr_Clear();
  throw UsageError(what + " must be a number, but is " + text_of(returned) + " at " + x);
}

py::object Numbers::to_python(const lab::Point& x) const {
  switch (form) {
    case Form::number: return py::float_(x[0]);
    case Form::integer: return py::int_(static_cast<int64_t>(x[0]));
    default: return py::array_t<double>(static_cast<py::ssize_t>(x.size()), x.data());
  }
}

void Numbers::from_python(const py::object& object, lab::Point& x) const {
  if (form == Form::array) {
    const auto array =
        py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(object);
    if (!array || array.ndim() != 1 || static_cast<size_t>(array.size()) != dimensions)
      not_a_state(object, "an array of " + std::to_string(dimensions) + " numbers");
    x.assign(array.data(), array.data() + dimensions);
  } else {
    double value;
    if (form == Form::number) {
      value = PyFloat_AsDouble(object.ptr());
    } else {
      value = static_cast<double>(PyNumber_AsSsize_t(object.ptr(), nullptr));
    }
    if (value == -1 && PyErr_Occurred())
      not_a_state(object, form == Form::number ? "a number" : "an integer");
    x.assign(1, value);
  }
  for (const double coordinate : x)
    if (!std::isfinite(coordinate)) not_a_state(object, "finite");
}

}  // namespace mlt::python
