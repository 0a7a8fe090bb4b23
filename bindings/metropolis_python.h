// Targets and moves that are written in Python, on states that are numbers or any Python object.
#pragma once

#include "bindings.h"
#include "random_generator.h"

#include "lab/lab.h"

#include <string>

namespace mlt::python {

/// A Python object as a state.
struct Object {
  py::object value;
};
std::string describe(const Object& x);
inline std::string describe(const char* x) { return x; }
using lab::describe;

[[noreturn]] void not_a_number(const py::object& returned, const char* what, const std::string& x);

/// A number that a Python function has returned at x; `what` is for the message.
template <class X>
double to_number(const py::object& returned, const char* what, const X& x) {
  const double value = PyFloat_AsDouble(returned.ptr());
  if (value == -1 && PyErr_Occurred()) not_a_number(returned, what, describe(x));
  return value;
}

/// States of numbers: one, one that is an integer, or an array.
struct Numbers {
  using State = lab::Point;
  enum class Form { number, integer, array };

  Form form;
  size_t dimensions;

  py::object to_python(const lab::Point& x) const;
  void from_python(const py::object& object, lab::Point& x) const;
};

/// States that are Python objects of any kind.
struct Objects {
  using State = Object;

  py::object to_python(const Object& x) const { return x.value; }
  void from_python(const py::object& object, Object& x) const { x.value = object; }
};

template <class Space>
class PythonTarget final : public lab::Target<typename Space::State> {
 public:
  using X = typename Space::State;
  PythonTarget(const Space& space, py::object function)
      : space_(space), function_(std::move(function)) {}

  double operator()(const X& x) const override {
    return to_number(function_(space_.to_python(x)), "the target", x);
  }

 private:
  Space space_;
  py::object function_;
};

/// An object with propose(x, rng) and, depending on its attributes `symmetric`, `_suits_all` and
/// `_adapts`, with density(x, y), suitability(x), adapt(acceptance).
template <class Space>
class PythonMove final : public lab::Move<typename Space::State> {
 public:
  using X = typename Space::State;
  PythonMove(const Space& space, py::object object, std::shared_ptr<RandomGenerators> generators)
      : space_(space),
        object_(std::move(object)),
        propose_(object_.attr("propose")),
        symmetric_(truth("symmetric")),
        suits_all_(truth("_suits_all")),
        adapts_(truth("_adapts")),
        generators_(std::move(generators)) {
    if (!symmetric_) density_ = object_.attr("density");
  }

  std::shared_ptr<lab::Move<X>> clone() const override {
    py::object own = object_;
    if (adapts_) own = py::module_::import("copy").attr("deepcopy")(object_);
    return std::make_shared<PythonMove>(space_, own, generators_);
  }

  double suitability(const X& x) const override {
    if (suits_all_) return 1;
    return to_number(object_.attr("suitability")(space_.to_python(x)), "suitability(x)", x);
  }

  bool propose(const X& x, X& y, Rng& rng) override {
    const RandomGenerators::Use generator(*generators_, rng);
    const py::object proposed = propose_(space_.to_python(x), *generator);
    if (proposed.is_none()) return false;
    space_.from_python(proposed, y);
    return true;
  }

  double density(const X& x, const X& y) const override {
    if (symmetric_) return 1;
    return to_number(density_(space_.to_python(x), space_.to_python(y)), "density(x, y)", x);
  }

  void adapt(double acceptance) override {
    if (adapts_) object_.attr("adapt")(acceptance);
  }

  double size() const override {
    if (!adapts_ || !py::hasattr(object_, "size")) return std::nan("");
    return to_number(object_.attr("size"), "size", "any x");
  }

 private:
  bool truth(const char* attribute) const { return object_.attr(attribute).template cast<bool>(); }

  Space space_;
  py::object object_, propose_, density_;
  bool symmetric_, suits_all_, adapts_;
  std::shared_ptr<RandomGenerators> generators_;
};

}  // namespace mlt::python
