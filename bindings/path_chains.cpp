#include "path_chains.h"

#include "metropolis_chains.h"

#include "markov/bootstrap.h"
#include "mutation/evaluate_proposal.h"
#include "mutation/path_seeds.h"

namespace mlt::python {

PathState PathTarget::evaluated(const PyLightPath& x) const {
  if (x.scene->scene != scene_->scene) throw UsageError("the path is one of another scene");
  PathState evaluated;
  evaluated.path = x.path;
  evaluate(*scene_->scene, settings_, evaluated);
  const int k = x.path.edges();
  RayCounts rays;
  if ((settings_.max_depth >= 0 && k > settings_.max_depth) ||
      !passable(*scene_->scene, x.path, 0, k, rays))
    evaluated.target = 0;
  return evaluated;
}

py::tuple PathTarget::bootstrap(uint64_t candidates, uint32_t chains, uint64_t seed) const {
  BidirectionalSettings how;
  how.rules.max_depth = settings_.max_depth;
  how.rules.hide_emitters = settings_.hide_emitters;
  how.rules.strict_normals = settings_.strict_normals;
  PathSeeds seeds(*scene_->scene, how, settings_);
  RayCounts rays;
  std::vector<double> weights;
  for (uint64_t i = 0; i < candidates; ++i) {
    Rng rng(seed, Purpose::bootstrap, i);
    weights.push_back(seeds.weigh(rng, rays, [](const Vec2&, double) {}));
    check_signals(i + 1);
  }
  Rng rng(seed, Purpose::resample, 0);
  const Bootstrap found = resample(weights, chains, rng);
  if (found.seeds.empty())
    throw RenderError("no light path was found among " + std::to_string(candidates) +
                      " candidates; is the image dark, or max_depth too small?");
  py::list starts;
  for (size_t c = 0; c < found.seeds.size(); ++c) {
    Rng again(seed, Purpose::bootstrap, found.seeds[c]), choice(seed, Purpose::choice, c);
    starts.append(to_python(seeds.pick(again, choice, rays)));
  }
  return py::make_tuple(found.b, found.b_error, starts);
}

py::object PathTarget::to_python(const PathState& x) const {
  return py::cast(light_path(scene_, x, settings_.strict_normals));
}

PathChains::PathChains(const PathTarget& target, const WeightedObjects& moves,
                       const std::vector<py::object>& starts, uint64_t seed)
    : target_(target), choice_(std::vector<double>()) {
  std::vector<double> weights;
  for (const auto& [move, weight] : moves) {
    mutations_.push_back(to_mutation(target.scene(), target.settings(), move));
    weights.push_back(weight);
  }
  choice_ = MutationChoice(std::move(weights));
  for (const py::object& start : starts) {
    PathState x = target.evaluated(start.cast<const PyLightPath&>());
    if (!(x.target > 0))
      throw UsageError("the target is 0 at the start " + std::string(py::repr(start)) +
                       "; a chain must start where it is positive");
    chains_.push_back({std::move(x), {start}, Rng(seed, Purpose::chain, chains_.size())});
  }
}

py::dict PathChains::advance(size_t steps, bool expected_values) {
  Trace<Objects> trace(Objects{}, chains_.size(), steps, expected_values);
  RayCounts rays;
  MutationMixture kernel(mutations_, choice_, rays);
  for (size_t c = 0; c < chains_.size(); ++c)
    for (size_t i = 0; i < steps; ++i) {
      check_signals(i + 1);
      step(c, i, expected_values, kernel, trace);
    }
  return trace.take();
}

void PathChains::step(size_t c, size_t i, bool expected_values, MutationMixture& kernel,
                      Trace<Objects>& trace) {
  Chain& chain = chains_[c];
  kernel.set_stratified_raster(unstratified(target_.scene()->scene->camera().raster(), chain.rng));
  trace.begin(c, i, chain.shown);
  Object y;
  const StepResult result =
      metropolis_step(chain.x, y_, kernel, chain.rng, [&](const PathState& state, double weight) {
        const bool proposal = &state != &chain.x;
        if (!expected_values) return;
        if (proposal) y.value = target_.to_python(state);
        trace.record(c, i, proposal ? y : chain.shown, weight, proposal);
      });
  if (result.accepted >= 0) chain.shown.value = y.value ? y.value : target_.to_python(chain.x);
  const int32_t move = kernel.suited() ? static_cast<int32_t>(kernel.chosen()) : -1;
  trace.end(c, i, chain.shown, move, std::nan(""), result);
}

namespace {

using LoadedPtr = std::shared_ptr<LoadedScene>;

PathTarget path_target(const LoadedPtr& scene, int max_depth, bool hide_emitters,
                       bool strict_normals, double near_specular) {
  if (max_depth == 0 || max_depth < -1)
    throw UsageError("max_depth is " + std::to_string(max_depth) +
                     ", but should be positive, or -1 for no limit");
  MutationSettings settings;
  settings.max_depth = max_depth;
  settings.hide_emitters = hide_emitters;
  settings.strict_normals = strict_normals;
  settings.near_specular = near_specular;
  return {scene, settings};
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

py::object bootstrap(const PathTarget& target, uint64_t candidates, uint32_t chains,
                     uint64_t seed) {
  return py::module_::import("pymlt.metropolis")
      .attr("Start")(*target.bootstrap(candidates, chains, seed));
}

}  // namespace

void bind_path_target(py::module_& core, py::module_& m) {
  py::class_<PathChains>(m, "PathChains", "Chains of light paths.")
      .def("advance", &PathChains::advance, py::arg("steps"), py::arg("expected_values"));
  py::class_<PathTarget>(m, "PathTarget",
                         "L*(x), the brightness that a light path brings to the image: the target "
                         "of Metropolis light transport, for `metropolis.run`.")
      .def("__call__", &PathTarget::operator(), py::arg("path"),
           "L*(x) = (luminance + mean of R, G, B of f(x)) / 2; 0 if light cannot take the path.")
      .def("__repr__",
           [](const PathTarget& target) {
             return "PathTarget(max_depth=" + std::to_string(target.settings().max_depth) + ")";
           })
      .def("bootstrap", &bootstrap, py::arg("candidates") = 10000, py::kw_only(),
           py::arg("chains") = 1, py::arg("seed") = 0,
           "Paths to start chains from without start-up bias, as a `metropolis.Start` with b, the "
           "integral of L*: chosen among the candidates of bidirectional path tracing.")
      .def("metropolis_chains", [](const PathTarget& target, const WeightedObjects& moves,
                                   const py::object& x0, const py::object& chains, uint64_t seed) {
        return py::make_tuple(
            std::make_unique<PathChains>(target, moves, starts_of(x0, chains), seed), "object");
      });
  auto scene = py::class_<LoadedScene, LoadedPtr>(core.attr("Scene"));
  scene.def("path_target", &path_target, py::kw_only(), py::arg("max_depth") = 8,
            py::arg("hide_emitters") = false, py::arg("strict_normals") = false,
            py::arg("near_specular") = 0.1,
            "L* of the paths of this scene as a target for `metropolis.run`, with mutations as its "
            "moves.");
}

}  // namespace mlt::python
