// Mutations that are written in Python, beside those of C++.
#pragma once

#include "light_path.h"
#include "random_generator.h"

#include "mutation/mutation_registry.h"

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mlt::python {

/// An object with suitability(x), propose(x, rng) and density(x, y). Calls take the GIL, so that a
/// render may go on in many threads; all of them share the object.
class PythonMutation final : public Mutation {
 public:
  PythonMutation(std::shared_ptr<LoadedScene> scene, const PathTarget& target, py::object object);
  ~PythonMutation() override;

  double suitability(const PathState& x) const override;
  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override;
  double density(const PathState& x, const PathState& y, const Edit& edit) const override;

 private:
  struct Held;  // what needs the GIL
  class Borrowed;

  py::object wrap(const PathState& x) const;
  /// A number that a method has returned: finite and not negative, else UsageError.
  double checked(const py::object& returned, const char* method, const PathState& x) const;

  std::shared_ptr<LoadedScene> scene_;
  std::unique_ptr<Held> held_;
};

/// A Python object that may be dropped without the GIL.
std::shared_ptr<const py::object> hold(py::object object);

using WeightedObjects = std::vector<std::pair<py::object, double>>;

/// A mutation of C++ by its name or by its object in Python; any other object as a PythonMutation.
/// Throws UsageError for what is not a mutation.
MutationPtr to_mutation(const std::shared_ptr<LoadedScene>& scene, const PathTarget& target,
                        const py::object& object);

/// The same for all of a mixture, with their weights.
std::pair<Mutations, MixtureWeights> to_mixture(const std::shared_ptr<LoadedScene>& scene,
                                                const PathTarget& target,
                                                const WeightedObjects& objects);

/// The paths of a scene that Python's arguments name. Throws UsageError for a max_depth that is
/// none.
PathTarget path_target(const LoadedScene& scene, int max_depth, bool hide_emitters,
                       bool strict_normals, double near_specular);

/// Runs work that looks at `cancelled` now and then, without the GIL, and lets Ctrl-C through.
template <class Work>
auto run_interruptibly(Work&& work) {
  std::atomic<bool> cancelled{false};
  const py::gil_scoped_release release;
  auto running = std::async(std::launch::async, [&] { return work(cancelled); });
  while (running.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() == 0) continue;
    const py::error_already_set interrupt;
    cancelled = true;
    {
      const py::gil_scoped_release waiting;
      running.wait();
    }
    throw interrupt;
  }
  return running.get();
}

}  // namespace mlt::python
