// Targets and moves that are written in Python, on states that are numbers or any Python object.
#pragma once

#include "bindings.h"
#include "random_generator.h"

#include "lab/lab.h"

#include <optional>
#include <string>

namespace mlt::python {

/// A Python object as a state.
struct Object {
  py::object value;
};
std::string describe(const Object& x);
using lab::describe;

/// A number that a Python function has returned; `what` and `x` are for the message.
double to_number(const py::object& returned, const std::string& what, const std::string& x);

/// States of numbers: one, one that is an integer, or an array.
struct Numbers {
  using State = lab::Point;
  enum class Form { number, integer, array };

  Form form;
  size_t dimensions;

  py::object to_python(const lab::Point& x) const;
  void from_python(const py::object& object, lab::Point& x) const;
};

/// States that only Python understands.
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
    const py::object returned = function_(space_.to_python(x));
    const double value = PyFloat_AsDouble(returned.ptr());
    return value == -1 && PyErr_Occurred() ? to_number(returned, "the target", describe(x)) : value;
  }

 private:
  Space space_;
  py::object function_;
};

/// What a class of moves written in Python brings along.
struct MoveTraits {
  bool symmetric, suits_all, adapts;
};

/// An object with propose(x, rng) and, as its traits say, density(x, y), suitability(x), adapt(a).
template <class Space>
class PythonMove final : public lab::Move<typename Space::State> {
 public:
  using X = typename Space::State;
  PythonMove(const Space& space, py::object object, const MoveTraits& traits,
             std::shared_ptr<RandomGenerator> generator)
      : space_(space),
        object_(std::move(object)),
        traits_(traits),
        generator_(std::move(generator)) {
    propose_ = object_.attr("propose");
    if (!traits_.symmetric) density_ = object_.attr("density");
  }

  std::shared_ptr<lab::Move<X>> clone() const override {
    py::object own = object_;
    if (traits_.adapts) own = py::module_::import("copy").attr("deepcopy")(object_);
    return std::make_shared<PythonMove>(space_, own, traits_, generator_);
  }

  double suitability(const X& x) const override {
    if (traits_.suits_all) return 1;
    return to_number(object_.attr("suitability")(space_.to_python(x)), "suitability(x)",
                     describe(x));
  }

  bool propose(const X& x, X& y, Rng& rng) override {
    const RandomGenerator::Use use(*generator_, rng);
    const py::object proposed = propose_(space_.to_python(x), generator_->generator());
    if (proposed.is_none()) return false;
    space_.from_python(proposed, y);
    return true;
  }

  double density(const X& x, const X& y) const override {
    if (traits_.symmetric) return 1;
    return to_number(density_(space_.to_python(x), space_.to_python(y)), "density(x, y)",
                     describe(x));
  }

  void adapt(double acceptance) override {
    if (traits_.adapts) object_.attr("adapt")(acceptance);
  }

  double size() const override {
    if (!traits_.adapts || !py::hasattr(object_, "size")) return std::nan("");
    return to_number(object_.attr("size"), "size", "any x");
  }

 private:
  Space space_;
  py::object object_, propose_, density_;
  MoveTraits traits_;
  std::shared_ptr<RandomGenerator> generator_;
};

}  // namespace mlt::python
