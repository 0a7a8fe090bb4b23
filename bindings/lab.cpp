// The laboratory of cpp/lab for Python: built-in targets and moves, and chains that run on these
// or on Python's own.
#include "metropolis_chains.h"
#include "python_mutation.h"

#include "lab/moves.h"
#include "lab/targets.h"
#include "markov/bootstrap.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

using lab::Point;

// ---- Python's arguments

/// A built-in move as it is, any other object as a PythonMove.
template <class Space>
lab::Prototypes<typename Space::State> make_moves(const Space& space, const WeightedObjects& given,
                                                  uint64_t seed, bool& native) {
  using X = typename Space::State;
  lab::Prototypes<X> moves;
  const auto generators = std::make_shared<RandomGenerators>(Rng(seed, Purpose::chain, 0));
  for (const auto& [object, weight] : given) {
    if constexpr (std::is_same_v<Space, Numbers>) {
      if (py::isinstance<lab::Move<Point>>(object)) {
        moves.emplace_back(object.template cast<lab::MovePtr>(), weight);
        continue;
      }
    }
    native = false;
    moves.emplace_back(std::make_shared<PythonMove<Space>>(space, object, generators), weight);
  }
  return moves;
}

Numbers make_space(const std::string& form, size_t dimensions) {
  using Form = Numbers::Form;
  return {form == "number"    ? Form::number
          : form == "integer" ? Form::integer
                              : Form::array,
          dimensions};
}

std::unique_ptr<AnyChains> number_chains(const py::object& target, const WeightedObjects& given,
                                         const std::vector<Point>& starts, const std::string& form,
                                         uint64_t seed, bool vectorized) {
  const Numbers space = make_space(form, starts.at(0).size());
  bool native = py::isinstance<lab::Target<Point>>(target);
  const bool lockstep = vectorized && !native;
  const auto moves = make_moves(space, given, seed, native);
  if (lockstep) {
    std::vector<py::object> python_moves;
    for (const auto& [move, weight] : given)
      python_moves.push_back(py::isinstance<lab::Move<Point>>(move) ? py::none() : move);
    return std::make_unique<VectorChains>(space, target, moves, python_moves, starts, seed);
  }
  lab::TargetPtr function;
  if (py::isinstance<lab::Target<Point>>(target))
    function = target.cast<lab::TargetPtr>();
  else
    function = std::make_shared<PythonTarget<Numbers>>(space, target);
  return std::make_unique<Chains<Numbers>>(space, function, moves, starts, seed, native);
}

std::unique_ptr<AnyChains> object_chains(const py::object& target, const WeightedObjects& given,
                                         const std::vector<py::object>& objects, uint64_t seed) {
  const Objects space;
  bool native = false;
  const auto moves = make_moves(space, given, seed, native);
  std::vector<Object> starts;
  for (const py::object& x : objects) starts.push_back({x});
  return std::make_unique<Chains<Objects>>(
      space, std::make_shared<PythonTarget<Objects>>(space, target), moves, starts, seed, native);
}

lab::TargetPtr image_target(const Doubles& pixels) {
  return lab::image({pixels.data(), pixels.data() + pixels.size()},
                    static_cast<size_t>(pixels.shape(1)));
}

py::array_t<double> values_at(const lab::Target<Point>& target, const Doubles& points) {
  const auto count = points.shape(0), width = points.shape(1);
  py::array_t<double> values(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const double* p = points.data() + i * width;
    values.mutable_data()[i] = target(Point(p, p + width));
  }
  return values;
}

py::tuple resample_starts(const std::vector<double>& weights, uint32_t chains, uint64_t seed) {
  Rng rng(seed, Purpose::resample, 0);
  const Bootstrap bootstrap = resample(weights, chains, rng);
  return py::make_tuple(bootstrap.b, bootstrap.b_error, bootstrap.seeds);
}

lab::WalkShape walk_shape(const std::string& name) {
  return name == "normal" ? lab::WalkShape::normal : lab::WalkShape::uniform;
}

void bind_moves(py::module_& m) {
  py::class_<lab::Move<Point>, lab::MovePtr>(m, "Move", "A built-in move.");
  m.def("random_walk", [](const std::vector<double>& size, const std::string& shape) {
    return lab::random_walk(size, walk_shape(shape));
  });
  m.def("adaptive_walk", [](const std::vector<double>& size, const std::string& shape, double goal,
                            double rate, double decay) {
    return lab::adaptive_walk(size, walk_shape(shape), {goal, rate, decay});
  });
  m.def("uniform", &lab::uniform);
  m.def("discrete", &lab::discrete);
}

void bind_targets(py::module_& m) {
  py::class_<lab::Target<Point>, lab::TargetPtr>(m, "Target", "A built-in target.")
      .def("values", &values_at, py::arg("points"), "At each row of an array.");
  m.def("parabola", &lab::parabola);
  m.def("table", &lab::table);
  m.def("image", &image_target);
  m.def("normals", &lab::normals);
}

}  // namespace

void bind_lab(py::module_& parent) {
  py::module_ m = parent.def_submodule("lab", "The C++ side of pymlt.lab.metropolis.");
  bind_random_source(m);
  bind_moves(m);
  bind_targets(m);

  py::class_<AnyChains>(m, "Chains", "Chains of numbers, of any Python objects, or of light paths.")
      .def("advance", &AnyChains::advance, py::arg("steps"), py::arg("expected_values"));
  m.def("number_chains", &number_chains, py::arg("target"), py::arg("moves"), py::arg("starts"),
        py::arg("form"), py::arg("seed"), py::arg("vectorized"));
  m.def("object_chains", &object_chains, py::arg("target"), py::arg("moves"), py::arg("starts"),
        py::arg("seed"));
  m.def("resample", &resample_starts, py::arg("weights"), py::arg("chains"), py::arg("seed"));
  m.def(
      "acceptance", [](double forward, double backward) { return acceptance({forward, backward}); },
      py::arg("forward"), py::arg("backward"));
}

}  // namespace mlt::python
