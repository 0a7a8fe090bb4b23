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

void not_a_number(const py::object& returned, const char* what, const std::string& x) {
  PyErr_Clear();
  throw UsageError(std::string(what) + " must be a number, but is " + text_of(returned) + " at " +
                   x);
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
    const Doubles array = Doubles::ensure(object);
    if (!array || array.ndim() != 1 || static_cast<size_t>(array.size()) != dimensions)
      not_a_state(object, "an array of " + std::to_string(dimensions) + " numbers");
    x.assign(array.data(), array.data() + dimensions);
  } else {
    const bool real = form == Form::number;
    x.assign(1, real ? PyFloat_AsDouble(object.ptr())
                     : static_cast<double>(PyNumber_AsSsize_t(object.ptr(), nullptr)));
    if (x[0] == -1 && PyErr_Occurred()) not_a_state(object, real ? "a number" : "an integer");
  }
  for (const double coordinate : x)
    if (!std::isfinite(coordinate)) not_a_state(object, "finite");
}

}  // namespace mlt::python
