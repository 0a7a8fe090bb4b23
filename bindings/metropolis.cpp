// The laboratory of cpp/lab for Python: built-in targets and moves, and chains that run on these
// or on Python's own.
#include "metropolis_chains.h"
#include "path_chains.h"

#include "lab/moves.h"
#include "lab/targets.h"
#include "markov/bootstrap.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

using lab::Point;

// ---- from Python's arguments

bool truth(const py::object& object, const char* attribute) {
  return py::cast<bool>(object.attr(attribute));
}

/// A built-in move as it is, any other object as a PythonMove.
template <class Space>
lab::Prototypes<typename Space::State> make_moves(const Space& space, const WeightedObjects& given,
                                                  uint64_t seed, bool& native) {
  using X = typename Space::State;
  lab::Prototypes<X> moves;
  std::shared_ptr<RandomGenerator> generator;
  for (const auto& [object, weight] : given) {
    if constexpr (std::is_same_v<Space, Numbers>) {
      if (py::isinstance<lab::Move<Point>>(object)) {
        moves.emplace_back(object.template cast<std::shared_ptr<lab::Move<Point>>>(), weight);
        continue;
      }
    }
    native = false;
    if (!generator) generator = std::make_shared<RandomGenerator>(Rng(seed, Purpose::chain, 0));
    const MoveTraits traits{truth(object, "symmetric"), truth(object, "_suits_all"),
                            truth(object, "_adapts")};
    moves.emplace_back(std::make_shared<PythonMove<Space>>(space, object, traits, generator),
                       weight);
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

std::unique_ptr<Chains<Numbers>> number_chains(const py::object& target,
                                               const WeightedObjects& given,
                                               const std::vector<Point>& starts,
                                               const std::string& form, uint64_t seed,
                                               bool vectorized) {
  const Numbers space = make_space(form, starts.at(0).size());
  bool native = true;
  const auto moves = make_moves(space, given, seed, native);
  if (py::isinstance<lab::Target<Point>>(target))
    return std::make_unique<Chains<Numbers>>(
        space, target.cast<std::shared_ptr<lab::Target<Point>>>(), moves, starts, seed, native);
  if (!vectorized)
    return std::make_unique<Chains<Numbers>>(
        space, std::make_shared<PythonTarget<Numbers>>(space, target), moves, starts, seed, false);
  std::vector<py::object> python_moves;
  for (const auto& [move, weight] : given)
    python_moves.push_back(py::isinstance<lab::Move<Point>>(move) ? py::none() : move);
  return std::make_unique<VectorChains>(space, target, moves, python_moves, starts, seed);
}

std::unique_ptr<Chains<Objects>> object_chains(const py::object& target,
                                               const WeightedObjects& given, const py::list& starts,
                                               uint64_t seed) {
  const Objects space;
  bool native = false;
  const auto moves = make_moves(space, given, seed, native);
  std::vector<Object> states;
  for (const py::handle x : starts) states.push_back({py::reinterpret_borrow<py::object>(x)});
  return std::make_unique<Chains<Objects>>(
      space, std::make_shared<PythonTarget<Objects>>(space, target), moves, states, seed, false);
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

lab::WalkShape shape_of(const std::string& name) {
  return name == "normal" ? lab::WalkShape::normal : lab::WalkShape::uniform;
}

void bind_moves(py::module_& m) {
  py::class_<lab::Move<Point>, std::shared_ptr<lab::Move<Point>>>(m, "Move", "A built-in move.");
  const auto mutable_move = [](const lab::MovePtr& move) {
    return std::const_pointer_cast<lab::Move<Point>>(move);
  };
  m.def("random_walk", [=](std::vector<double> size, const std::string& shape) {
    return mutable_move(lab::random_walk(std::move(size), shape_of(shape)));
  });
  m.def("adaptive_walk", [=](std::vector<double> size, const std::string& shape, double goal,
                             double rate, double decay) {
    return mutable_move(lab::adaptive_walk(std::move(size), shape_of(shape), {goal, rate, decay}));
  });
  m.def("uniform", [=](Point low, Point high) {
    return mutable_move(lab::uniform(std::move(low), std::move(high)));
  });
  m.def("discrete", [=](const std::vector<std::vector<double>>& matrix) {
    return mutable_move(lab::discrete(matrix));
  });
}

void bind_targets(py::module_& m) {
  py::class_<lab::Target<Point>, std::shared_ptr<lab::Target<Point>>>(m, "Target",
                                                                      "A built-in target.")
      .def("values", &values_at, py::arg("points"), "At each row of an array.");
  const auto mutable_target = [](const lab::TargetPtr& target) {
    return std::const_pointer_cast<lab::Target<Point>>(target);
  };
  m.def("parabola", [=] { return mutable_target(lab::parabola()); });
  m.def("table",
        [=](std::vector<double> values) { return mutable_target(lab::table(std::move(values))); });
  m.def("image", [=](const Doubles& pixels) { return mutable_target(image_target(pixels)); });
  m.def("normals",
        [=](std::vector<Point> means, std::vector<double> deviations, std::vector<double> weights) {
          return mutable_target(
              lab::normals(std::move(means), std::move(deviations), std::move(weights)));
        });
}

}  // namespace

void bind_metropolis(py::module_& parent) {
  py::module_ m = parent.def_submodule("metropolis", "The C++ side of pymlt.metropolis.");
  bind_random_source(m);
  bind_moves(m);
  bind_targets(m);
  bind_path_target(parent, m);

  py::class_<Chains<Numbers>>(m, "NumberChains", "Chains of numbers or arrays.")
      .def("advance", &Chains<Numbers>::advance, py::arg("steps"), py::arg("expected_values"));
  py::class_<Chains<Objects>>(m, "ObjectChains", "Chains of any Python objects.")
      .def("advance", &Chains<Objects>::advance, py::arg("steps"), py::arg("expected_values"));
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
