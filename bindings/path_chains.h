// The laboratory on the space of light paths: L* as a target, and chains of paths.
#pragma once

#include "metropolis_trace.h"
#include "python_mutation.h"

namespace mlt::python {

/// L*(x) of the light paths of a scene.
class PyPathTarget {
 public:
  PyPathTarget(std::shared_ptr<LoadedScene> scene, PathTarget target)
      : scene_(std::move(scene)), target_(std::move(target)) {}

  double operator()(const PyLightPath& x) const { return evaluated(x).target; }
  /// x with its terms; target = 0 also where light cannot take it. Throws UsageError for a path of
  /// another scene.
  PathState evaluated(const PyLightPath& x) const;
  /// A metropolis.Start. Throws RenderError if no path carries light.
  py::object bootstrap(uint64_t candidates, uint32_t chains, uint64_t seed) const;

  py::object to_python(const PathState& x) const {
    return py::cast(light_path(scene_, x, target_.rules().strict_normals));
  }
  const std::shared_ptr<LoadedScene>& scene() const { return scene_; }
  const PathTarget& target() const { return target_; }

 private:
  std::shared_ptr<LoadedScene> scene_;
  PathTarget target_;
};

/// Chains of light paths, each with a random stream of its own. What Python gets is a value: a
/// state that a chain stays in is one object.
class PathChains {
 public:
  PathChains(const PyPathTarget& target, const WeightedObjects& moves,
             const std::vector<py::object>& starts, uint64_t seed);

  py::dict advance(size_t steps, bool expected_values);

 private:
  struct ShownChain {
    PathChain chain;
    Object shown;
  };
  void step(size_t c, size_t i, bool expected_values, Trace<Objects>& trace);

  PyPathTarget target_;
  std::vector<ShownChain> chains_;
};

/// `Scene.path_target` in the core, the rest in the module of the laboratory.
void bind_path_target(py::module_& core, py::module_& m);

}  // namespace mlt::python
