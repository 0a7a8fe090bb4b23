#include "python_mutation.h"

#include "scene_dict.h"

#include "mutation/evaluate_proposal.h"

namespace mlt::python {
namespace {

std::string repr(const py::object& object) { return py::repr(object); }

}  // namespace

struct PythonMutation::Held {
  py::object object, suitability, propose, density;
  /// Generators that no call is using; while one call waits for another thread, that thread draws
  /// from another stream.
  std::vector<std::unique_ptr<RandomGenerator>> idle;
};

/// A generator for the length of one call.
class PythonMutation::Borrowed {
 public:
  explicit Borrowed(Held& held) : held_(held) {
    if (held_.idle.empty()) {
      generator_ = std::make_unique<RandomGenerator>(Rng(0, Purpose::chain, 0));
    } else {
      generator_ = std::move(held_.idle.back());
      held_.idle.pop_back();
    }
  }
  ~Borrowed() { held_.idle.push_back(std::move(generator_)); }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;

  const RandomGenerator& operator*() const { return *generator_; }

 private:
  Held& held_;
  std::unique_ptr<RandomGenerator> generator_;
};

PythonMutation::PythonMutation(std::shared_ptr<LoadedScene> scene, const PathTarget& target,
                               py::object object)
    : Mutation(object.attr("name").cast<std::string>(), target),
      scene_(std::move(scene)),
      held_(std::make_unique<Held>()) {
  held_->suitability = object.attr("suitability");
  held_->propose = object.attr("propose");
  held_->density = object.attr("density");
  held_->object = std::move(object);
}

PythonMutation::~PythonMutation() {
  const py::gil_scoped_acquire gil;
  held_.reset();
}

double PythonMutation::suitability(const PathState& x) const {
  const py::gil_scoped_acquire gil;
  return checked(held_->suitability(wrap(x)), "suitability(x)", x);
}

std::optional<Edit> PythonMutation::propose(const PathState& x, PathState& y,
                                            MutationContext& context) const {
  const py::gil_scoped_acquire gil;
  py::object proposed;
  {
    const Borrowed generator(*held_);
    const RandomGenerator::Use use(*generator, context.rng);
    proposed = held_->propose(wrap(x), (*generator).generator());
  }
  if (proposed.is_none()) return std::nullopt;
  if (!py::isinstance<PyLightPath>(proposed))
    throw UsageError(name() + ".propose(x, rng) returned " + repr(proposed) +
                     "; it must be a LightPath, such as x.with_vertices(...), or None");
  const auto& made = proposed.cast<const PyLightPath&>();
  if (made.scene->scene != scene_->scene)
    throw UsageError(name() + ".propose(x, rng) returned a path of another scene than x's");
  if (made.path.edges() > target().rules().most_edges()) return std::nullopt;
  y.path = made.path;
  return evaluate_proposal(target(), x, y, context.rays);
}

double PythonMutation::density(const PathState& x, const PathState& y, const Edit&) const {
  const py::gil_scoped_acquire gil;
  return checked(held_->density(wrap(x), wrap(y)), "density(x, y)", x);
}

py::object PythonMutation::wrap(const PathState& x) const {
  return py::cast(light_path(scene_, x, target().rules().strict_normals));
}

double PythonMutation::checked(const py::object& returned, const char* method,
                               const PathState& x) const {
  const double value = PyFloat_AsDouble(returned.ptr());
  if (value >= 0 && value < infinity) return value;
  PyErr_Clear();
  throw UsageError(name() + "." + method + " is " + repr(returned) + " for x = " + repr(wrap(x)) +
                   "; it must be a finite number that is not negative");
}

std::shared_ptr<const py::object> hold(py::object object) {
  return {new py::object(std::move(object)), [](const py::object* held) {
            const py::gil_scoped_acquire gil;
            delete held;
          }};
}

MutationPtr to_mutation(const std::shared_ptr<LoadedScene>& scene, const PathTarget& target,
                        const py::object& object) {
  if (py::isinstance<py::str>(object)) return make_mutation(object.cast<std::string>(), target);
  const py::object base = py::module_::import("pymlt").attr("Mutation");
  if (!py::isinstance(object, base)) {
    const bool is_class =
        PyType_Check(object.ptr()) && PyObject_IsSubclass(object.ptr(), base.ptr()) == 1;
    throw UsageError(
        repr(object) + " is not a mutation of light paths" +
        (is_class ? "; write " + object.attr("__name__").cast<std::string>() + "()" : ""));
  }
  if (!object.attr("_built_in").cast<bool>())
    return std::make_shared<PythonMutation>(scene, target, object);
  MutationValues own;
  for (const auto& [name, value] : object.attr("_given")().cast<py::dict>()) {
    const std::string parameter = py::str(name);
    own.push_back({parameter, to_value(py::reinterpret_borrow<py::object>(value), parameter, {})});
  }
  return make_mutation(object.attr("name").cast<std::string>(), target, own);
}

std::pair<Mutations, MixtureWeights> to_mixture(const std::shared_ptr<LoadedScene>& scene,
                                                const PathTarget& target,
                                                const WeightedObjects& objects) {
  Mutations mutations;
  std::vector<double> weights;
  for (const auto& [object, weight] : objects) {
    mutations.push_back(to_mutation(scene, target, object));
    weights.push_back(weight);
  }
  return {mutations, MixtureWeights(std::move(weights))};
}

PathTarget path_target(const LoadedScene& scene, int max_depth, bool hide_emitters,
                       bool strict_normals, double near_specular) {
  if (max_depth == 0 || max_depth < -1)
    throw UsageError("max_depth is " + std::to_string(max_depth) +
                     ", but should be positive, or -1 for no limit");
  PathRules rules;
  rules.max_depth = max_depth;
  rules.hide_emitters = hide_emitters;
  rules.strict_normals = strict_normals;
  return PathTarget(scene.scene, rules, near_specular);
}

}  // namespace mlt::python
