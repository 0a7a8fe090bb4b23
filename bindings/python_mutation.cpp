#include "python_mutation.h"

#include "random_generator.h"
#include "scene_dict.h"

#include "mutation/evaluate_proposal.h"

namespace mlt::python {
namespace {

std::string repr(const py::object& object) { return py::repr(object); }

/// An object with suitability(x), propose(x, rng) and density(x, y). Calls take the GIL, so that a
/// render may run on many threads; all of them share the object.
class PythonMutation final : public Mutation {
 public:
  PythonMutation(LoadedPtr scene, const PathTarget& target, const py::object& object)
      : Mutation(object.attr("name").cast<std::string>(), target),
        scene_(std::move(scene)),
        held_(hold(
            Held{object.attr("suitability"), object.attr("propose"), object.attr("density")})) {}

  double suitability(const PathState& x) const override {
    const AcquiredGil gil = acquire_gil();
    return checked(held_->suitability(wrap(x)), "suitability(x)", x);
  }

  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    const AcquiredGil gil = acquire_gil();
    Rng same = context.rng;
    const py::object proposed =
        held_->propose(wrap(x), *RandomGenerators::Use(held_->generators, context.rng));
    // The low bits, which no number in [0, 1) has, so that what propose draws is as usual.
    if (held_->repeats && Rng(same).next_bits() % 32 == 0 && held_->fault.empty()) {
      const py::object again =
          held_->propose(wrap(x), *RandomGenerators::Use(held_->generators, same));
      if (!equal(proposed, again))
        held_->fault = name() + ".propose(x, rng) made " + repr(proposed) + " and then " +
                       repr(again) + " of " + repr(wrap(x)) +
                       " and the same random numbers; it must draw from rng alone, not from "
                       "np.random or random, and must not change itself";
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

  double density(const PathState& x, const PathState& y, const Edit& /*edit*/) const override {
    const AcquiredGil gil = acquire_gil();
    return checked(held_->density(wrap(x), wrap(y)), "density(x, y)", x);
  }

  void repeat_proposals() const { held_->repeats = true; }
  const std::string& fault() const { return held_->fault; }

 private:
  struct Held {
    py::object suitability, propose, density;
    RandomGenerators generators{Rng(0, Purpose::chain, 0)};
    bool repeats = false;
    std::string fault{};
  };

  static bool equal(const py::object& a, const py::object& b) {
    if (!py::isinstance<PyLightPath>(a) || !py::isinstance<PyLightPath>(b)) return a.equal(b);
    const Path& x = a.cast<const PyLightPath&>().path;
    const Path& y = b.cast<const PyLightPath&>().path;
    if (x.edges() != y.edges()) return false;
    for (int i = 0; i <= x.edges(); ++i)
      if (x[i].at.p != y[i].at.p) return false;
    return x.time == y.time && x.wavelength == y.wavelength;
  }

  py::object wrap(const PathState& x) const {
    return py::cast(light_path(scene_, x, target().rules().strict_normals));
  }

  /// A number that a method has returned: finite and not negative, else UsageError.
  double checked(const py::object& returned, const char* method, const PathState& x) const {
    const double value = PyFloat_AsDouble(returned.ptr());
    if (value >= 0 && value < infinity) return value;
    PyErr_Clear();
    throw UsageError(name() + "." + method + " is " + repr(returned) + " for x = " + repr(wrap(x)) +
                     "; it must be a finite number that is not negative");
  }

  LoadedPtr scene_;
  std::shared_ptr<Held> held_;
};

}  // namespace

MutationPtr to_mutation(const LoadedPtr& scene, const PathTarget& target,
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

std::pair<Mutations, MixtureWeights> to_mixture(const LoadedPtr& scene, const PathTarget& target,
                                                const WeightedObjects& objects) {
  Mutations mutations;
  std::vector<double> weights;
  for (const auto& [object, weight] : objects) {
    mutations.push_back(to_mutation(scene, target, object));
    weights.push_back(weight);
  }
  return {mutations, MixtureWeights(std::move(weights))};
}

void repeat_proposals(const Mutations& mutations) {
  for (const MutationPtr& mutation : mutations)
    if (const auto* python = dynamic_cast<const PythonMutation*>(mutation.get()))
      python->repeat_proposals();
}

std::string fault_of_repeated(const Mutations& mutations) {
  for (const MutationPtr& mutation : mutations)
    if (const auto* python = dynamic_cast<const PythonMutation*>(mutation.get()))
      if (!python->fault().empty()) return python->fault();
  return {};
}

PathRules path_rules(int max_depth, bool hide_emitters, bool strict_normals) {
  if (max_depth == 0 || max_depth < -1)
    throw UsageError("max_depth is " + std::to_string(max_depth) +
                     ", but should be positive, or -1 for no limit");
  PathRules rules;
  rules.max_depth = max_depth;
  rules.hide_emitters = hide_emitters;
  rules.strict_normals = strict_normals;
  return rules;
}

}  // namespace mlt::python
