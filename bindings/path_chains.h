// The laboratory on the space of light paths: L* as a target, and chains of paths.
#pragma once

#include "metropolis_trace.h"
#include "python_mutation.h"

#include "mutation/mixture.h"

#include <array>

namespace mlt::python {

/// L*(x) of the light paths of a scene.
class PathTarget {
 public:
  PathTarget(std::shared_ptr<LoadedScene> scene, const MutationSettings& settings)
      : scene_(std::move(scene)), settings_(settings) {}

  double operator()(const PyLightPath& x) const { return evaluated(x).target; }
  /// x with its terms; target = 0 also where light cannot take it. Throws UsageError for a path of
  /// another scene.
  PathState evaluated(const PyLightPath& x) const;
  /// (b, its error, paths to start chains from). Throws RenderError if no path carries light.
  py::tuple bootstrap(uint64_t candidates, uint32_t chains, uint64_t seed) const;

  py::object to_python(const PathState& x) const;
  const std::shared_ptr<LoadedScene>& scene() const { return scene_; }
  const MutationSettings& settings() const { return settings_; }

 private:
  std::shared_ptr<LoadedScene> scene_;
  MutationSettings settings_;
};

/// Chains of light paths, each with a random stream of its own. What Python gets is a value: a state
/// that a chain stays in is one object.
class PathChains {
 public:
  PathChains(const PathTarget& target, const WeightedObjects& moves,
             const std::vector<py::object>& starts, uint64_t seed);

  py::dict advance(size_t steps, bool expected_values);

 private:
  struct Chain {
    PathState x;
    Object shown;
    Rng rng;
  };
  void step(size_t c, size_t i, bool expected_values, MutationMixture& kernel,
            Trace<Objects>& trace);

  PathTarget target_;
  Mutations mutations_;
  MutationChoice choice_;
  std::vector<Chain> chains_;
  std::array<PathState, 1> y_;
};

/// `Scene.path_target` in the core, the rest in the module of the laboratory.
void bind_path_target(py::module_& core, py::module_& m);

}  // namespace mlt::python
