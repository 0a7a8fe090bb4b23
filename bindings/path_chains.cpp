#include "path_chains.h"

#include "metropolis_chains.h"

#include "mutation/evaluate_proposal.h"
#include "mutation/path_seeds.h"

namespace mlt::python {

PathState PyPathTarget::evaluated(const PyLightPath& x) const {
  if (x.scene->scene != scene_->scene) throw UsageError("the path is one of another scene");
  RayCounts rays;
  return mlt::evaluated(target_, x.path, rays);
}

py::object PyPathTarget::bootstrap(uint64_t candidates, uint32_t chains, uint64_t seed) const {
  const PathStarts found = run_interruptibly([&](const std::atomic<bool>& cancelled) {
    return mlt::bootstrap(target_, {seed, Purpose::bootstrap, candidates}, chains,
                          hardware_threads(), cancelled);
  });
  if (found.paths.empty())
    throw RenderError("no light path was found among " + std::to_string(candidates) +
                      " candidates; is the image dark, or max_depth too small?");
  py::list starts;
  for (const PathState& x : found.paths) starts.append(to_python(x));
  return py::module_::import("pymlt.metropolis").attr("Start")(found.b, found.b_error, starts);
}

PathChains::PathChains(const PyPathTarget& target, const WeightedObjects& moves,
                       const std::vector<py::object>& starts, uint64_t seed)
    : target_(target) {
  const auto [mutations, weights] = to_mixture(target_.scene(), target_.target(), moves);
  const auto shared = std::make_shared<MixtureWeights>(weights);
  for (const py::object& start : starts) {
    PathState x = target_.evaluated(start.cast<const PyLightPath&>());
    if (!(x.target > 0))
      throw UsageError("the target is 0 at the start " + std::string(py::repr(start)) +
                       "; a chain must start where it is positive");
    chains_.push_back(
        {PathChain({mutations, shared}, Rng(seed, Purpose::chain, chains_.size()), std::move(x)),
         {start}});
  }
}

py::dict PathChains::advance(size_t steps, bool expected_values) {
  Trace<Objects> trace(Objects{}, chains_.size(), steps, expected_values);
  for (size_t c = 0; c < chains_.size(); ++c)
    for (size_t i = 0; i < steps; ++i) {
      check_signals(i + 1);
      step(c, i, expected_values, trace);
    }
  return trace.take();
}

void PathChains::step(size_t c, size_t i, bool expected_values, Trace<Objects>& trace) {
  auto& [chain, shown] = chains_[c];
  trace.begin(c, i, shown);
  Object y;
  const auto record = [&, &chain = chain, &shown = shown](const PathState& state, double weight) {
    if (!expected_values) return;
    const bool proposal = &state != &chain.state();
    if (proposal) y.value = target_.to_python(state);
    trace.record(c, i, proposal ? y : shown, weight, proposal);
  };
  const StepResult result = chain.step(record);
  if (result.accepted >= 0) shown.value = y.value ? y.value : target_.to_python(chain.state());
  trace.end(c, i, shown, chosen_move(chain), std::nan(""), result);
}

namespace {

using LoadedPtr = std::shared_ptr<LoadedScene>;

PyPathTarget make_path_target(const LoadedPtr& scene, int max_depth, bool hide_emitters,
                              bool strict_normals, double near_specular) {
  return {scene, path_target(*scene, max_depth, hide_emitters, strict_normals, near_specular)};
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

void bind_path_target(py::module_& core, py::module_& m) {
  py::class_<PathChains>(m, "PathChains", "Chains of light paths.")
      .def("advance", &PathChains::advance, py::arg("steps"), py::arg("expected_values"));
  py::class_<PyPathTarget>(
      m, "PathTarget",
      "L*(x), the brightness that a light path brings to the image: the target "
      "of Metropolis light transport, for `metropolis.run`.")
      .def("__call__", &PyPathTarget::operator(), py::arg("path"),
           "L*(x) = (luminance + mean of R, G, B of f(x)) / 2; 0 if light cannot take the path.")
      .def("__repr__",
           [](const PyPathTarget& target) {
             return "PathTarget(max_depth=" + std::to_string(target.target().rules().max_depth) +
                    ")";
           })
      .def("bootstrap", &PyPathTarget::bootstrap, py::arg("candidates") = 10000, py::kw_only(),
           py::arg("chains") = 1, py::arg("seed") = 0,
           "Paths to start chains from without start-up bias, as a `metropolis.Start` with b, the "
           "integral of L*: chosen among the candidates of bidirectional path tracing.")
      .def("metropolis_chains", [](const PyPathTarget& target, const WeightedObjects& moves,
                                   const py::object& x0, const py::object& chains, uint64_t seed) {
        return py::make_tuple(
            std::make_unique<PathChains>(target, moves, starts_of(x0, chains), seed), "object");
      });
  auto scene = py::class_<LoadedScene, LoadedPtr>(core.attr("Scene"));
  scene.def("path_target", &make_path_target, py::kw_only(), py::arg("max_depth") = 8,
            py::arg("hide_emitters") = false, py::arg("strict_normals") = false,
            py::arg("near_specular") = 0.1,
            "L* of the paths of this scene as a target for `metropolis.run`, with mutations as its "
            "moves.");
}

}  // namespace mlt::python
