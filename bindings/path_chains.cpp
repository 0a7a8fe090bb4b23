// The laboratory on the space of light paths: L* as a target, and chains of paths.
#include "metropolis_chains.h"
#include "path_factor.h"
#include "python_mutation.h"

#include "mutation/evaluate_proposal.h"
#include "mutation/path_seeds.h"

namespace mlt::python {
namespace {

/// The target L*(x) of the light paths of a scene.
struct PyPathTarget {
  LoadedPtr scene;
  PathTarget target;

  /// Evaluates x; target = 0 also where light cannot take it. Throws UsageError for a path of
  /// another scene.
  PathState evaluated(const PyLightPath& x) const {
    if (x.scene->scene != scene->scene) throw UsageError("the path is one of another scene");
    RayCounts rays;
    return mlt::evaluated(target, x.path, rays);
  }
  Object to_python(const PathState& x) const {
    return {py::cast(light_path(scene, x, target.rules().strict_normals))};
  }
};

/// Returns a metropolis.Start. Throws RenderError if no path carries light.
py::object bootstrap_starts(const PyPathTarget& target, uint64_t candidates, uint32_t chains,
                            uint64_t seed) {
  const PathStarts found = run_interruptibly([&](const std::atomic<bool>& cancelled) {
    return bootstrap(target.target, {seed, Purpose::bootstrap, candidates}, chains,
                     hardware_threads(), cancelled);
  });
  if (found.paths.empty())
    throw RenderError("no light path was found among " + std::to_string(candidates) +
                      " candidates; is the image dark, or max_depth too small?");
  py::list starts;
  for (const PathState& x : found.paths) starts.append(target.to_python(x).value);
  return py::module_::import("pymlt.lab.metropolis").attr("Start")(found.b, found.b_error, starts);
}

/// A chain whose state is a Python object, the same one as long as the state does not change.
class ShownChain : private PathChain {
 public:
  ShownChain(PathChain chain, py::object start)
      : PathChain(std::move(chain)), shown_{{std::move(start)}, PathChain::state().brightness()} {}

  const lab::State<Object>& state() const { return shown_; }
  using PathChain::kernel;
  static double move_size() { return std::nan(""); }

  template <class Record>
  StepResult step(const PyPathTarget& target, bool expected_values, const Record& record) {
    Object y;
    const auto record_shown = [&](const PathState& x, double weight) {
      if (!expected_values) return;
      const bool is_proposal = &x != &x_;
      if (is_proposal) y = target.to_python(x);
      record(is_proposal ? y : shown_.x, weight, is_proposal);
    };
    const StepResult result = PathChain::step(record_shown);
    if (result.accepted >= 0) shown_.x = y.value ? y : target.to_python(x_);
    return result;
  }

 private:
  lab::State<Object> shown_;
};

/// Chains of light paths, each with a random stream of its own.
class PathChains final : public AnyChains {
 public:
  PathChains(const PyPathTarget& target, const WeightedObjects& moves,
             const std::vector<py::object>& starts, uint64_t seed)
      : target_(target) {
    const auto [mutations, weights] = to_mixture(target_.scene, target_.target, moves);
    const auto shared = std::make_shared<MixtureWeights>(weights);
    for (const py::object& start : starts) {
      PathState x = target_.evaluated(start.cast<const PyLightPath&>());
      if (!(x.target > 0))
        throw UsageError("the target is 0 at the start " + std::string(py::repr(start)) +
                         "; a chain must start where it is positive");
      const Rng rng(seed, Purpose::chain, chains_.size());
      chains_.emplace_back(PathChain({mutations, shared}, rng, std::move(x)), start);
    }
  }

  py::dict advance(size_t steps, bool expected_values) override {
    return advance_each(Objects{}, chains_, steps, expected_values, false,
                        [&](ShownChain& chain, const auto& record) {
                          return chain.step(target_, expected_values, record);
                        });
  }

 private:
  PyPathTarget target_;
  std::vector<ShownChain> chains_;
};

PyPathTarget make_path_target(const LoadedPtr& scene, int max_depth, bool hide_emitters,
                              bool strict_normals, double near_specular,
                              const std::optional<std::string>& paths, const py::object& weight,
                              double power) {
  const PathRules rules = path_rules(max_depth, hide_emitters, strict_normals);
  PyPathTarget made{scene, PathTarget(scene->scene, rules, near_specular)};
  made.target.set_path_factor(path_factor(scene, {paths, weight, power}, strict_normals));
  return made;
}

/// One path for all chains, or a list with one for each.
std::vector<py::object> starts_of(const py::object& x0, const py::object& chains) {
  const size_t count = chains.is_none() ? 1 : chains.cast<size_t>();
  std::vector<py::object> starts(count, x0);
  if (py::isinstance<py::list>(x0) && py::len(x0) == count && !chains.is_none())
    starts = x0.cast<std::vector<py::object>>();
  for (const py::object& start : starts)
    if (!py::isinstance<PyLightPath>(start))
      throw UsageError(
          "x0 should be a LightPath, such as scene.sample_path() returns, or a list with one for "
          "each of the chains");
  return starts;
}

}  // namespace

void bind_path_target(py::module_& core) {
  py::class_<PyPathTarget>(
      core.attr("lab"), "PathTarget",
      "L*(x), the brightness that a light path brings to the image: the target "
      "of Metropolis light transport, for `metropolis.run`.")
      .def(
          "__call__",
          [](const PyPathTarget& target, const PyLightPath& x) {
            return target.evaluated(x).brightness();
          },
          py::arg("path"),
          "L*(x) = (luminance + mean of R, G, B of f(x)) / 2; 0 if light cannot take the path.")
      .def("__repr__",
           [](const PyPathTarget& target) {
             return "PathTarget(max_depth=" + std::to_string(target.target.rules().max_depth) + ")";
           })
      .def("bootstrap", &bootstrap_starts, py::arg("candidates") = 10000, py::kw_only(),
           py::arg("chains") = 1, py::arg("seed") = 0,
           "Paths to start chains from without start-up bias, as a `metropolis.Start` with b, the "
           "integral of L*: chosen among the candidates of bidirectional path tracing.")
      .def("metropolis_chains", [](const PyPathTarget& target, const WeightedObjects& moves,
                                   const py::object& x0, const py::object& chains, uint64_t seed) {
        std::unique_ptr<AnyChains> made =
            std::make_unique<PathChains>(target, moves, starts_of(x0, chains), seed);
        return py::make_tuple(std::move(made), "object");
      });
  py::class_<LoadedScene, LoadedPtr>(core.attr("Scene"))
      .def(
          "path_target", &make_path_target, py::kw_only(), py::arg("max_depth") = 8,
          py::arg("hide_emitters") = false, py::arg("strict_normals") = false,
          py::arg("near_specular") = 0.1, py::arg("paths") = py::none(),
          py::arg("weight") = py::none(), py::arg("power") = 1.0,
          "L* of the paths of this scene as a target for `metropolis.run`, with mutations as its "
          "moves;\nor another target: L*^power, times a weight, of some paths alone.\n\n"
          "`paths` is a regular expression for signatures, such as \"LS+DE\" for caustics "
          "(smooth\nsurfaces below the roughness near_specular count as S). `weight` is a function "
          "of a LightPath\nthat is nowhere negative, or an array (height, width) by the pixels of "
          "the image. `power` below 1\nmakes bright paths rarer. Raises UsageError for a factor "
          "that makes no sense.");
}

}  // namespace mlt::python
