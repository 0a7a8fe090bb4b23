// Mutations that are written in Python, beside those of C++.
#pragma once

#include "light_path.h"
#include "random_generator.h"

#include "mutation/mutation.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mlt::python {

/// An object with suitability(x), propose(x, rng) and density(x, y). Calls take the GIL, so that a
/// render may go on in many threads; all of them share the object.
class PythonMutation final : public Mutation {
 public:
  PythonMutation(std::shared_ptr<LoadedScene> scene, const MutationSettings& settings,
                 py::object object);
  ~PythonMutation() override;

  const std::string& name() const override { return name_; }
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
  MutationSettings settings_;
  std::string name_;
  std::unique_ptr<Held> held_;
};

/// A Python object that may be dropped without the GIL.
std::shared_ptr<const py::object> hold(py::object object);

using WeightedObjects = std::vector<std::pair<py::object, double>>;

/// A mutation of C++ by its name or by its object in Python; any other object as a PythonMutation.
/// Throws UsageError for what is not a mutation.
std::shared_ptr<const Mutation> to_mutation(const std::shared_ptr<LoadedScene>& scene,
                                            const MutationSettings& settings,
                                            const py::object& object);

}  // namespace mlt::python
