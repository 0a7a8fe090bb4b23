// Mutations that are written in Python, beside those of C++.
#pragma once

#include "light_path.h"

#include "base/abandon.h"
#include "mutation/mutation_registry.h"

#include <atomic>
#include <chrono>
#include <future>
#include <string>
#include <utility>
#include <vector>

namespace mlt::python {

using WeightedObjects = std::vector<std::pair<py::object, double>>;

/// A mutation of C++ by its name or by its object in Python; any other object as a PythonMutation.
/// Throws UsageError for an object that is not a mutation.
MutationPtr to_mutation(const LoadedPtr& scene, const PathTarget& target, const py::object& object);

/// The mutations of a mixture, as above, with their weights.
std::pair<Mutations, MixtureWeights> to_mixture(const LoadedPtr& scene, const PathTarget& target,
                                                const WeightedObjects& objects);

/// Has mutations written in Python propose again now and then, from the same random numbers.
void repeat_proposals(const Mutations& mutations);
/// The first fault that this has shown, as a sentence; empty if there is none.
std::string fault_of_repeated(const Mutations& mutations);

/// The PathRules of Python's arguments. Throws UsageError for an invalid max_depth.
PathRules path_rules(int max_depth, bool hide_emitters, bool strict_normals);

/// Runs work that checks `cancelled` now and then, without the GIL; Ctrl-C cancels it.
template <class Work>
auto run_interruptibly(Work&& work) {
  std::atomic<bool> cancelled{false};
  const ReleasedGil release;
  auto running = std::async(std::launch::async, [&] {
    const Abandonable abandonable(&cancelled);
    return work(cancelled);
  });
  while (running.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    const AcquiredGil acquire;
    if (PyErr_CheckSignals() == 0) continue;
    const py::error_already_set interrupt;
    cancelled = true;
    {
      const ReleasedGil waiting;
      running.wait();
    }
    throw interrupt;
  }
  return running.get();
}

}  // namespace mlt::python
